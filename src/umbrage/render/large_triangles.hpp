#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/render/view.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// A triangle whose depth the fragment shader works out, as std430 lays it out.
/// Along a ray from the eye, whose component along the view is 1, the triangle's plane has 1 / depth = plane.xyz . ray, at most plane.w
/// within the triangle. A negative plane.w: the eye is too close to the plane for that, and interpolated depth serves better.
struct LargeTriangle {
  Vec4f plane;
  std::uint32_t id;
  std::array<std::uint32_t, 3> unused;
};

/// What of a scene is drawn for one view, and how.
/// 1. Left out are triangles that cannot be seen: outside the picture; the averted faces of convex solids that the eye is outside
///    of; and those in whose plane the eye lies (liesInPlane), which single precision might tilt into view: the ground, for an eye
///    at its very height, would cover half the picture.
struct Arrangement {
  std::vector<std::uint32_t> ordinary;  ///< ascending
  /// That reach farther than their distance to the eye. What a rasteriser interpolates over them, in single precision from corners far
  /// off the screen, is right to about 2^-16 of the depth; what these planes give is right to 2^-22.
  std::vector<LargeTriangle> large;
};

/// Which surfaces: to most techniques all are opaque.
enum class Drawn { all, opaque, veils };

/// A view of `width` x `height` pixels. Of solids with veils averted faces are not left out but where all are drawn as opaque: they are seen.
/// REQUIRES: view is one of viewOf(Camera).
[[nodiscard]] Arrangement arrange(const shadow::Geometry& geometry, const View& view, int width, int height,
                                  Drawn drawn = Drawn::all);

}  // namespace umbrage::render
