#pragma once

#include "umbrage/render/technique.hpp"
#include "umbrage/shadow/planes.hpp"

namespace umbrage::techniques {

/// Casters projected onto planes of the scene (shadow::findPlanes) and drawn there, each plane's shadows only on the pixels that show it.
/// 1. Exact on these planes, for every caster, eye and light: what lies below a plane or beyond the light is clipped off, and a pixel is darkened once.
/// 2. All other surfaces are lit where they face the light (Shading::unshadowed).
/// 3. Costs all casters on the light's side of a plane, once a plane and light.
/// Source: J. Blinn, me and my (fake) shadow, 1988; the survey of A. Woo, P. Poulin and A. Fournier, 1990.
[[nodiscard]] shadow::Traits planarTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makePlanar(std::shared_ptr<gl::Context> context,
                                                              const shadow::PlaneSearch& planes = {});

}  // namespace umbrage::techniques
