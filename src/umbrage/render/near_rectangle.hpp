#pragma once

#include <array>
#include <optional>
#include <vector>

#include "umbrage/render/view.hpp"

namespace umbrage::render {

/// The part of a plane across the view that the picture shows, at a distance where nothing is decided any more: no side of a counted
/// volume comes as near to the eye as its corners. We draw without a near plane; this rectangle stands in for it in Zp+.
/// `radius`: how far its corners are from the eye. REQUIRES: a view of viewOf(Camera).
[[nodiscard]] double nearRectangleDistance(const View& view, double radius);

/// How the light sees it: clip coordinates of (position - eye, 1), of which only what lies between the rectangle and the light is inside, on the
/// pixel behind which the rectangle is met on the way from the light. Without depth clamp.
/// None where the view degenerates: the light shines along the rectangle, or is about as near to the eye as it.
/// `light`: homogeneous, relative to the eye. `reach`: how far from the eye casters may be.
/// Source: S. Hornus, J. Hoberock, S. Lefebvre and J. Hart, ZP+: correct z-pass stencil shadows, 2005.
[[nodiscard]] std::optional<Mat4> throughNearRectangle(const View& view, double distance, const Vec4& light,
                                                       double reach);

/// What of a triangle is seen so, as triangles in clip coordinates (w = 1), appended to `out`. Clipped in double precision and on the processor: the view
/// magnifies thousandfold, and clippers in single precision tear neighbouring triangles apart by a pixel.
void appendSeen(const Mat4& fromLight, const std::array<Vec3, 3>& corners, std::vector<Vec4f>& out);

}  // namespace umbrage::render
