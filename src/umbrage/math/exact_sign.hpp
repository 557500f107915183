#pragma once

#include "umbrage/math/vec.hpp"

namespace umbrage {

/// A point (w = 1) or a direction (w = 0) as the eye sees it: relative to an eye in the origin.
struct Sighted {
  Vec3 v{0.0};
  double w = 1.0;
};

/// The exact sign of the determinant with columns a, b, c: +1, 0 or -1, whatever rounding would have made of it.
/// REQUIRES: finite; no product of three coordinates over- or underflows.
/// Source: expansions after J. R. Shewchuk, Adaptive precision floating-point arithmetic, 1997.
[[nodiscard]] int signOfDeterminant(const Vec3& a, const Vec3& b, const Vec3& c);

/// The sign of the same determinant as seen from an eye moved by an infinitely small step in one and the same crooked direction:
/// points move against it, directions stay. So whatever of points, edges and planes lies in line with the eye comes to lie on one side or the
/// other, and all answers fit together, as if nothing had been in line.
/// 1. 0 only where the points and directions are in line with each other: two alike, or three on a line.
/// Source: simulation of simplicity, H. Edelsbrunner and E. P. Mücke, 1990.
[[nodiscard]] int sideSeen(const Sighted& a, const Sighted& b, const Sighted& c);

/// The exact sign of det(a - d, b - d, c - d) for points, of det(b - a, c - a, -d) for a direction d: on which side of the plane of a, b
/// and c it lies. a, b and c are points. It is that of det(a, b, c) when the eye lies on the same side.
[[nodiscard]] int sideOfPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Sighted& d);

/// |det(a, b, c)| above this part of the sum of its six absolute products has the sign that double arithmetic gives it.
inline constexpr double kDeterminantError = 0x1p-49;

}  // namespace umbrage
