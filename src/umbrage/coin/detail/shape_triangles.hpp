#pragma once

#include <memory>
#include <span>

#include "umbrage/mesh/mesh.hpp"

namespace umbrage::coin::detail {

/// The triangles of one shape in its own space, by what they do to light. Null where there are none; what is fully transparent is left out.
struct ShapeTriangles {
  std::shared_ptr<const mesh::Mesh> opaque;
  std::shared_ptr<const mesh::Mesh> veiled;  ///< part-transparent
  double reach = 0.0;                        ///< the largest coordinate; infinite where one is no number
};

/// Of corners, three a triangle, of which equal ones become one. Null for none.
[[nodiscard]] std::shared_ptr<const mesh::Mesh> meshOf(std::span<const Vec3> corners);

/// The largest coordinate; infinite where one is no number.
[[nodiscard]] double reachOf(std::span<const Vec3> corners);

/// A bound of the coordinates that a shape of such reach has in the world; no number where they are none.
[[nodiscard]] double reachInWorld(double reach, const Mat4& toWorld);

}  // namespace umbrage::coin::detail
