#pragma once

#include "umbrage/render/shadow_map_options.hpp"
#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// Shadow maps: the casters' depths as the light sees them, compared with that of each pixel's surface (render::uniformMaps). Approximate: a texel knows one
/// depth, so borders of shadows are texels, and what is thinner than one may be missing.
/// Source: L. Williams, casting curved shadows on curved surfaces, 1978; W. Reeves, D. Salesin and R. Cook, rendering antialiased shadows with depth
/// maps, 1987.
[[nodiscard]] shadow::Traits shadowMapTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeShadowMap(std::shared_ptr<gl::Context> context,
                                                                 const render::ShadowMapOptions& options = {});

}  // namespace umbrage::techniques
