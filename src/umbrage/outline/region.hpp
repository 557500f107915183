#pragma once

#include <vector>

#include "umbrage/math/vec.hpp"

namespace umbrage::outline {

/// Corners in order; the first is not repeated at the end.
using Ring = std::vector<Vec2>;

/// The outer ring runs counter-clockwise, holes clockwise; x is east, y north.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

/// A part of a plane: polygons that do not overlap. `area` is theirs without the holes', in square units of the coordinates.
struct Region {
  std::vector<Polygon> polygons;
  double area = 0.0;
};

/// Signed: positive for counter-clockwise rings.
[[nodiscard]] double areaOf(const Ring& ring);
[[nodiscard]] double areaOf(const Polygon& polygon);

}  // namespace umbrage::outline
