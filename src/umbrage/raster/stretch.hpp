#pragma once

#include "umbrage/raster/patch.hpp"

namespace umbrage::raster {

/// Pixels of a row: [begin, end).
struct Stretch {
  int begin = 0, end = 0;
  [[nodiscard]] bool empty() const { return begin >= end; }
  friend bool operator==(const Stretch&, const Stretch&) = default;
};
[[nodiscard]] inline Stretch meet(const Stretch& a, const Stretch& b) {
  return {a.begin > b.begin ? a.begin : b.begin, a.end < b.end ? a.end : b.end};
}

/// A linear function along a row.
struct Slope {
  double at0 = 0.0, perPixel = 0.0;
  /// At the centre of a pixel; rounding keeps it monotonous.
  [[nodiscard]] double at(int x) const { return at0 + perPixel * (x + 0.5); }
};
/// One of a patch's functions along row y.
[[nodiscard]] inline Slope alongRow(const Patch& patch, std::size_t function, int y) {
  return {patch.c[function] + patch.y[function] * (y + 0.5), patch.x[function]};
}

/// The pixels of `within` where a function is above a limit, by what Slope::at says of each of them.
[[nodiscard]] Stretch above(const Slope& function, double limit, Stretch within);

/// The pixels of a row that a patch covers: those of which Patch::covers is true, which is exact.
[[nodiscard]] Stretch coveredInRow(const Patch& patch, const Corners& corners, int y);

/// Where a patch's edges cross scan lines: from row to row each moves on by the same step.
class Crossings {
 public:
  explicit Crossings(const Patch& patch);
  /// The same as coveredInRow, which it asks where an edge passes so near to the centre of a pixel that rounding might decide.
  [[nodiscard]] Stretch covered(const Patch& patch, const Corners& corners, int y) const;

 private:
  struct Edge {
    double at0, perRow;  ///< crosses the line at height y at at0 + perRow * y
    double doubt;        ///< how far off that may be
    bool begins;         ///< what is covered lies to the right of it
  };
  std::array<Edge, 3> edges_;
};

}  // namespace umbrage::raster
