#pragma once

#include "umbrage/render/map_fit.hpp"
#include "umbrage/render/mask_technique.hpp"
#include "umbrage/render/shadow_map_options.hpp"

namespace umbrage::render {

/// Chooses the maps of a light.
using MapFitter = MapFit (*)(const MapRequest&);

/// Shadow maps: each of a light's maps holds the casters' depths and is looked up at once for the pixels that it covers, so that there is one map in memory.
/// `name`: for LightStats::method. REQUIRES: 0 <= options.texels, 0 <= options.filter <= kLargestFilter.
/// Source: L. Williams, casting curved shadows on curved surfaces, 1978; filtering and bias: W. Reeves, D. Salesin and R. Cook, rendering antialiased
/// shadows with depth maps, 1987.
[[nodiscard]] std::unique_ptr<MaskPainter> makeMapPainter(std::string name, MapFitter fit,
                                                          const ShadowMapOptions& options);

}  // namespace umbrage::render
