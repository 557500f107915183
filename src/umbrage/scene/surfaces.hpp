#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "umbrage/math/box.hpp"
#include "umbrage/mesh/mesh.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::scene {

/// Every triangle of a scene in one welded list, in single precision around an origin: what all techniques, on the CPU and on
/// the GPU, work on, so that all see bit-identical geometry.
///
/// 1. positions are world - origin, rounded to float once. The origin is (0,0,0) unless the scene lies far from it, so files
///    near their origin keep their exact coordinates.
/// 2. positions holds no two identical points; triangles' corners are in lexicographic order of position (their winding is
///    lost, surfaces are two-sided), so identical triangles are identical rows.
/// 3. Triangles that name fewer than three different points after rounding are left out and counted.
struct Surfaces {
  Vec3 origin{0.0};
  std::vector<Vec3f> positions;
  std::vector<mesh::Triangle> triangles;
  std::vector<std::uint32_t> materials;  ///< per triangle: index into Scene::materials
  std::vector<std::uint32_t> instances;  ///< per triangle: index into Scene::instances
  std::vector<std::uint8_t> casts;       ///< per triangle: 1 when its instance casts
  Box3 bounds;                           ///< of all positions (relative to origin)
  Box3 casterBounds;                     ///< of the corners of casting triangles (relative to origin)
  std::size_t dropped = 0;               ///< triangles left out by law 3

  /// A corner in double precision, relative to the origin.
  [[nodiscard]] Vec3 corner(std::uint32_t triangle, int k) const { return Vec3(positions[triangles[triangle][k]]); }
  /// Unnormalised normal of a triangle from its sorted corners, (B-A) x (C-A), in double precision. Its sense means nothing.
  [[nodiscard]] Vec3 normal(std::uint32_t triangle) const {
    const Vec3 a = corner(triangle, 0);
    return glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
  }
};

[[nodiscard]] Surfaces flatten(const Scene& scene);

/// How flatten() made points of instances one: per point of every instance, in their order, its index in Surfaces::positions.
struct Welding {
  std::vector<std::uint32_t> position;
};
[[nodiscard]] Surfaces flatten(const Scene& scene, Welding& welding);

/// The surfaces of a scene of which nothing changed but poses.
/// 1. They are those of flatten(scene), bit by bit, in a part of the time.
/// 2. None where other points would become one than before, so that triangles would be connected differently: then flatten() is needed.
/// REQUIRES: `before` and `welding` are from flatten() of the same meshes, instances in the same order.
[[nodiscard]] std::optional<Surfaces> flattenMoved(const Scene& scene, const Surfaces& before, const Welding& welding);

}  // namespace umbrage::scene
