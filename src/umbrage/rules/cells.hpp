#pragma once

#include <span>

#include "umbrage/outline/region.hpp"

// What the points of a grid stand for, as shapes.
namespace umbrage::rules {

/// The middle of a cell, and whether its cell is wanted.
struct CellMiddle {
  Vec2 at{0.0};
  bool wanted = false;
};

/// The cells of side `step` that are wanted, put together. REQUIRES: step > 0; the middles lie on one lattice of that step.
[[nodiscard]] outline::Region cellsOf(std::span<const CellMiddle> middles, double step);

/// The same, cut to a region; what of it no cell covers goes with the nearest middle.
/// 1. What is wanted and what is not are the region together, and do not overlap.
/// REQUIRES: as cellsOf.
[[nodiscard]] outline::Region cellsWithin(const outline::Region& region, std::span<const CellMiddle> middles,
                                          double step);

}  // namespace umbrage::rules
