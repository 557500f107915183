#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

[[nodiscard]] shadow::Traits zpassCpuTraits();
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeZPassCpu();

}  // namespace umbrage::techniques::detail
