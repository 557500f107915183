#pragma once

#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// Stencil shadow volumes counted in front of the picture where the eye is surely outside them, and behind it, with caps, for every caster that
/// may lie between the eye and the light, in the same buffer. The classical choice per caster by the near-clip volume; without a near plane
/// that volume is the segment from the eye to the light.
/// Source: C. Everitt and M. Kilgard, practical and robust stenciled shadow volumes, 2002; M. McGuire et al., fast, practical and
/// robust shadows, 2003.
[[nodiscard]] shadow::Traits zMixedTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeZMixed(std::shared_ptr<gl::Context> context,
                                                              const render::VolumeOptions& options = {});

}  // namespace umbrage::techniques
