#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/math/vec.hpp"
#include "umbrage/mesh/mesh.hpp"

namespace umbrage::io::reader {

struct PlaneCorner {
  Vec2 at;
  std::uint32_t index;  ///< whose corner this is outside the plane
};
/// The first ring runs counter-clockwise where it can be told, the holes clockwise.
using PlanePolygon = std::vector<std::vector<PlaneCorner>>;

/// Twice the signed area of a triangle, of a ring.
[[nodiscard]] double turn(const Vec2& a, const Vec2& b, const Vec2& c);
[[nodiscard]] double doubleArea(const std::vector<PlaneCorner>& ring);

/// Law 2 of triangulate for any rings at all, valid or not: where no corner is a proper ear the least bad one is cut.
/// Time grows with the square of the corners.
/// Source: Eberly, Triangulation by ear clipping, 2002.
[[nodiscard]] std::vector<mesh::Triangle> clipEars(const PlanePolygon& polygon);

}  // namespace umbrage::io::reader
