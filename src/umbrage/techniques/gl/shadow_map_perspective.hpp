#pragma once

#include "umbrage/render/shadow_map_options.hpp"
#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// As shadow_map, of the scene as the camera's perspective distorts it: texels are small where pixels are (render::perspectiveMaps). Where no such map samples
/// the picture better it is the same as shadow_map, and the reason says so.
/// Source: M. Stamminger and G. Drettakis, perspective shadow maps, 2002.
[[nodiscard]] shadow::Traits perspectiveShadowMapTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makePerspectiveShadowMap(
    std::shared_ptr<gl::Context> context, const render::ShadowMapOptions& options = {});

}  // namespace umbrage::techniques
