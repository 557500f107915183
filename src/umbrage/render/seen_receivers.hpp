#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/render/view.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::render {

/// A half-space of points relative to the eye: dot(xyz, p) + w >= 0.
using HalfSpace = Vec4;

/// The part of a convex polygon inside a half-space, into `out`; empty when nothing is left.
void clip(std::span<const Vec3> polygon, const HalfSpace& inside, std::vector<Vec3>& out);

/// What one pixel of a coarse grid over the picture shows.
struct ViewSample {
  Vec2 pixel;  ///< from the top left
  std::uint32_t triangle;
};

/// The surfaces that lie in the picture, in points relative to the eye; what hides what is known at the samples alone.
struct SeenReceivers {
  struct Polygon {
    std::uint32_t triangle, begin, end;  ///< end - begin corners in `points`
  };
  std::vector<Vec3> points;
  std::vector<Polygon> polygons;    ///< the triangles, each cut off at the borders of the picture
  std::vector<ViewSample> samples;  ///< where a surface is seen
  [[nodiscard]] std::span<const Vec3> corners(const Polygon& p) const {
    return std::span(points).subspan(p.begin, p.end - p.begin);
  }
};
/// REQUIRES: view is viewOf(camera, ..).
[[nodiscard]] SeenReceivers seenReceivers(const scene::Surfaces& surfaces, const View& view,
                                          const scene::Camera& camera);

}  // namespace umbrage::render
