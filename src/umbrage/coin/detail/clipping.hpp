#pragma once

#include <memory>
#include <span>
#include <vector>

#include "umbrage/coin/detail/shape_triangles.hpp"

class SoState;

namespace umbrage::coin::detail {

/// What is drawn lies where dot(normal, p) >= distance, in the world.
struct ClipPlane {
  Vec3 normal{0.0};
  double distance = 0.0;
  friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

[[nodiscard]] std::vector<ClipPlane> clipPlanesAt(SoState* state);

/// What planes leave of a shape; the shape itself where they leave all of it. Neighbouring triangles are cut at the same points.
[[nodiscard]] std::shared_ptr<const ShapeTriangles> clipped(const std::shared_ptr<const ShapeTriangles>& shape,
                                                            const Mat4& toWorld, std::span<const ClipPlane> planes);

}  // namespace umbrage::coin::detail
