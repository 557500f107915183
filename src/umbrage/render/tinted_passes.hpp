#pragma once

#include <memory>
#include <span>

#include "umbrage/image/image.hpp"
#include "umbrage/render/tinted_volume.hpp"
#include "umbrage/render/uniforms.hpp"
#include "umbrage/render/veil_lists.hpp"

namespace umbrage::render {

/// The uniform block Tinted of the shaders, as std140 lays it out.
struct TintedBlock {
  Vec4f eyeHigh, eyeLow;  ///< relative to the origin of the positions
  Vec4f scale;            ///< one step of a filter; the distance below which surfaces count as one
  std::int32_t firstLayer = 0, litLayers = 0, hasVeils = 0, width = 0, pixelCount = 0, light = 0;
  std::int32_t hasSums = 1, unused = 0;
};

/// What the passes of one frame work on.
struct TintedFrame {
  gl::HostScope& scope;
  const GpuScene& scene;   ///< arranged apart
  const GpuFrame& target;  ///< its opaque surfaces are drawn; it has tints, and layers where veils are lit by themselves
  const VeilLists& veils;
  gl::PassState placement;  ///< depths are reversed
  TintedBlock block;

  /// Veils of any pixel that are lit by themselves, at most.
  [[nodiscard]] std::size_t layers() const {
    return std::min(veils.most(), static_cast<std::size_t>(block.litLayers));
  }
};

/// What one light's passes need.
struct TintedLight {
  int number = 0;  ///< in the frame
  ViewBlock view;
  ShadingBlock shading;
  gl::Rect volumeArea, litArea;
};

/// The passes that sum up, by the depth test and by blending, what lies between surfaces and a light, and what is made of the sums.
/// Sums are whole numbers in two parts (tinted_volume.vert), each added up in single precision: exact in any order while no pixel lies before or behind more than
/// 2^24 / 512 = 32,768 surfaces' worth of sides.
/// REQUIRES: its context is current when it is made, used and destroyed. Light by light.
class TintedPasses {
 public:
  /// Errors: ErrorCode::device when memory is short.
  [[nodiscard]] static Result<std::unique_ptr<TintedPasses>> make(const shadow::Geometry& geometry);
  ~TintedPasses();

  /// Of a scene, for pictures. Errors: as make().
  [[nodiscard]] Result<void> setMaterials(std::span<const scene::Material> materials);

  /// `facing`: per surface: its visible side faces the light; `side`: per surface: TintedVolume::side, empty before it is known. Errors: as make().
  [[nodiscard]] Result<void> setLight(const TintedFrame& frame, const TintedLight& light, std::span<const std::uint8_t> facing,
                                      std::span<const std::int8_t> side);
  /// How far its receivers are, for ReceiverTiles. REQUIRES: setLight().
  [[nodiscard]] Result<image::Image<Vec2f>> receivers(const TintedFrame& frame);
  [[nodiscard]] Result<void> setVolume(const TintedVolume& volume);
  /// Draws the volumes and works out the tints of all surfaces. REQUIRES: setLight() with sides, and setVolume().
  /// Errors: as make().
  [[nodiscard]] Result<void> reach(const TintedFrame& frame, const TintedLight& light, const PhaseEnd& ended);
  /// Of the light of the last reach(): per pixel, row by row from the bottom, then per veil: 16 bits a channel, of 64.
  [[nodiscard]] const gl::Buffer& tints() const { return tints_; }

  // Pictures. `shading`: without light, with the sky. REQUIRES: setMaterials(); the frame has a picture.
  [[nodiscard]] Result<void> beginPicture(const TintedFrame& frame, const gl::Buffer& shading);
  [[nodiscard]] Result<void> addLight(const TintedFrame& frame, int light);
  [[nodiscard]] Result<void> endPicture(const TintedFrame& frame, const gl::Buffer& shading, std::size_t lights);

 private:
  struct Programs;
  /// How pieces count.
  enum Counted { before, behind, everywhere };
  TintedPasses();
  [[nodiscard]] Result<void> setBlock(const TintedFrame& frame, int firstLayer, int light);
  [[nodiscard]] Result<void> setPatterns(std::size_t pieces);
  void begin(const TintedFrame& frame, const TintedLight& light, bool layers);
  void mark(const TintedFrame& frame, const gl::Rect& area, bool layers);
  void sum(const TintedFrame& frame, const TintedLight& light, bool layers);
  void drawPieces(gl::Pass& pass, const TintedFrame& frame, const IndexRange& sides, const IndexRange& caps);
  void countOpaque(const TintedFrame& frame, const gl::Rect& area, Counted counted);
  void addTinted(const TintedFrame& frame, const gl::Rect& area, bool layers, Counted counted);
  void writeTints(const TintedFrame& frame, bool layers, bool lit);

  std::unique_ptr<Programs> programs_;
  gl::Buffer faces_, bits_, block_, view_, shading_, pieces_, farPoints_, tints_, veilLight_, colours_, passing_;
  std::array<gl::Buffer, 3> counted_;
  gl::Buffer quads_, triangles_;  ///< indices of sides and of caps, piece by piece
  gl::VertexArray quadVertices_{quads_}, triangleVertices_{triangles_}, screen_;
  std::size_t patterns_ = 0;  ///< pieces that the indices reach
  PieceRange passSides_, passCaps_, failSides_, failCaps_;
  TintWeight atEye_;
  bool byStencil_ = false;   ///< opaque casters are counted in the stencil, for the opaque surfaces
  bool hasTinted_ = false;
};

}  // namespace umbrage::render
