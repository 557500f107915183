#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/image/image.hpp"

namespace umbrage::report::detail {

/// Colours counted in cells of 8 x 8 x 8 codes.
class ColourCount {
 public:
  struct Cell {
    std::uint64_t count = 0, r = 0, g = 0, b = 0;  ///< sums of codes
  };
  ColourCount() : cells_(kCells) {}
  void add(const image::RgbImage& picture);
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

  static constexpr std::size_t kCells = 32 * 32 * 32;
  [[nodiscard]] static std::size_t cellOf(image::Rgb8 c) {
    return std::size_t{c.r} / 8 * 1024 + std::size_t{c.g} / 8 * 32 + std::size_t{c.b} / 8;
  }

 private:
  std::vector<Cell> cells_;
};

/// At most 256 colours that stand for the counted ones, by cutting the most varied group at its mean until there are enough.
/// Source: Heckbert, color image quantization for frame buffer display, 1982; cut at the mean after Wan et al., 1990.
class Palette {
 public:
  explicit Palette(const ColourCount& count);
  [[nodiscard]] const std::vector<image::Rgb8>& colours() const { return colours_; }
  /// The nearest palette colour per pixel.
  [[nodiscard]] image::GreyImage indices(const image::RgbImage& picture) const;

 private:
  std::vector<image::Rgb8> colours_;
  std::vector<std::uint8_t> nearest_;  ///< per cell, nearest to its counted mean, or to its middle
};

}  // namespace umbrage::report::detail
