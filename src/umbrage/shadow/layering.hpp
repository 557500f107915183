#pragma once

#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::shadow {

/// The largest count that an 8-bit stencil can hold; the next one wraps to 0, and shadow becomes light.
inline constexpr int kStencilLimit = 255;

/// An upper bound for the number of counted surfaces on any ray from the light, found by laying the casters into a grid of
/// directions as the light sees them. At most a few times too large; grids are refined until the bound is within `enough`, or
/// no finer grid is worth its time. Cost: some tens of nanoseconds a counted triangle.
/// Law: countSurfaces(..).count <= layeringBound(..) at every point.
[[nodiscard]] int layeringBound(const CasterSet& casters, const Silhouette& silhouette, int enough = kStencilLimit);

}  // namespace umbrage::shadow
