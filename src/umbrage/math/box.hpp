#pragma once

#include <limits>

#include "umbrage/math/vec.hpp"

namespace umbrage {

/// An axis-parallel box; empty until something is added.
struct Box3 {
  Vec3 min{std::numeric_limits<double>::infinity()};
  Vec3 max{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void add(const Vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void add(const Box3& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  /// (0,0,0) for an empty box, as are size and radius.
  [[nodiscard]] Vec3 centre() const { return empty() ? Vec3(0.0) : 0.5 * (min + max); }
  [[nodiscard]] Vec3 size() const { return empty() ? Vec3(0.0) : max - min; }
  /// Half the diagonal.
  [[nodiscard]] double radius() const { return 0.5 * glm::length(size()); }
};

/// Whether a box, widened by `margin` on all sides, meets the way from `from` to `to`, which is homogeneous: a point, or with w = 0 a direction
/// that is followed to infinity.
[[nodiscard]] bool meetsWay(const Box3& box, double margin, const Vec3& from, const Vec4& to);

}  // namespace umbrage
