#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

[[nodiscard]] shadow::Traits rayTracedTraits();
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeRayTraced();

}  // namespace umbrage::techniques::detail
