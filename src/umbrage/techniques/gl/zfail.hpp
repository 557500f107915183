#pragma once

#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// Stencil shadow volumes counted behind the picture: closed volumes, with caps, right for every eye.
/// Sides are compared with the depth of the picture; caps always count as behind it (shadow::ShadowVolume, law 3).
/// Exact however many casters lie behind each other: what 8 bits cannot count is counted in groups (shadow::groupLayers).
/// Source: Bilodeau and Songy, 1999; Carmack, 2000; Everitt and Kilgard, practical and robust stenciled shadow volumes, 2002.
[[nodiscard]] shadow::Traits zFailTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeZFail(std::shared_ptr<gl::Context> context,
                                                             const render::VolumeOptions& options = {});

}  // namespace umbrage::techniques
