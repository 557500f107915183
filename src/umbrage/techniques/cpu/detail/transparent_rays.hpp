#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

[[nodiscard]] shadow::Traits transparentRaysTraits();
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeTransparentRays();

}  // namespace umbrage::techniques::detail
