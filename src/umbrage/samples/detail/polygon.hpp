#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "umbrage/math/vec.hpp"

namespace umbrage::samples::detail {

/// Ear clipping of a simple counter-clockwise polygon, convex or not; indices into it.
[[nodiscard]] std::vector<std::array<std::size_t, 3>> triangulate(const std::vector<Vec2>& outline);

/// A unit sphere of 20 x 4^n triangles wound outwards.
struct Sphere {
  std::vector<Vec3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};
[[nodiscard]] Sphere icosphere(int subdivisions);

}  // namespace umbrage::samples::detail
