#pragma once

#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// Stencil shadow volumes counted in front of the picture, without caps, starting from the number of caster surfaces between
/// the eye and the light. Casters with a side too close to the eye are counted by z-fail instead, in the same buffer.
/// CAVEAT: counts modulo 256: a point behind exactly 256 caster surfaces would be lit.
/// Source: Heidmann, real shadows, real time, 1991; the count at the eye: shadow::countAtEye.
[[nodiscard]] shadow::Traits zPassTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeZPass(std::shared_ptr<gl::Context> context);

}  // namespace umbrage::techniques
