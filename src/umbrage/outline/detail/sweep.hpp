#pragma once

#include <span>

#include "umbrage/mesh/mesh.hpp"
#include "umbrage/outline/detail/grid.hpp"

namespace umbrage::outline::detail {

/// What the border of the union of triangles sweeps over while each corner moves straight from one point to another, all in one direction: a
/// convex hull for each edge that belongs to the border at some time in between.
/// Law: with windingLoops of `from` these cover all that the triangles cover at any time.
/// REQUIRES: both spans are of one size; a corner moves by a multiple of one direction.
[[nodiscard]] std::vector<Loop> sweptEdges(std::span<const GridPoint> from, std::span<const GridPoint> to,
                                           std::span<const mesh::Triangle> triangles);

}  // namespace umbrage::outline::detail
