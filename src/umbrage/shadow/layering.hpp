#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::shadow {

/// The largest count that an 8-bit stencil can hold; the next one wraps to 0, and shadow becomes light.
inline constexpr int kStencilLimit = 255;

/// An upper bound for the number of counted surfaces on any ray from the light, found by laying the casters into a grid of
/// directions as the light sees them. At most a few times too large; grids are refined until the bound is within `enough`, or
/// no finer grid is worth its time. Cost: some tens of nanoseconds a counted triangle.
/// Law: countSurfaces(..).count <= layeringBound(..) at every point.
[[nodiscard]] int layeringBound(const CasterSet& casters, const Silhouette& silhouette, int enough = kStencilLimit);

/// Counted triangles in groups, so that no ray meets more than a limit of one group: what lets an 8-bit stencil count any scene.
struct LayerGroups {
  int count = 1;
  std::vector<std::uint8_t> ofTriangle;  ///< per caster triangle; empty when there is one group
};

/// First fit, in the order of the triangles. One group whenever layeringBound is within `limit`.
/// 1. countSurfaces with one group's silhouette (restrictTo) is at most `limit` at every point.
/// CAVEAT: at most 256 groups; what fits in none goes to the last.
[[nodiscard]] LayerGroups groupLayers(const CasterSet& casters, const Silhouette& silhouette, int limit);

/// The silhouette of one group alone: its volume is watertight like every other.
[[nodiscard]] Silhouette restrictTo(const CasterSet& casters, const Silhouette& silhouette, const LayerGroups& groups,
                                    int group);

}  // namespace umbrage::shadow
