#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/image/image.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::shadow {

/// Parts of light per channel, 65535 being all.
struct Tint {
  std::uint16_t r, g, b;
  friend bool operator==(const Tint&, const Tint&) = default;
};
inline constexpr Tint kFullTint{65535, 65535, 65535};
/// From parts from 0 to 1, and back.
[[nodiscard]] Tint tintOf(const Vec3f& parts);
[[nodiscard]] inline Vec3 partsOf(const Tint& tint) { return Vec3(tint.r, tint.g, tint.b) / 65535.0; }

/// How much of one light reaches each pixel's surface: the one product of every technique.
/// light: 0 (umbra, or the visible side does not face the light, or outside a spot's cone) .. 255 (lit); between: soft.
/// tint: empty, or per channel, where coloured transparent casters are told apart; then `light` is its luminance, and both are of the first
/// opaque surface.
/// veils: with a tint, the same for every veil of the frame's VeilBuffer.
/// covered: 1 where a surface is seen (with a tint: an opaque one), else 0 (light is 0 there).
struct LightMask {
  image::GreyImage light;
  image::Image<Tint> tint;
  image::GreyImage covered;
  image::UnsetVector<Tint> veils;
};

/// The luminance, as an 8-bit code.
[[nodiscard]] std::uint8_t luminanceCode(const Tint& tint);

/// The mask as a file holds it: 128 where there is no surface.
[[nodiscard]] image::GreyImage fileImage(const LightMask& mask);
/// The same of a tinted mask, per channel. REQUIRES: it has a tint.
[[nodiscard]] image::RgbImage tintedFileImage(const LightMask& mask);

/// Whether two masks say different things of a pixel: of tints, whether they are more than 1/255 apart in a channel.
[[nodiscard]] bool differAt(const LightMask& a, const LightMask& b, int x, int y);

/// How two masks of one view differ.
struct MaskDifference {
  std::size_t differing = 0;  ///< pixels where either covered or light differs
  /// Those farther than `edgeTolerance` pixels (Chebyshev) from a nonzero pixel of `edges`.
  std::size_t farFromEdge = 0;
  std::size_t covered = 0;  ///< pixels where the truth sees a surface
};

/// `edges`: nonzero where a true shadow or depth edge touches a pixel (edgePixels of the truth, or the caller's own).
[[nodiscard]] MaskDifference compare(const LightMask& mask, const LightMask& truth, const image::GreyImage& edges,
                                     int edgeTolerance = 1);

/// Pixels of `truth` that have a 4-neighbour with another light or covered value: shadow edges and the scene's outline, as far
/// as one sample a pixel shows them.
[[nodiscard]] image::GreyImage edgePixels(const LightMask& truth);

}  // namespace umbrage::shadow
