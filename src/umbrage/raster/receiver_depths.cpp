#include "umbrage/raster/receiver_depths.hpp"

#include <algorithm>
#include <bit>

#include "umbrage/raster/bands.hpp"

namespace umbrage::raster {
namespace {

// Single precision may call a patch nearer that is a little farther away.
constexpr double kFarther = 1.0 - 0x1p-20;

}  // namespace

UMBRAGE_VECTOR_UNITS ReceiverDepths::Depths ReceiverDepths::depthsOf(const float* nearness, std::uint64_t receivers) {
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

Result<void> ReceiverDepths::findAll(int columns, int rows,
                                     const std::function<Depths(std::size_t block)>& depthsOfBlock) {
  stride_ = (static_cast<std::size_t>(columns) + 15) & ~std::size_t{7};
  const auto count = static_cast<std::size_t>(rows), tileRows = (count + kTileBlocks - 1) / kTileBlocks;
  farthest_.assign(stride_ * count, kNothing), nearest_.assign(stride_ * count, 0.0f);
  ofRow_.assign(count, kNothing), ofTileRow_.resize(tileRows);
  ofTile_.assign(stride_ * tileRows, kNothing);
  return parallel::forEach(static_cast<int>(tileRows), [&](int tileRow) {
    for (int row = tileRow * kTileBlocks; row < std::min(rows, (tileRow + 1) * kTileBlocks); ++row) {
      for (int column = 0; column < columns; ++column) {
        const auto block =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
        const std::size_t at = start(row) + static_cast<std::size_t>(column);
        const Depths depths = depthsOfBlock(block);
        farthest_[at] = depths.farthest, nearest_[at] = depths.nearest;
        float& ofRow = ofRow_[static_cast<std::size_t>(row)];
        ofRow = std::min(ofRow, depths.farthest);
      }
    }
    findTiles(tileRow, rows);
  });
}

Result<void> ReceiverDepths::find(const SeenBlocks& seen, std::span<const std::uint64_t> receivers) {
  return findAll(seen.nearness.columns, seen.nearness.rows, [&](std::size_t block) {
    const BlockSummary& summary = seen.summary[block];
    if (receivers[block] == 0) return Depths{};
    if (receivers[block] == summary.covered) return Depths{summary.farthest, summary.nearest};
    return depthsOf(seen.nearness.blocks[block].pixel.data(), receivers[block]);
  });
}

Result<void> ReceiverDepths::find(const BlockImage<float>& nearness, const VeilLayers& veils,
                                  std::span<const std::uint64_t> receivers, std::vector<Depths>& ofSurface) {
  ofSurface.resize(veils.surfaceCount());
  return findAll(nearness.columns, nearness.rows, [&](std::size_t block) {
    const std::size_t surface = veils.surface(block);
    Depths all = ofSurface[surface] = depthsOf(nearness.blocks[block].pixel.data(), receivers[surface]);
    for (std::size_t l = 0; l < veils.count(block); ++l) {
      const Depths depths = ofSurface[surface + 1 + l] =
          depthsOf(veils.layers[veils.first[block] + l].nearness.data(), receivers[surface + 1 + l]);
      all = {std::min(all.farthest, depths.farthest), std::max(all.nearest, depths.nearest)};
    }
    return all;
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
