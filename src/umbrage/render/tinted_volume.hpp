#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/render/prepare_light.hpp"
#include "umbrage/shadow/filters.hpp"

namespace umbrage::render {

/// So many layers are counted in the stencil beside two marks.
inline constexpr int kTintedStencil = 63;

/// What a piece of a volume adds where it counts: opaque surfaces, and what veils take.
struct TintWeight {
  std::int32_t opaque = 0;
  shadow::FilterSum filter{};
};

/// A side or a cap on its way to the graphics card, as std430 lays it out. Corners are indices into doubled vertices (shadow::ShadowVolume); a side is the
/// triangles of corners 0, 1, 2 and 0, 2, 3, a cap that of 0, 1, 2. Where it shows its front it adds `weight`, else it takes it away.
/// It is either opaque, and then counts one, or tinted, and then counts no opaque surface.
struct TintedPiece {
  std::array<std::uint32_t, 4> corners;
  TintWeight weight;
};
static_assert(sizeof(TintedPiece) == 32);

/// Pieces that are counted alike, in TintedVolume::pieces: those of opaque casters first.
struct PieceRange {
  std::size_t first = 0, opaque = 0, tinted = 0;
  [[nodiscard]] IndexRange all() const { return {first, opaque + tinted}; }
  [[nodiscard]] IndexRange ofOpaque() const { return {first, opaque}; }
  [[nodiscard]] IndexRange ofTinted() const { return {first + opaque, tinted}; }
};

/// What one light's shadow volumes are made of where casters let light through. Computed without OpenGL.
struct TintedVolume {
  std::vector<TintedPiece> pieces;
  /// What counts before the surfaces that are seen, and what counts behind them, whose weights are negative already.
  PieceRange passSides, passCaps, failSides, failCaps;
  std::vector<Vec4f> farPoints;   ///< shadow::farPoints
  std::vector<std::int8_t> side;  ///< per caster triangle: Silhouette::side; 0 where it has no part in the volumes
  TintWeight atEye;               ///< where the sums start
  bool fitsStencil = false;       ///< no ray meets more opaque layers than kTintedStencil

  [[nodiscard]] bool hasTinted() const {
    return passSides.tinted + passCaps.tinted + failSides.tinted + failCaps.tinted > 0 ||
           atEye.filter != shadow::FilterSum{};
  }
};

/// Only `counting` zFail or zPass. As prepareVolume, but
/// 1. sums instead of counts: no sum has too many layers, so there are no groups;
/// 2. caps count at every depth: of those that lie before a surface the crossings of the way from the eye take back what they counted (by raster, to the pixel);
/// 3. casters in whose plane the eye lies are seen by nobody and have no crossings: their caps count where they lie before a surface.
/// REQUIRES: `request.finder` is of `geometry.casters`; its silhouettes are not used.
/// Fills all of `stats` but its reason.
[[nodiscard]] TintedVolume prepareTinted(const shadow::Geometry& geometry, const VolumeRequest& request,
                                         shadow::LightStats& stats, const PhaseEnd& ended = {});

}  // namespace umbrage::render
