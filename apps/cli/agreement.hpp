#pragma once

#include "umbrage/shadow/edge_finder.hpp"

namespace umbrage::cli {

/// How far two techniques agree about one light.
struct Agreement {
  std::size_t differing = 0;  ///< pixels whose mask differs
  std::size_t astray = 0;     ///< those that no true shadow or depth edge comes near
  std::size_t covered = 0;    ///< pixels with a surface
  double rms = 0.0;           ///< root of the mean square difference of the light (0 to 1) over these

  [[nodiscard]] bool holds() const { return astray == 0; }
};

/// Per light of `frame`, which pixels of `mine` differ from `reference`. A pixel that differs is astray unless an edge of the
/// reference is within `tolerance` pixels, or `edges` finds one near it.
[[nodiscard]] Result<std::vector<Agreement>> compareMasks(std::span<const shadow::LightMask> mine,
                                                          std::span<const shadow::LightMask> reference,
                                                          const shadow::Frame& frame, int tolerance,
                                                          const shadow::EdgeFinder& edges);

}  // namespace umbrage::cli
