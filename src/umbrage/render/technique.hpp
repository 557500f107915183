#pragma once

#include <memory>
#include <span>

#include "umbrage/gl/context.hpp"
#include "umbrage/render/gpu_frame.hpp"
#include "umbrage/render/prepare_light.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// How the picture looks; the defaults are those of shadow::composite.
struct PictureOptions {
  std::span<const scene::Material> materials;  ///< of the scene that the geometry was made from
  Vec3 up{0.0, 0.0, 1.0};
  shadow::CompositeOptions light;
};

/// A technique that can also draw a whole lit picture on the graphics card, without reading anything back.
class GlTechnique : public shadow::Technique {
 public:
  /// Draws into `target` (its picture()). With `timed`, the phases wait for the driver and are in the result; without, only
  /// what was done is. REQUIRES: prepare() succeeded; `target` is of the technique's own context and the camera's size; one
  /// material for every index in the geometry.
  [[nodiscard]] virtual Result<shadow::FrameStats> draw(GpuFrame& target, const shadow::Frame& frame,
                                                        const PictureOptions& options, bool timed = false) = 0;
};

/// The stencil shadow volume techniques, which differ in how they count.
/// `context`: a headless one, made current for each call; null: the one that the caller has current, whose state is crossed
/// through gl::HostScope. REQUIRES then: it is also current when the technique dies.
[[nodiscard]] std::unique_ptr<GlTechnique> makeStencilTechnique(const shadow::Traits& traits, Counting counting,
                                                                std::shared_ptr<gl::Context> context,
                                                                const VolumeOptions& options = {});

/// The same where casters let light through: what they take from it is summed up instead of counted (TintedPasses), and veils are seen through.
/// With traits that are `soft`, lights with an extent are the mean of that from points of theirs (SoftSums).
/// `counting`: zPass or zFail. Shading and pictures have all surfaces of a pixel; Frame::silhouettes and Frame::extrusion change nothing.
/// Source: B. Kim, K. Kim and G. Turk, real-time shadows of transparent casters using shadow volumes, 2008.
[[nodiscard]] std::unique_ptr<GlTechnique> makeTintedTechnique(const shadow::Traits& traits, Counting counting,
                                                               std::shared_ptr<gl::Context> context,
                                                               const VolumeOptions& options = {});

}  // namespace umbrage::render
