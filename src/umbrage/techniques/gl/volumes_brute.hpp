#pragma once

#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// A closed shadow volume for every single triangle that counts, with no silhouette, as the first shadow engines drew them; counted behind the
/// picture like zfail, and as exact. Where two triangles meet their sides cancel, so it shows what a silhouette saves, and with
/// VolumeOptions::overflow what 8 bits of stencil made of so many sides.
/// Source: F. Crow, 1977; T. Heidmann, real shadows, real time, 1991.
[[nodiscard]] shadow::Traits volumesBruteTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeVolumesBrute(std::shared_ptr<gl::Context> context,
                                                                    const render::VolumeOptions& options = {});

}  // namespace umbrage::techniques
