#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

[[nodiscard]] shadow::Traits hybridCpuTraits();
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeHybridCpu();

}  // namespace umbrage::techniques::detail
