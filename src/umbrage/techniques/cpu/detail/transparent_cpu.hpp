#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

[[nodiscard]] shadow::Traits transparentCpuTraits();
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeTransparentCpu();

}  // namespace umbrage::techniques::detail
