#pragma once

#include "umbrage/image/image.hpp"

namespace umbrage::shadow {

/// How much of one light reaches each pixel's surface: the one product of every technique.
/// light: 0 (umbra, or the visible side does not face the light, or outside a spot's cone) .. 255 (lit); between: soft.
/// tint: empty, or per channel, for coloured transparent casters; then `light` is its luminance.
/// covered: 1 where a surface is seen, else 0 (light is 0 there).
struct LightMask {
  image::GreyImage light;
  image::RgbImage tint;
  image::GreyImage covered;
};

/// The mask as a file holds it: 128 where there is no surface.
[[nodiscard]] image::GreyImage fileImage(const LightMask& mask);

/// How two masks of one view differ.
struct MaskDifference {
  std::size_t differing = 0;    ///< pixels where either covered or light differs
  std::size_t farFromEdge = 0;  ///< those farther than `edgeTolerance` pixels (Chebyshev) from a nonzero pixel of `edges`
  std::size_t covered = 0;      ///< pixels where the truth sees a surface
};

/// `edges`: nonzero where a true shadow or depth edge touches a pixel (edgePixels of the truth, or the caller's own).
[[nodiscard]] MaskDifference compare(const LightMask& mask, const LightMask& truth, const image::GreyImage& edges,
                                     int edgeTolerance = 1);

/// Pixels of `truth` that have a 4-neighbour with another light or covered value: shadow edges and the scene's outline, as far
/// as one sample a pixel shows them.
[[nodiscard]] image::GreyImage edgePixels(const LightMask& truth);

}  // namespace umbrage::shadow
