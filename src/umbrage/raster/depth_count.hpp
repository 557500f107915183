#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/raster/scan_line.hpp"

namespace umbrage::raster {

/// The depth counts of F. Crow along a scan line: how many caster surfaces lie between what the row shows and the light. Shadow polygons, the
/// sides of shadow volumes, are active where the line crosses them; each changes the count from where it covers a run and lies before its surface, and
/// back where it ends or dives behind it. Over pieces of the row before or behind all of whose surfaces it lies, one look settles it.
/// Source: F. Crow, shadow algorithms for computer graphics, 1977; P. Bergeron, a general version of Crow's shadow volumes, 1986.
class DepthCount {
 public:
  explicit DepthCount(int width)
      : change_(static_cast<std::size_t>(width) + 1, 0),
        pieces_(static_cast<std::size_t>((width + kPiece - 1) / kPiece)) {}

  /// Calls fn(pixels, count) for the parts of each run on which the count is one, from left to right.
  /// `sides`: patches with a weight, as ActiveList has them for row y, in any order. `atEye`: the count at the eye.
  template <class Fn>
  void visit(std::span<const Run> runs, std::span<const ActivePatch> sides, int y, int atEye, const Fn& fn) {
    look(runs, y);
    for (const ActivePatch& side : sides) add(side, runs, y);
    int count = atEye, x = 0;
    for (const Run& run : runs) {
      for (; x <= run.pixels.begin; ++x) count += change_[static_cast<std::size_t>(x)];
      int from = run.pixels.begin;
      for (; x < run.pixels.end; ++x) {
        const std::int32_t here = change_[static_cast<std::size_t>(x)];
        if (here == 0) continue;
        fn(Stretch{from, x}, count);
        count += here, from = x;
      }
      fn(Stretch{from, run.pixels.end}, count);
    }
    std::fill(change_.begin(), change_.end(), 0);
  }

 private:
  static constexpr int kPiece = 32;  ///< pixels
  struct Piece {
    std::size_t firstRun = 0;              ///< that ends in it or after it
    double farthest = 0.0, nearest = 0.0;  ///< nearness of what the runs show; none above 0 where there are none
  };
  void look(std::span<const Run> runs, int y);
  void add(const ActivePatch& side, std::span<const Run> runs, int y);
  void change(const Stretch& pixels, int weight) {
    change_[static_cast<std::size_t>(pixels.begin)] += weight;
    change_[static_cast<std::size_t>(pixels.end)] -= weight;
  }

  std::vector<std::int32_t> change_;  ///< per pixel of the row: what the count changes by there
  std::vector<Piece> pieces_;
};

}  // namespace umbrage::raster
