#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/base/error.hpp"
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
  image::UnsetVector<std::uint16_t>
      codes;  ///< per pixel, row by row from the bottom: 0 where all lights reach or nothing is seen, else i + 1 for all[i]
  std::vector<Subset> all;  ///< those that occur
};

/// What may light what a pixel shows: per pixel a triangle, per triangle the lights that shine on it, as bits. Empty: all on all.
struct Shining {
  const image::Image<std::uint32_t>* triangle = nullptr;
  std::span<const std::uint64_t> lights;
};

/// REQUIRES: masks of one size; at most kMostLights. Errors: ErrorCode::device when memory runs out.
inline constexpr std::size_t kMostLights = 64;
[[nodiscard]] Result<Subsets> subsetsOf(std::span<const shadow::LightMask> masks, const Shining& shining = {});

/// How many subsets 8 bits of stencil tell apart beside those pixels that all lights reach and those whose turn it is not.
inline constexpr std::size_t kPerRound = 254;
[[nodiscard]] std::size_t roundsOf(const Subsets& subsets);
inline constexpr std::uint8_t kNotNow = 255;
/// Around all subsets, from the lower left of the picture.
[[nodiscard]] gl::Rect boxOf(const Subsets& subsets);
/// The stencil of a round inside a box: i + 1 for the i-th subset of the round, 0 where all lights reach (in the first round), else kNotNow.
/// Errors: as subsetsOf().
[[nodiscard]] Result<image::UnsetVector<std::uint8_t>> stencilOf(const Subsets& subsets, std::size_t round,
                                                                 const gl::Rect& box);

}  // namespace umbrage::coin::detail
