#pragma once

#include <algorithm>

#include "umbrage/raster/receiver_depths.hpp"

namespace umbrage::raster {

/// One of a patch's functions at one pixel of a block, rounded as whoever goes down the rows from `rows.begin` does.
[[nodiscard]] inline float valueAt(const BlockPatch& p, const Span& rows, int k, int x, int y) {
  float value = (p.at[k] + p.dy[k] * static_cast<float>(rows.begin)) + p.dx[k] * static_cast<float>(x);
  for (int row = rows.begin; row < y; ++row) value += p.dy[k];
  return value;
}

/// Eight blocks beside each other.
struct EightBlocks {
  Int8 covered;           ///< lanes of blocks that a patch covers wholly, before all that they show
  std::uint32_t touched;  ///< blocks of which it may cover a part, a bit each
};

/// `farthest`, `nearest`: of the receivers of each, as ReceiverDepths has them.
UMBRAGE_IN_BLOCKS EightBlocks lookAtEight(const BlockPatch& p, const float* farthest, const float* nearest) {
  const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  Float8 low, high;
  __builtin_memcpy(&low, farthest, sizeof low), __builtin_memcpy(&high, nearest, sizeof high);
  const Float8 plane = p.at[3] + (kBlock * p.dx[3]) * lane;
  Int8 touched = plane + (p.above[3] + p.doubt[3]) >= low * p.distance;
  Int8 covered = plane + (p.below[3] - p.doubt[3]) > high * (p.distance * (1.0f + 0x1p-20f));
  for (int k = 0; k < 3; ++k) {
    const Float8 edge = p.at[k] + (kBlock * p.dx[k]) * lane;
    touched &= edge + p.above[k] >= -p.doubt[k];
    covered &= edge + p.below[k] > p.doubt[k];
  }
  covered &= touched;
  return {covered, bitsOf(touched & ~covered)};
}

/// Adds to the lanes of `sums` that are set.
UMBRAGE_IN_BLOCKS void addWhere(const Int8& lanes, std::int32_t amount, std::int32_t* sums) {
  Int8 sum;
  __builtin_memcpy(&sum, sums, sizeof sum);
  sum += lanes & amount;
  __builtin_memcpy(sums, &sum, sizeof sum);
}

/// Calls fn(column, row) for the groups of eight blocks in rows [first, last) in which a patch may be nearer than a receiver. `tiles`: of the row of
/// tiles, as ReceiverDepths::tilesBehind tells them.
template <class Fn>
UMBRAGE_IN_BLOCKS void forEachEight(const ReceiverDepths& depths, const Patch& patch, std::uint64_t tiles, int first,
                                    int last, const Fn& fn) {
  const int begin = std::max(first, patch.y0 / kBlock), end = std::min(last, (patch.y1 + kBlock - 1) / kBlock);
  for (int row = begin; row < end; ++row) {
    const float farthest = depths.farthestOfRow(row);
    if (farthest >= ReceiverDepths::kNothing) continue;
    const Span columns = columnsOf(patch, row, row + 1, double(farthest) * (1.0 - 0x1p-20));
    for (int column = columns.begin & ~(kTileBlocks - 1); column < columns.end; column += kTileBlocks)
      if ((tiles >> std::min(63, column / kTileBlocks) & 1u) != 0) fn(column, row);
  }
}

/// Whether a patch is nearer than a triangle seen at a pixel, in double precision.
[[nodiscard]] inline bool isBefore(const Corners& corners, const Patch& patch, const mesh::Triangle& triangle, int px,
                                   int py) {
  const Vec3 pixel(px + 0.5, py + 0.5, 1.0);
  return patch.at(3, pixel.x, pixel.y) > nearnessOf(corners.mapped, triangle, pixel) * patch.distance;
}

}  // namespace umbrage::raster
