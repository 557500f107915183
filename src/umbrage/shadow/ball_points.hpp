#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "umbrage/math/vec.hpp"

namespace umbrage::shadow {

inline constexpr std::size_t kBallPoints = 256;

/// Points of the unit ball that are seen from anywhere as an evenly filled disc: along every direction they lie as those of a disc
/// do. Each run of 2^n of them that begins at a multiple of 2^n, n from 3 to 8, does so for its number.
/// REQUIRES: i < kBallPoints.
[[nodiscard]] Vec3 ballPoint(std::size_t i);

}  // namespace umbrage::shadow
