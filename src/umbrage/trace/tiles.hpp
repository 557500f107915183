#pragma once

#include <functional>

#include "umbrage/base/error.hpp"

namespace umbrage::trace {

/// A block of pixels: x in [x0, x1), y in [y0, y1).
struct Tile {
  int x0, y0, x1, y1;
};

/// Calls `work` for every tile of a picture, in many threads at once; returns when all are done. Tiles start at multiples of 4
/// columns and 2 rows, so packets of 4 x 2 pixels never straddle two of them.
/// Errors: ErrorCode::device when memory runs out.
[[nodiscard]] Result<void> forEachTile(int width, int height, const std::function<void(const Tile&)>& work);

/// The pixels of the packet whose corner is (x, y), lane by lane: fn(lane, x, y) for those inside the tile.
template <class Fn>
void forEachLane(const Tile& tile, int x, int y, Fn&& fn) {
  for (int k = 0; k < 8; ++k)
    if (x + (k & 3) < tile.x1 && y + (k >> 2) < tile.y1) fn(k, x + (k & 3), y + (k >> 2));
}

}  // namespace umbrage::trace
