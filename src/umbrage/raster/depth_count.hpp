#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/raster/scan_line.hpp"

namespace umbrage::raster {

/// The depth counts of F. Crow along a scan line: how many caster surfaces lie between what the row shows and the light. Shadow polygons, the sides of
/// shadow volumes, are active where the line crosses them; each changes the count of a run from where it covers the run and lies before the
/// surface, and back where it ends or dives behind it.
/// Source: F. Crow, shadow algorithms for computer graphics, 1977; P. Bergeron, a general version of Crow's shadow volumes, 1986.
class DepthCount {
 public:
  explicit DepthCount(int width) : change_(static_cast<std::size_t>(width) + 1, 0) {}

  /// Calls fn(pixels, count) for the pieces of each run on which the count is one, from left to right.
  /// `sides`: patches with a weight, as ActiveList has them for row y. `atEye`: the count at the eye.
  template <class Fn>
  void visit(std::span<const Run> runs, std::span<const ActivePatch> sides, int y, int atEye, const Fn& fn) {
    open_.clear();
    std::size_t next = 0;
    for (const Run& run : runs) {
      std::erase_if(open_, [&](const Open& s) { return s.covered.end <= run.pixels.begin; });
      for (; next < sides.size() && sides[next].covered.begin < run.pixels.end; ++next)
        if (sides[next].covered.end > run.pixels.begin) open(sides[next], y);
      change(run, y);
      int count = atEye, from = run.pixels.begin;
      for (int x = run.pixels.begin; x < run.pixels.end; ++x) {
        std::int32_t& here = change_[static_cast<std::size_t>(x)];
        if (here == 0) continue;
        if (x > from) fn(Stretch{from, x}, count);
        count += here, from = x, here = 0;
      }
      change_[static_cast<std::size_t>(run.pixels.end)] = 0;
      fn(Stretch{from, run.pixels.end}, count);
    }
  }

 private:
  struct Open {
    Stretch covered;
    std::int32_t weight;
    Slope plane;
    double distance;
  };
  void open(const ActivePatch& side, int y);
  void change(const Run& run, int y);
  std::vector<Open> open_;            ///< the sides over the run that is worked on
  std::vector<std::int32_t> change_;      ///< per pixel of the row: what the count changes by there
};

}  // namespace umbrage::raster
