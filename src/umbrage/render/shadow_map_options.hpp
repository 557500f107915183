#pragma once

#include <cstdint>

namespace umbrage::render {

/// How shadow maps are made and looked up.
struct ShadowMapOptions {
  /// Texels a side; 0: as many as the picture's own sampling asks for, in whole multiples of 64. At most what the driver draws.
  int texels = 0;
  /// Texels around the nearest that are compared too (percentage-closer filtering): (2 n + 1) x (2 n + 1) of them; 0: the nearest alone, and hard shadows.
  int filter = 1;
  /// Of the depth of what a map shows: so much nearer to the light than the surface a caster must be.
  double constantBias = 1.0 / 16384.0;
  /// Likewise, in how much the surface's own depth changes from one texel to the next. The depth is compared with that of the surface's plane in the middle of
  /// each texel, so that flat surfaces need almost none; this is for curved ones and for concave edges.
  double slopeBias = 0.25;
  std::uint64_t mostBytes = std::uint64_t{256}
                            << 20;  ///< of graphics memory for the map, when the number of texels is chosen
};
inline constexpr int kLargestFilter = 16;

}  // namespace umbrage::render
