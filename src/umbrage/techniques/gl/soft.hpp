#pragma once

#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// Soft shadows of lights with an extent, coloured ones too: the mean of exact hard ones from points of the light, by shadow volumes and summed up on the graphics
/// card; read back at the end.
/// Source: R. Cook, T. Porter and L. Carpenter, distributed ray tracing, 1984, for light as a mean; points: shadow::lightSamples.
[[nodiscard]] shadow::Traits softTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeSoft(std::shared_ptr<gl::Context> context,
                                                            const render::VolumeOptions& options = {});

}  // namespace umbrage::techniques
