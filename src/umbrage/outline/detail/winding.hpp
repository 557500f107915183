#pragma once

#include <span>

#include "umbrage/mesh/mesh.hpp"
#include "umbrage/outline/detail/grid.hpp"

namespace umbrage::outline::detail {

/// Loops whose winding number at every point is the number of triangles that cover it: each triangle is turned
/// counter-clockwise, and edges that triangles share in opposite senses cancel. What is left of a closed solid is its
/// silhouette.
/// REQUIRES: indices are below points.size().
[[nodiscard]] std::vector<Loop> windingLoops(std::span<const GridPoint> points,
                                             std::span<const mesh::Triangle> triangles);

}  // namespace umbrage::outline::detail
