#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/math/vec.hpp"
#include "umbrage/outline/region.hpp"

namespace umbrage::outline::detail {

/// Clipping is exact on whole numbers: a region is worked out on a grid that is finer than 1e-9 of its size, and nothing is
/// decided by a tolerance.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};
using Loop = std::vector<GridPoint>;

/// What an axis-parallel rectangle covers.
struct Extent {
  Vec2 min{1e300};
  Vec2 max{-1e300};
  void add(const Vec2& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void add(const Extent& e) {
    min = glm::min(min, e.min);
    max = glm::max(max, e.max);
  }
  [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y); }
  [[nodiscard]] bool touches(const Extent& e) const {
    return min.x <= e.max.x && e.min.x <= max.x && min.y <= e.max.y && e.min.y <= max.y;
  }
};

/// The grid over an extent: steps of a power of two, at most 2^29 of them from the middle to the farthest side.
class Grid {
 public:
  explicit Grid(const Extent& extent);
  Grid(const Vec2& origin, double step) : origin_(origin), step_(step) {}
  [[nodiscard]] GridPoint snap(const Vec2& p) const;
  [[nodiscard]] Vec2 place(const GridPoint& p) const { return origin_ + step_ * Vec2(double(p.x), double(p.y)); }
  [[nodiscard]] double step() const { return step_; }

 private:
  Vec2 origin_{0.0};
  double step_ = 1.0;
};

/// Twice the signed area.
[[nodiscard]] inline std::int64_t turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Where the loops' winding numbers, added, are not zero. Holes narrower than a step of the grid are closed: they are the rounding of
/// a seam.
[[nodiscard]] Region unite(const std::vector<Loop>& loops, const Grid& grid);

/// Where the winding numbers of `loops` are not zero and those of `others` are, or both are not. Polygons narrower than a step are left
/// out: they are the rounding of a border that both have.
enum class Set { difference, intersection };
[[nodiscard]] std::vector<Loop> combine(const std::vector<Loop>& loops, const std::vector<Loop>& others, Set set);

}  // namespace umbrage::outline::detail
