#include "umbrage/raster/receiver_depths.hpp"

#include <algorithm>
#include <bit>

#include "umbrage/raster/bands.hpp"

namespace umbrage::raster {
namespace {

struct Depths {
  float farthest = ReceiverDepths::kNothing, nearest = 0.0f;
};

UMBRAGE_VECTOR_UNITS Depths depthsOf(const float* nearness, std::uint64_t receivers) {
  Depths d;
  if (receivers == ~std::uint64_t{0}) {
    Float8 low = reinterpret_cast<const Float8&>(nearness[0]), high = low;
    for (int row = 1; row < kBlock; ++row) {
      const Float8 v = reinterpret_cast<const Float8&>(nearness[row * kBlock]);
      low = v < low ? v : low, high = v > high ? v : high;
    }
    for (const float v : lanesOf<float>(low)) d.farthest = std::min(d.farthest, v);
    for (const float v : lanesOf<float>(high)) d.nearest = std::max(d.nearest, v);
    return d;
  }
  for (; receivers != 0; receivers &= receivers - 1) {
    const float v = nearness[std::countr_zero(receivers)];
    d.farthest = std::min(d.farthest, v), d.nearest = std::max(d.nearest, v);
  }
  return d;
}

// Single precision may call a patch nearer that is a little farther away.
constexpr double kFarther = 1.0 - 0x1p-20;

}  // namespace

void ReceiverDepths::findRow(const BlockImage<float>& nearness, std::span<const std::uint64_t> receivers, int row) {
  float& ofRow = ofRow_[static_cast<std::size_t>(row)] = kNothing;
  for (int column = 0; column < nearness.columns; ++column) {
    const std::size_t block = nearness.index(column, row), at = start(row) + static_cast<std::size_t>(column);
    const Depths depths = depthsOf(nearness.blocks[block].pixel.data(), receivers[block]);
    farthest_[at] = depths.farthest, nearest_[at] = depths.nearest;
    ofRow = std::min(ofRow, depths.farthest);
  }
}

void ReceiverDepths::findTiles(int row, int rows) {
  float& ofTileRow = ofTileRow_[static_cast<std::size_t>(row)] = kNothing;
  for (int y = row * kTileBlocks; y < std::min(rows, (row + 1) * kTileBlocks); ++y) {
    ofTileRow = std::min(ofTileRow, farthestOfRow(y));
    for (std::size_t column = 0; column < stride_; ++column) {
      float& ofTile = ofTile_[start(row) + column / kTileBlocks];
      ofTile = std::min(ofTile, farthest(y)[column]);
    }
  }
}

Result<void> ReceiverDepths::find(const BlockImage<float>& nearness, std::span<const std::uint64_t> receivers) {
  stride_ = (static_cast<std::size_t>(nearness.columns) + 15) & ~std::size_t{7};
  const auto rows = static_cast<std::size_t>(nearness.rows), tileRows = (rows + kTileBlocks - 1) / kTileBlocks;
  farthest_.assign(stride_ * rows, kNothing), nearest_.assign(stride_ * rows, 0.0f);
  ofRow_.resize(rows), ofTileRow_.resize(tileRows);
  ofTile_.assign(stride_ * tileRows, kNothing);
  return parallel::forEach(static_cast<int>(tileRows), [&](int tileRow) {
    for (int row = tileRow * kTileBlocks; row < std::min(nearness.rows, (tileRow + 1) * kTileBlocks); ++row)
      findRow(nearness, receivers, row);
    findTiles(tileRow, nearness.rows);
  });
}

UMBRAGE_VECTOR_UNITS std::uint64_t ReceiverDepths::tilesBehind(const Patch& patch, int row) const {
  constexpr int kTile = kBlock * kTileBlocks;
  const float farthest = ofTileRow_[static_cast<std::size_t>(row)];
  if (farthest >= kNothing) return 0;
  const Span columns = columnsOf(patch, row * kTileBlocks, (row + 1) * kTileBlocks, farthest * kFarther);
  std::uint64_t tiles = 0;
  const int end = (columns.end + kTileBlocks - 1) / kTileBlocks;
  for (int tile = columns.begin / kTileBlocks; tile < end; tile += 8) {
    const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
    BlockPatch p;
    overSquares<kTile>(patch, tile, row, p);
    Float8 low;
    __builtin_memcpy(&low, &ofTile_[start(row) + static_cast<std::size_t>(tile)], sizeof low);
    Int8 touched = (p.at[3] + (kTile * p.dx[3]) * lane) + (p.above[3] + p.doubt[3]) >= low * p.distance;
    for (int k = 0; k < 3; ++k) touched &= (p.at[k] + (kTile * p.dx[k]) * lane) + p.above[k] >= -p.doubt[k];
    std::uint32_t bits = bitsOf(touched) & (0xffu >> std::max(0, 8 - (end - tile)));
    for (; bits != 0; bits &= bits - 1) tiles |= std::uint64_t{1} << std::min(63, tile + std::countr_zero(bits));
  }
  return tiles;
}

}  // namespace umbrage::raster
