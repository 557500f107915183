#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/scene/surfaces.hpp"

namespace umbrage::shadow {

/// A plane of the world: a point of it, and its normal, of any length but zero.
struct Plane {
  Vec3 point{0.0};
  Vec3 normal{0.0, 0.0, 1.0};
};

/// Which planes of a scene are looked for.
struct PlaneSearch {
  std::size_t most = 64;  ///< the largest by the area of what lies in them; at most kMostPlanes
  /// What lies in a plane has at least this part of the square of the diagonal of the casters' box (of all surfaces where nothing casts).
  double leastShare = 1.0 / 400.0;
  std::vector<Plane> given;  ///< if any: these, however small, and no others
};
inline constexpr std::size_t kMostPlanes = 127;

/// A plane, and the surfaces that lie in it.
struct ScenePlane {
  Vec4 equation{0.0};  ///< unit normal and distance: dot(xyz, p) + w = 0 for its points p, relative to Surfaces::origin
  double area = 0.0;
  Box3 bounds;  ///< of the triangles in it, relative to the same
};

/// Planes of a scene with the triangles that lie in them.
struct ScenePlanes {
  std::vector<ScenePlane>
      planes;  ///< those found from the largest; those given in their order, whether or not anything lies in them
  std::vector<std::uint8_t> planeOf;  ///< per triangle of the surfaces: 1 + its plane, or 0
};

/// 1. A triangle lies in a plane when its corners do, up to what rounding of coordinates to single precision moves them.
/// 2. Triangles without area lie in none.
[[nodiscard]] ScenePlanes findPlanes(const scene::Surfaces& surfaces, const PlaneSearch& search = {});

}  // namespace umbrage::shadow
