#pragma once

#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// As zpass, but what the count starts from is drawn: the casters as the light sees them through the near rectangle
/// (render::throughNearRectangle). Casters with a side nearer to the eye than twice that rectangle are counted by z-fail, in the same buffer; where
/// the light's view degenerates, the count at the eye is taken instead, and the reason says so.
/// Source: S. Hornus, J. Hoberock, S. Lefebvre and J. Hart, ZP+: correct z-pass stencil shadows, 2005.
[[nodiscard]] shadow::Traits zPassPlusTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeZPassPlus(std::shared_ptr<gl::Context> context,
                                                                 const render::VolumeOptions& options = {});

}  // namespace umbrage::techniques
