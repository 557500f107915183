#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

/// Surfaces cut into lit and shadowed polygons by shadow-volume BSP trees, one a face; only faces that are seen are cut, once for each light.
[[nodiscard]] shadow::Traits svbspTraits();
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeSvbsp();

}  // namespace umbrage::techniques::detail
