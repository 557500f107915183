#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

[[nodiscard]] shadow::Traits scanlineTraits();
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeScanline();

}  // namespace umbrage::techniques::detail
