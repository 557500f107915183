#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/image/image.hpp"
#include "umbrage/raster/blocks.hpp"

namespace umbrage::raster {

/// One surface for each pixel of a block, as SeenBlocks has it.
struct alignas(64) Layer {
  /// Where a pixel has no surface in this layer; nothing is nearer.
  static constexpr float kNone = 0x1p120f;
  std::array<float, kBlock * kBlock> nearness;
  std::array<std::uint32_t, kBlock * kBlock> triangle;  ///< shadow::kNoTriangle where there is none
};

/// The veils that pixels show one behind the other before an opaque surface, block by block, the nearest first.
struct VeilLayers {
  int columns = 0, rows = 0;       ///< of blocks
  std::vector<std::size_t> first;  ///< per block: its first layer; one more
  image::UnsetVector<Layer> layers;

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  [[nodiscard]] std::size_t count(std::size_t block) const { return first[block + 1] - first[block]; }
  /// Numbers what is known of all surfaces: per block first the opaque one, then its veils.
  [[nodiscard]] std::size_t surface(std::size_t block) const { return block + first[block]; }
  [[nodiscard]] std::size_t surfaceCount() const { return first.size() - 1 + layers.size(); }
};

}  // namespace umbrage::raster
