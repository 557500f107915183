#pragma once

#include <vector>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::cli {

/// How far two techniques agree about the light on the surfaces that let light through.
struct VeilAgreement {
  std::size_t veils = 0;      ///< of all pixels, as the reference shows them
  std::size_t differing = 0;  ///< lit otherwise by more than 1/255 in a channel, or not shown alike
  std::size_t astray = 0;     ///< those that no edge of light, or of any such surface, comes near

  [[nodiscard]] bool holds() const { return astray == 0; }
};

/// Per light of `frame`. Veils are shown alike where they are as many and at the same depths: which of two neighbours shows at their common edge is left to rounding.
/// An edge is where neighbours within `tolerance` pixels have another number of veils, or other light on the one at the same place in the order of depth; or where samples by `truth` show
/// the like within one pixel: 32 x 32 of them, and 16 x 16 within 1/256 pixel of its centre, the grid to which rasterisers snap corners; there a border of two of `filters` is an edge, too.
/// REQUIRES: both are of `frame`, by techniques that are tinted; `truth` is prepared for its geometry and tinted. Errors: the truth's own.
[[nodiscard]] Result<std::vector<VeilAgreement>> compareVeils(const shadow::Shading& mine,
                                                              const shadow::Shading& reference,
                                                              const shadow::Frame& frame,
                                                              const shadow::Filters& filters, int tolerance,
                                                              shadow::Technique& truth);

}  // namespace umbrage::cli
