#pragma once

#include <vector>

#include "umbrage/render/shadow_map_options.hpp"
#include "umbrage/render/volume_options.hpp"
#include "umbrage/shadow/planes.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques {

/// Every technique of this room. The entries of one list share one headless context, made when the first is created.
[[nodiscard]] std::vector<shadow::TechniqueEntry> openGlTechniques(const render::VolumeOptions& options = {},
                                                                   const shadow::PlaneSearch& planes = {},
                                                                   const render::ShadowMapOptions& maps = {});

}  // namespace umbrage::techniques
