#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/raster/stretch.hpp"
#include "umbrage/shadow/caster_set.hpp"

namespace umbrage::raster {

/// A surface along a row.
struct SurfaceRow {
  Slope nearness;
  int y = 0;
  double size = 0.0;  ///< the largest absolute sum that its nearness is made of
};
/// REQUIRES: a patch of makeSurfacePatch.
[[nodiscard]] SurfaceRow surfaceRow(const PixelSpace& space, const Patch& surface, int y);

/// The edges of casters projected from a light onto surfaces, along scan lines. The plane through the light and an edge cuts a surface in a line, so along a
/// row of pixels that show the surface the distance from it, in the measure of homogeneous pixels, is linear: the row crosses the
/// projected edge in one place.
/// 1. The two triangles at an edge find the same place, to the pixel: their shadows leave no gap.
/// Source: A. Appel, some techniques for shading machine renderings of solids, 1968; W. J. Bouknight and K. Kelley, an algorithm for
/// producing half-tone computer graphics presentations with shadows and movable light sources, 1970.
class ProjectedEdges {
 public:
  /// `side`: Silhouette::side; triangles with 0 are left out. `corners`: the positions of `casters` mapped by `space`, and the light.
  ProjectedEdges(const PixelSpace& space, const shadow::CasterSet& casters, std::span<const std::int8_t> side,
                 const Corners& corners);

  /// The pixels of a stretch, all of which show a surface, that a caster triangle hides from the light.
  [[nodiscard]] Stretch shadow(std::uint32_t triangle, const SurfaceRow& surface, Stretch pixels) const;

 private:
  /// Above 0 on one side of a plane: dot(normal, p) + level for points p of the pixel space.
  struct Plane {
    Vec3 normal{0.0};
    double level = 0.0;
    [[nodiscard]] Slope along(const SurfaceRow& s) const {
      return {normal.y * (s.y + 0.5) + normal.z + level * s.nearness.at0, normal.x + level * s.nearness.perPixel};
    }
  };
  /// The triangle's own plane, and those through the light and its sorted edges.
  struct Caster {
    Plane own, ab, bc, ac;
    int towards = 0;  ///< the sign of `own` at the light; 0: left out
  };
  [[nodiscard]] static Plane planeThrough(const Vec3& a, const Vec3& along, const Vec3& other);

  double width_, height_;
  std::vector<Caster> casters_;
};

}  // namespace umbrage::raster
