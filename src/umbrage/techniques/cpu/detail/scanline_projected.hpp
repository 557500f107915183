#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

[[nodiscard]] shadow::Traits scanlineProjectedTraits();
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeScanlineProjected();

}  // namespace umbrage::techniques::detail
