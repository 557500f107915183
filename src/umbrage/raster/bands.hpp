#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "umbrage/parallel/for_each.hpp"
#include "umbrage/raster/blocks.hpp"

namespace umbrage::raster {

/// Patches, and per band of the picture those that touch it. Kept from frame to frame for its memory.
class Bands {
 public:
  /// Calls make(i, patch) for every i in [0, count); what it makes (true) is kept, in the order of i, in the bands of its extent. For each row
  /// of tiles touches(patch, row) tells the tiles it is to be looked at in, a bit each, bit 63 for all from there on; none: not in these bands.
  template <class Make, class Touches>
  [[nodiscard]] Result<void> fill(std::size_t count, int height, const Make& make, const Touches& touches) {
    // Enough parts for all threads, none so small that its lists cost more than its patches.
    const std::size_t size = std::clamp<std::size_t>(count / 16, 128, 4096);
    bands_ = (height + kBand - 1) / kBand;
    const auto parts = static_cast<int>((count + size - 1) / size);
    if (parts_.size() < static_cast<std::size_t>(parts)) parts_.resize(static_cast<std::size_t>(parts));
    used_ = static_cast<std::size_t>(parts);
    return parallel::forEach(parts, [&](int number) {
      Part& part = parts_[static_cast<std::size_t>(number)];
      part.patches.clear();
      part.inBand.resize(static_cast<std::size_t>(bands_));
      for (auto& list : part.inBand) list.clear();
      const std::size_t begin = static_cast<std::size_t>(number) * size, end = std::min(count, begin + size);
      Patch patch;
      for (std::size_t i = begin; i < end; ++i)
        if (make(i, patch)) part.add(patch, touches);
    });
  }

  [[nodiscard]] int count() const { return bands_; }
  [[nodiscard]] std::size_t patchCount() const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < used_; ++i) sum += parts_[i].patches.size();
    return sum;
  }

  [[nodiscard]] std::size_t entryCount() const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < used_; ++i)
      for (const auto& list : parts_[i].inBand) sum += list.size();
    return sum;
  }

  /// Calls fn(patch, tiles) for those that touch a band, in their order.
  template <class Fn>
  void forEachIn(int band, const Fn& fn) const {
    for (std::size_t i = 0; i < used_; ++i)
      for (const Entry& e : parts_[i].inBand[static_cast<std::size_t>(band)]) fn(parts_[i].patches[e.patch], e.tiles);
  }

 private:
  struct Entry {
    std::uint64_t tiles;
    std::uint32_t patch;
  };
  struct Part {
    std::vector<Patch> patches;
    std::vector<std::vector<Entry>> inBand;

    template <class Touches>
    void add(const Patch& patch, const Touches& touches) {
      constexpr int kTile = kBlock * kTileBlocks, kBandsInTile = kTileBlocks / kBandBlocks;
      if (patch.x0 >= patch.x1 || patch.y0 >= patch.y1) return;
      const int begin = patch.y0 / kBand, end = (patch.y1 + kBand - 1) / kBand;
      bool touched = false;
      for (int row = patch.y0 / kTile; row * kTile < patch.y1; ++row) {
        const std::uint64_t tiles = touches(patch, row);
        if (tiles == 0) continue;
        touched = true;
        for (int band = std::max(begin, row * kBandsInTile); band < std::min(end, (row + 1) * kBandsInTile); ++band)
          inBand[static_cast<std::size_t>(band)].push_back({tiles, static_cast<std::uint32_t>(patches.size())});
      }
      if (touched) patches.push_back(patch);
    }
  };
  std::vector<Part> parts_;
  std::size_t used_ = 0;
  int bands_ = 0;
};

}  // namespace umbrage::raster
