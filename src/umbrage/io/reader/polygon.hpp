#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/math/vec.hpp"
#include "umbrage/mesh/mesh.hpp"

namespace umbrage::io::reader {

/// Indices of corners; the first ring is the outer one, the others are holes. Rings are not closed by repeating a corner.
using Rings = std::vector<std::vector<std::uint32_t>>;

/// A polygon in space, flat or nearly so, as triangles.
/// 1. The corners of the triangles are corners of the rings, never new ones, so that neighbours that share an edge still share it.
/// 2. With n corners in all and h holes (after corners that repeat the one before are left out, and rings of fewer than three)
///    there are n + 2h - 2 triangles, for rings that cross or touch themselves perhaps fewer. Each edge of a ring belongs to one
///    of them, each other edge to as many that run through it one way as the other. This holds for crossing and folded rings
///    too: a closed surface stays edge-closed.
/// 3. The triangles wind like the outer ring.
/// Empty when the outer ring has fewer than three different corners.
/// REQUIRES: every index is below points.size(); the points are finite.
[[nodiscard]] std::vector<mesh::Triangle> triangulate(std::span<const Vec3> points, const Rings& rings);

}  // namespace umbrage::io::reader
