#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/math/vec.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::render {

/// A triangle whose depth the fragment shader works out, as std430 lays it out.
/// Along a ray from the eye, whose component along the view is 1, the triangle's plane has 1 / depth = plane.xyz . ray, at most plane.w
/// within the triangle. A negative plane.w: the eye is too close to the plane for that, and interpolated depth serves better.
struct LargeTriangle {
  Vec4f plane;
  std::uint32_t id;
  std::array<std::uint32_t, 3> unused;
};

/// How the triangles of a scene are drawn for one eye.
struct Arrangement {
  /// In whose plane the eye lies (liesInPlane). They are not seen, but single precision might tilt them into view: the ground,
  /// for an eye at its very height, would cover half the picture.
  std::vector<std::uint32_t> edgeOn;
  /// That reach farther than their distance to the eye. What a rasteriser interpolates over them, in single precision from corners far
  /// off the screen, is right to about 2^-16 of the depth; what these planes give is right to 2^-22.
  std::vector<LargeTriangle> large;
};

/// `eye`: relative to surfaces.origin; `forward`: unit, the direction of view.
[[nodiscard]] Arrangement arrange(const scene::Surfaces& surfaces, const Vec3& eye, const Vec3& forward);

}  // namespace umbrage::render
