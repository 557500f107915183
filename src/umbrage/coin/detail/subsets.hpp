#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/gl/pass_state.hpp"
#include "umbrage/shadow/light_mask.hpp"

namespace umbrage::coin::detail {

/// Pixels that exactly the same lights do not reach.
struct Subset {
  std::vector<std::size_t> off;  ///< lights that do not reach; never empty
  gl::Rect box;                  ///< around its pixels, from the lower left of the picture
};

/// A picture cut up by which lights reach.
struct Subsets {
  int width = 0, height = 0;
  std::vector<std::uint8_t>
      codes;  ///< per pixel, row by row from the bottom: 0 where all lights reach or nothing is seen, else i + 1 for all[i]
  std::vector<Subset> all;  ///< those that occur, at most 255
  std::size_t left = 0;     ///< pixels whose subset is one too many: code 0
};

/// REQUIRES: masks of one size; at most 64.
[[nodiscard]] Subsets subsetsOf(std::span<const shadow::LightMask> masks);

}  // namespace umbrage::coin::detail
