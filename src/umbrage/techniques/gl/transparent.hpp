#pragma once

#include "umbrage/render/technique.hpp"

namespace umbrage::techniques {

/// Coloured light through any number of transparent casters by shadow volumes on the graphics card, summed up before the surfaces that are seen, without caps;
/// casters that the eye touches are counted behind, in the same sums. Self-shadows in every layer (Frame::veilLayers).
/// Source: B. Kim, K. Kim and G. Turk, real-time shadows of transparent casters using shadow volumes, 2008.
[[nodiscard]] shadow::Traits transparentTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeTransparent(std::shared_ptr<gl::Context> context,
                                                                   const render::VolumeOptions& options = {});

/// The same summed up behind the surfaces, with caps.
[[nodiscard]] shadow::Traits transparentZFailTraits();
[[nodiscard]] std::unique_ptr<render::GlTechnique> makeTransparentZFail(std::shared_ptr<gl::Context> context,
                                                                        const render::VolumeOptions& options = {});

}  // namespace umbrage::techniques
