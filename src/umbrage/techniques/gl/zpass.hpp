#pragma once

#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// Stencil shadow volumes counted in front of the picture, without caps, starting from the number of caster surfaces between
/// the eye and the light. Casters with a side too close to the eye are counted by z-fail instead, in the same buffer.
/// Exact however many casters lie behind each other: what 8 bits cannot count is counted in groups (shadow::groupLayers).
/// Source: Heidmann, real shadows, real time, 1991; the count at the eye: shadow::countAtEye.
[[nodiscard]] shadow::Traits zPassTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeZPass(std::shared_ptr<gl::Context> context,
                                                             const render::VolumeOptions& options = {});

}  // namespace umbrage::techniques
