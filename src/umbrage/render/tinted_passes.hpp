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
  std::int32_t litLayers = 0, hasVeils = 0, width = 0, pixelCount = 0, light = 0;
  std::int32_t hasSums = 1, isFirst = 0, opaqueDark = 0;
  TintWeight atEye = {};  ///< where the sums of veils start
};

/// What the passes of one frame work on.
struct TintedFrame {
  gl::HostScope& scope;
  const GpuScene& scene;   ///< arranged apart
  const GpuFrame& target;  ///< its opaque surfaces are drawn; it has tints
  const VeilLists& veils;
  gl::PassState placement;  ///< depths are reversed
  TintedBlock block;
  ShadingBlock shading;  ///< without a light

  [[nodiscard]] bool lightsVeils() const { return veils.count() > 0 && block.litLayers > 0; }
};

/// What one light's passes need.
struct TintedLight {
  int number = 0;  ///< in the frame
  ViewBlock view;
  ShadingBlock shading;
  gl::Rect volumeArea, litArea;
};

/// The passes that sum up, by the depth test and by blending, what lies between surfaces and a light, and what is made of the sums.
/// For opaque surfaces sums are whole numbers in two parts (tinted_volume.vert), each added up in single precision by blending: exact in any order while no pixel lies
/// before or behind more than 2^24 / 512 = 32,768 surfaces' worth of sides. What is opaque is counted in the stencil where six bits do. For veils, any number of layers,
/// they are integers, added by atomic operations in one pass: a side adds to the first veil behind it, and what a veil has is carried on to those behind.
/// REQUIRES: its context is current when it is made, used and destroyed. Light by light.
class TintedPasses {
 public:
  /// Errors: ErrorCode::device when memory is short.
  [[nodiscard]] static Result<std::unique_ptr<TintedPasses>> make(const shadow::Geometry& geometry);
  ~TintedPasses();

  /// Of a scene, for pictures. Errors: as make().
  [[nodiscard]] Result<void> setMaterials(std::span<const scene::Material> materials);

  /// `facing`: per surface: its visible side faces the light; `side`: per surface: TintedVolume::side, empty before it is known. Errors: as make().
  [[nodiscard]] Result<void> setLight(const TintedFrame& frame, const TintedLight& light,
                                      std::span<const std::uint8_t> facing, std::span<const std::int8_t> side);
  /// Of another light than the tints are of, for addLight(). Errors: as make().
  [[nodiscard]] Result<void> setShading(const ShadingBlock& shading) { return shading_.setOne(shading); }
  /// How far its receivers are, for ReceiverTiles. REQUIRES: setLight().
  [[nodiscard]] Result<image::Image<Vec2f>> receivers(const TintedFrame& frame);
  [[nodiscard]] Result<void> setVolume(const TintedVolume& volume);
  /// What becomes of the light: tints of all surfaces; a share of a picture; or a picture with ambient light, in place of beginPicture().
  enum class Toward { tints, picture, newPicture };
  /// Draws the volumes and works out what reaches all surfaces.
  /// REQUIRES: setLight() with sides, and setVolume(); toward a picture what pictures require. Errors: as make().
  [[nodiscard]] Result<void> reach(const TintedFrame& frame, const TintedLight& light, Toward toward,
                                   const PhaseEnd& ended);
  /// Of the light of the last reach() toward tints: per pixel, row by row from the bottom, then per veil: 16 bits a channel, of 64.
  [[nodiscard]] const gl::Buffer& tints() const { return tints_; }

  /// Per surface: what shaders know of it.
  [[nodiscard]] const gl::Buffer& faces() const { return faces_; }

  // Pictures. `shading`: without light, with the sky. REQUIRES: setMaterials(); the frame has a picture.
  [[nodiscard]] Result<void> beginPicture(const TintedFrame& frame, const gl::Buffer& shading);
  /// By the tints.
  [[nodiscard]] Result<void> addLight(const TintedFrame& frame, int light);
  void endPicture(const TintedFrame& frame, const gl::Buffer& shading);

 private:
  struct Programs;
  /// How pieces count.
  enum Counted { before, behind, everywhere };
  static constexpr std::array kAllCounted{before, behind, everywhere};
  TintedPasses();
  [[nodiscard]] Result<void> setBlock(const TintedFrame& frame, int light, Toward toward);
  [[nodiscard]] Result<void> setPatterns(std::size_t pieces);
  void begin(const TintedFrame& frame, const TintedLight& light);
  void mark(const TintedFrame& frame, const TintedLight& light);
  void sum(const TintedFrame& frame, const TintedLight& light);
  void sumVeils(const TintedFrame& frame, const TintedLight& light);
  void drawPieces(gl::Pass& pass, const TintedFrame& frame, const IndexRange& sides, const IndexRange& caps);
  void countOpaque(const TintedFrame& frame, const gl::Rect& area, Counted counted);
  void addTinted(const TintedFrame& frame, const gl::Rect& area, Counted counted);
  void findFarthest(const TintedFrame& frame, const gl::Rect& area);
  void addToVeils(const TintedFrame& frame, const gl::Rect& area, Counted counted);
  void bindSurfaces(gl::Pass& pass, const TintedFrame& frame);
  template <class Draw>
  void forEachVeiled(const Draw& draw);
  void writeTints(const TintedFrame& frame, const TintedLight& light);
  void addAmbient(const TintedFrame& frame, const gl::Buffer& shading, const gl::StencilState& where);
  void addLit(const TintedFrame& frame, const TintedLight& light, Toward toward);
  [[nodiscard]] bool countsOpaque() const;

  std::unique_ptr<Programs> programs_;
  gl::Buffer faces_, bits_, block_, darkBlock_, view_, shading_, pieces_, farPoints_, tints_, veilSums_, materials_;
  std::array<gl::Buffer, 6> counted_;  ///< of opaque casters, then of veils
  gl::Buffer quads_, triangles_;       ///< indices of sides and of caps, piece by piece
  gl::VertexArray quadVertices_{quads_}, triangleVertices_{triangles_}, screen_;
  std::size_t patterns_ = 0;  ///< pieces that the indices reach
  PieceRange passSides_, passCaps_, failSides_, failCaps_;
  TintWeight atEye_;
  bool byStencil_ = false;  ///< opaque casters are counted in the stencil, for the opaque surfaces
  bool hasTinted_ = false;
};

}  // namespace umbrage::render
