#pragma once

#include <optional>

#include "umbrage/math/box.hpp"

namespace umbrage::trace {

/// Three corners in double precision.
struct Corners {
  Vec3 a, b, c;
};

/// The parameter t > 0 at which `from` + t x `direction` meets a triangle, border included; nothing when it misses or runs in
/// the triangle's plane. Double precision, without tolerance.
[[nodiscard]] std::optional<double> crossing(const Vec3& from, const Vec3& direction, const Corners& triangle);

/// Whether a triangle lies between a point and a homogeneous light: they lie on different sides of its plane and the line through
/// both passes inside it, border included. A triangle whose plane holds the light or the point hides nothing.
/// REQUIRES: corners in lexicographic order (see lightSide; not checked).
[[nodiscard]] bool hides(const Corners& triangle, const Vec3& point, const Vec4& light);

/// The largest coordinate.
[[nodiscard]] double largest(const Vec3& v);

/// 0 inside, and for an empty box.
[[nodiscard]] double distanceToBox(const Vec3& p, const Box3& box);

/// Whether `triangle` is the surface the point lies on, or one that lies upon it as far as the resolution can tell.
[[nodiscard]] bool sameSurface(const Corners& triangle, const Vec3& point, double resolution);

}  // namespace umbrage::trace
