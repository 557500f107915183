#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "umbrage/render/run_passes.hpp"
#include "umbrage/render/technique.hpp"

namespace umbrage::render {

/// The surfaces of a frame, drawn: what the masks of its lights are made from.
struct SeenFrame {
  gl::HostScope& scope;
  const shadow::Geometry& geometry;
  const View& view;
  const scene::Camera& camera;
  const gl::PassState& placement;  ///< of what is drawn in perspective
  const RunInput& input;
};

/// A light without extent whose mask is wanted.
struct MaskLight {
  const scene::Light& light;
  std::size_t slot;                      ///< of `input.lights`, which has its data, and of the frame's masks
  std::span<const std::uint8_t> facing;  ///< shadow::visibleSideFacesLight
  gl::Rect area;                         ///< pixels that it can reach
};

/// A way to find shadows that gives the mask of one light at a time. It is made in the context that is current in every call, and when it dies.
class MaskPainter {
 public:
  virtual ~MaskPainter() = default;
  /// Errors: ErrorCode::device when memory is short.
  [[nodiscard]] virtual Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) = 0;
  /// Once a frame, before its lights.
  [[nodiscard]] virtual Result<void> begin(const SeenFrame& frame) = 0;
  /// Draws the light's mask into the target of its slot: all of it.
  [[nodiscard]] virtual Result<void> paint(const SeenFrame& frame, const MaskLight& light,
                                           shadow::LightStats& stats) = 0;
  /// Per triangle of the surfaces: 1 where no shadow is known (Shading::unshadowed); empty: on none.
  [[nodiscard]] virtual std::span<const std::uint8_t> unshadowed() const { return {}; }
};

using MaskPainterMaker = std::function<std::unique_ptr<MaskPainter>()>;

/// The vertex shader of passes over all of the target, which draw three vertices without a buffer.
[[nodiscard]] std::string_view screenVertexSource();

/// A technique of a painter: draws the surfaces, asks for each light's mask, and makes the picture from them. Lights with an extent are the mean of the
/// masks of their points (shadow::lightSamples), summed up on the graphics card; draw() takes all SoftSampling::samples of them.
/// `context`: as of makeStencilTechnique().
[[nodiscard]] std::unique_ptr<GlTechnique> makeMaskTechnique(const shadow::Traits& traits, MaskPainterMaker makePainter,
                                                             std::shared_ptr<gl::Context> context);

}  // namespace umbrage::render
