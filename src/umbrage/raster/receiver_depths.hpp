#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "umbrage/raster/layers.hpp"
#include "umbrage/raster/surfaces.hpp"

namespace umbrage::raster {

/// How far away the pixels are that a light is to be counted for, block by block: what lies behind all of them changes nothing.
class ReceiverDepths {
 public:
  /// Farther than everything, so no patch is nearer: what stands for blocks without such pixels.
  static constexpr float kNothing = 0x1p120f;

  /// `receivers`: per block of `seen`, bit k is set when pixel k is one of them.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> find(const SeenBlocks& seen, std::span<const std::uint64_t> receivers);

  /// Nearness of a block's farthest and nearest receiver.
  struct Depths {
    float farthest = kNothing, nearest = 0.0f;
  };
  /// The same with veils: `receivers` and `ofSurface` per surface, as VeilLayers numbers them.
  [[nodiscard]] Result<void> find(const BlockImage<float>& nearness, const VeilLayers& veils,
                                  std::span<const std::uint64_t> receivers, std::vector<Depths>& ofSurface);

  /// Of a row of blocks, in whole groups of eight and one more: nearness of the farthest, and of the nearest, receiver of each.
  [[nodiscard]] const float* farthest(int row) const { return farthest_.data() + start(row); }
  [[nodiscard]] const float* nearest(int row) const { return nearest_.data() + start(row); }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] float farthestOfRow(int row) const { return ofRow_[static_cast<std::size_t>(row)]; }

  /// The tiles of a row of tiles in which a patch may be nearer than a receiver, a bit each; bit 63 for all from there on.
  [[nodiscard]] std::uint64_t tilesBehind(const Patch& patch, int row) const;

 private:
  [[nodiscard]] std::size_t start(int row) const { return static_cast<std::size_t>(row) * stride_; }
  void findTiles(int row, int rows);
  [[nodiscard]] static Depths depthsOf(const float* nearness, std::uint64_t receivers);
  [[nodiscard]] Result<void> findAll(int columns, int rows,
                                     const std::function<Depths(std::size_t block)>& depthsOfBlock);
  std::size_t stride_ = 0;
  std::vector<float> farthest_, nearest_, ofRow_;
  std::vector<float> ofTile_, ofTileRow_;  ///< eight tiles and more a row, and of each row
};

}  // namespace umbrage::raster
