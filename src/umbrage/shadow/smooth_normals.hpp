#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/base/angle.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::shadow {

/// Normals for smooth shading, one for each corner of each triangle, in the sense of Surfaces::normal of that triangle.
struct SmoothNormals {
  struct Corner {
    Vec3f normal;  ///< unit
    float slack =
        0.0f;  ///< sine of the largest angle between it and the normals it is the mean of, and theirs of each other's
  };
  std::vector<std::array<Corner, 3>> corners;  ///< per triangle

  [[nodiscard]] bool empty() const { return corners.empty(); }
};

/// At each corner the mean, by angle, of the normals of those triangles around the point that are within `crease` of the triangle's own. Windings
/// mean nothing: normals that point away from each other are turned, which takes two sides of a sheet for one and wants creases below 90 degrees.
[[nodiscard]] SmoothNormals smoothNormals(const scene::Surfaces& surfaces, Angle crease);

}  // namespace umbrage::shadow
