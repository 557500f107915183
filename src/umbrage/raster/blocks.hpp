#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "umbrage/base/vector_units.hpp"
#include "umbrage/image/image.hpp"
#include "umbrage/raster/patch.hpp"

/// Inlined into functions with UMBRAGE_VECTOR_UNITS, and compiled as they are.
#define UMBRAGE_IN_BLOCKS [[gnu::always_inline]] inline

namespace umbrage::raster {

/// A row of a block.
using Float8 = float __attribute__((vector_size(32), may_alias));
using Int8 = std::int32_t __attribute__((vector_size(32), may_alias));

/// The lanes as an array: under GCC 12's -fsanitize=bounds subscripts of vectors come out wrong.
template <class T, class Vector>
UMBRAGE_IN_BLOCKS std::array<T, sizeof(Vector) / sizeof(T)> lanesOf(const Vector& v) {
  std::array<T, sizeof(Vector) / sizeof(T)> lanes;
  __builtin_memcpy(&lanes, &v, sizeof lanes);
  return lanes;
}
/// Bit k: lane k is not 0.
UMBRAGE_IN_BLOCKS std::uint32_t bitsOf(const Int8& v) {
  std::uint32_t bits = 0;
  const auto lanes = lanesOf<std::int32_t>(v);
  for (std::size_t k = 0; k < lanes.size(); ++k) bits |= (lanes[k] != 0 ? 1u : 0u) << k;
  return bits;
}
UMBRAGE_IN_BLOCKS bool anyOf(const Int8& v) {
  const auto lanes = lanesOf<std::uint64_t>(v);  // in half as many steps
  return ((lanes[0] | lanes[1]) | (lanes[2] | lanes[3])) != 0;
}

inline constexpr int kBlock = 8;       ///< pixels a side
inline constexpr int kBandBlocks = 2;  ///< rows of blocks in a band, which one thread works on
inline constexpr int kTileBlocks = 8;  ///< blocks in a tile, in either direction
inline constexpr int kBand = kBlock * kBandBlocks;

/// A picture in blocks of 8 x 8 pixels, each in one piece of memory, row by row.
template <class T>
struct BlockImage {
  int columns = 0, rows = 0;  ///< of blocks
  struct alignas(64) Block {
    std::array<T, kBlock * kBlock> pixel;
  };
  std::vector<Block> blocks;

  /// For a picture of that size; what it holds then means nothing.
  void resize(int width, int height) {
    columns = (width + kBlock - 1) / kBlock, rows = (height + kBlock - 1) / kBlock;
    blocks.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  }
  void fillRows(int begin, int end, T value) {
    for (std::size_t i = index(0, begin); i < index(0, end); ++i) blocks[i].pixel.fill(value);
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  [[nodiscard]] const T& at(int x, int y) const {
    return blocks[index(x / kBlock, y / kBlock)].pixel[static_cast<std::size_t>(y % kBlock * kBlock + x % kBlock)];
  }
};

/// What belongs to each of a patch's four functions.
using Float4 = float __attribute__((vector_size(16)));

/// A patch over squares beside each other (blocks or tiles), in single precision, from the centre of the first pixel of the first.
struct BlockPatch {
  Float4 at, dx, dy;    ///< of the four functions; what they change by from pixel to pixel
  Float4 above, below;  ///< how far above and below `at` they come within a square
  Float4 doubt;         ///< what single precision may be wrong by, over eight squares
  float distance;
};
/// `column`, `row`: of squares of kSide x kSide pixels.
template <int kSide>
UMBRAGE_IN_BLOCKS void overSquares(const Patch& patch, int column, int row, BlockPatch& out) {
  const double px = kSide * column + 0.5, py = kSide * row + 0.5;
  const Double4 at = patch.c + patch.x * px + patch.y * py;
  const Double4 size = at < 0.0 ? -at : at, sizeX = patch.x < 0.0 ? -patch.x : patch.x;
  const Double4 sizeY = patch.y < 0.0 ? -patch.y : patch.y;
  const Double4 doubt = 0x1p-20 * (size + (8 * kSide) * sizeX + kSide * sizeY) + patch.slack;
  out.at = __builtin_convertvector(at, Float4);
  out.dx = __builtin_convertvector(patch.x, Float4);
  out.dy = __builtin_convertvector(patch.y, Float4);
  out.doubt = __builtin_convertvector(doubt, Float4);
  const auto last = static_cast<float>(kSide - 1);
  const Float4 none{}, acrossX = last * out.dx, acrossY = last * out.dy;
  out.above = (acrossX > none ? acrossX : none) + (acrossY > none ? acrossY : none);
  out.below = (acrossX < none ? acrossX : none) + (acrossY < none ? acrossY : none);
  out.distance = static_cast<float>(patch.distance);
}
/// Over the block so many columns further right.
UMBRAGE_IN_BLOCKS void moveOn(BlockPatch& patch, int columns) {
  patch.at += (kBlock * static_cast<float>(columns)) * patch.dx;
}

/// Columns of blocks, or rows of a block.
struct Span {
  int begin, end;
};
/// The rows of the blocks of a row that a patch's extent holds.
UMBRAGE_IN_BLOCKS Span rowsOf(const Patch& patch, int blockRow) {
  return {std::max(0, patch.y0 - kBlock * blockRow), std::min(kBlock, patch.y1 - kBlock * blockRow)};
}
/// The columns in which a patch may have pixels of the rows of blocks [begin, end), no farther away than `farthest` (nearness).
UMBRAGE_IN_BLOCKS Span columnsOf(const Patch& patch, int begin, int end, double farthest) {
  const Span extent{patch.x0 / kBlock, (patch.x1 + kBlock - 1) / kBlock};
  if (extent.end - extent.begin <= 1) return extent;
  const double y0 = kBlock * begin + 0.5, y1 = kBlock * end - 0.5;
  const Double4 first = patch.y * y0, last = patch.y * y1;
  const Double4 behind{0.0, 0.0, 0.0, farthest * patch.distance};
  const Double4 highest = patch.c + patch.slack + (first > last ? first : last) - behind;
  const auto most = lanesOf<double>(highest), border = lanesOf<double>(-highest / patch.x),
             slope = lanesOf<double>(patch.x);
  double low = patch.x0, high = patch.x1;
  for (std::size_t k = 0; k < 4; ++k) {
    if (slope[k] > 0.0)
      low = std::max(low, border[k]);
    else if (slope[k] < 0.0)
      high = std::min(high, border[k]);
    else if (most[k] <= 0.0)
      return {0, 0};
  }
  if (!(high >= low - 1.0)) return {0, 0};
  // A pixel of margin; the extent holds anyway.
  const int from = std::max(patch.x0, static_cast<int>(std::min(low, 1e9)) - 2);
  const int to = std::min(patch.x1, static_cast<int>(std::max(high, -1e9)) + 2);
  return from < to ? Span{from / kBlock, (to + kBlock - 1) / kBlock} : Span{0, 0};
}

/// Calls fn(block, first pixel of the row in the block, x, y, pixels) for every piece of a row of pixels of a band of a picture.
template <class Fn>
void forEachRowPiece(int columns, int width, int height, int band, const Fn& fn) {
  for (int y = band * kBand; y < std::min(height, (band + 1) * kBand); ++y)
    for (int column = 0; column < columns; ++column)
      fn(static_cast<std::size_t>(y / kBlock) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column),
         static_cast<std::size_t>(y % kBlock * kBlock), column * kBlock, y, std::min(kBlock, width - column * kBlock));
}

}  // namespace umbrage::raster
