#pragma once

#include "umbrage/math/vec.hpp"

namespace umbrage {

/// On which side of the plane of a triangle the light lies: +1, -1, or 0 when the light is in the plane or the triangle has no
/// area, both as far as double arithmetic can tell (within its rounding error).
///
/// `a`, `b`, `c`: the corners in lexicographic order. `light`: homogeneous, (position, 1), or (direction towards the light, 0).
/// 1. The operands are always used in the same order, so that every edge and every cap of the triangle sees the same sign.
/// 2. Compiled without contraction; the same bits in every build.
/// REQUIRES: `a`, `b`, `c` sorted (not checked).
/// Source: Kim, Kim and Turk, shadow volumes for non-manifold meshes, 2008; operand order after Pečiva, Milet et al., 2013.
[[nodiscard]] int lightSide(const Vec3& a, const Vec3& b, const Vec3& c, const Vec4& light);

/// Whether a point lies in the plane of a triangle as far as single precision can draw the triangle from there: within 2^-25 of
/// the distance to its farthest corner. Seen from such a point it is edge-on.
[[nodiscard]] bool liesInPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point);

/// Distance from a point to a triangle, filled. A triangle without area is its edges.
[[nodiscard]] double distanceToTriangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

/// The point of a triangle, filled, that is nearest to `point`; one of them where there are several.
[[nodiscard]] Vec3 nearestOnTriangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace umbrage
