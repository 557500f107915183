#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::shadow {

/// A convex polygon in the plane of a grid of directions, whose cells are the unit squares; at most a triangle cut by five half-spaces.
struct GridPolygon {
  std::array<Vec2, 10> corners;
  int size = 0;
  void add(const Vec2& p) { corners[size++] = p; }
};

/// A square of resolution x resolution cells of directions; the outermost ones hold what lies beyond them too.
class GridCells {
 public:
  explicit GridCells(int resolution) : resolution_(resolution) {}
  [[nodiscard]] std::size_t count() const { return std::size_t(resolution_) * std::size_t(resolution_); }
  [[nodiscard]] std::size_t of(const Vec2& p) const { return index(cell(p.x), cell(p.y)); }

  /// Calls fn(cell) for the cells that a polygon touches, until fn returns false; true when it never did. A hair's breadth beside the polygon counts too,
  /// so that a point of what was projected is never in a cell that was left out.
  template <class Fn>
  bool visit(const GridPolygon& polygon, const Fn& fn) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i < polygon.size; ++i) {
      low = std::min(low, polygon.corners[i].y);
      high = std::max(high, polygon.corners[i].y);
    }
    for (int row = cell(low - kSlack); row <= cell(high + kSlack); ++row)
      if (!visitRow(polygon, row, fn)) return false;
    return true;
  }

 private:
  // Rounding of projected coordinates, in cells: generous, since a cell too many does no harm.
  static constexpr double kSlack = 1e-6;

  [[nodiscard]] int cell(double v) const {
    return v > 0.0 ? (v < resolution_ ? static_cast<int>(v) : resolution_ - 1) : 0;
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return std::size_t(row) * std::size_t(resolution_) + std::size_t(column);
  }

  // The cells of one row that the polygon touches: the extent in x of its part between y = row and y = row + 1.
  template <class Fn>
  bool visitRow(const GridPolygon& polygon, int row, const Fn& fn) const {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    const auto take = [&](double x) {
      left = std::min(left, x);
      right = std::max(right, x);
    };
    // The outermost rows also hold what lies beyond the border.
    constexpr double kBeyond = std::numeric_limits<double>::infinity();
    const double bottom = row == 0 ? -kBeyond : row - kSlack, top = row == resolution_ - 1 ? kBeyond : row + 1 + kSlack;
    for (int i = 0; i < polygon.size; ++i) {
      const Vec2 a = polygon.corners[i], b = polygon.corners[(i + 1) % polygon.size];
      if (a.y >= bottom && a.y <= top) take(a.x);
      for (const double y : {bottom, top})
        if ((a.y < y) != (b.y < y)) take(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    if (left > right) return true;
    for (int column = cell(left - kSlack); column <= cell(right + kSlack); ++column)
      if (!fn(index(column, row))) return false;
    return true;
  }

  int resolution_;
};

/// Calls visit(triangle, corners relative to the light) for every counted triangle.
template <class Visit>
void forEachCounted(const CasterSet& casters, const Silhouette& silhouette, const Visit& visit) {
  const Vec3 light = silhouette.light.w != 0.0 ? Vec3(silhouette.light) : Vec3(0.0);
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
    if (silhouette.side[t] == 0) continue;
    std::array<Vec3, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = casters.corner(t, k) - light;
    visit(t, corners);
  }
}

/// A direction as a grid has it.
struct GridPlace {
  int face;
  Vec2 at;
};

/// How a light sees its casters: one square of parallel rays. Points are relative to the light, or to the casters' origin for a direction.
class ParallelView {
 public:
  /// The square is laid around the counted triangles, but for those that lie so far off the others that they would take it away from them.
  ParallelView(const CasterSet& casters, const Silhouette& silhouette, int resolution);

  static constexpr int kFaces = 1;
  /// Calls fn(face, polygon) for the parts of a triangle on each face.
  template <class Fn>
  void pieces(const std::array<Vec3, 3>& corners, const Fn& fn) const {
    GridPolygon polygon;
    for (const Vec3& c : corners) polygon.add(inCells(c));
    fn(0, polygon);
  }
  [[nodiscard]] std::optional<GridPlace> placeOf(const Vec3& point) const { return GridPlace{0, inCells(point)}; }

 private:
  [[nodiscard]] Vec2 inCells(const Vec3& p) const { return (flat(p) - low_) * scale_; }
  [[nodiscard]] Vec2 flat(const Vec3& p) const { return {glm::dot(p, u_), glm::dot(p, v_)}; }
  Vec3 u_, v_;
  Vec2 low_;
  double scale_ = 1.0;
};

/// The same around a point light: the six faces of a cube.
class CubeView {
 public:
  CubeView(const CasterSet&, const Silhouette&, int resolution) : resolution_(resolution) {}

  static constexpr int kFaces = 6;
  template <class Fn>
  void pieces(const std::array<Vec3, 3>& corners, const Fn& fn) const {
    for (int face = 0; face < kFaces; ++face)
      if (const GridPolygon polygon = project(face, corners); polygon.size > 0) fn(face, polygon);
  }
  /// None at the light itself.
  [[nodiscard]] std::optional<GridPlace> placeOf(const Vec3& point) const;

 private:
  [[nodiscard]] GridPolygon project(int face, const std::array<Vec3, 3>& corners) const;
  int resolution_;
};

}  // namespace umbrage::shadow
