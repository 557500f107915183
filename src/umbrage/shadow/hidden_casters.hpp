#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::shadow {

/// Components that lie wholly in the shadow of one convex solid: whatever they would darken is dark without them.
struct HiddenCasters {
  std::vector<std::uint8_t> component;  ///< per component: 1 when hidden
  std::size_t count = 0;
};

/// Finds them for a light.
/// 1. Leaving out all of them at once changes no shadow: the shadow of a convex solid is convex, so it holds a component when it holds
///    its corners; and of two solids no two hide each other, so behind every hidden one there is one that is not.
/// 2. Only solids that are proven convex (CasterSet::outward) hide others. Corners in the shadow of *different* solids, or of one that is
///    not convex, prove nothing.
/// CAVEAT: some may be missed; solids are looked up in a grid of directions.
/// `light`: homogeneous, relative to the origin of the casters.
/// Components with a nonzero entry in `skip` are not asked about, but may hide others; those with one in `clear` let light through and hide none.
[[nodiscard]] HiddenCasters findHiddenCasters(const CasterSet& casters, const Vec4& light,
                                              std::span<const std::uint8_t> skip = {},
                                              std::span<const std::uint8_t> clear = {});

/// The silhouette without the components whose entry in `left` is not 0: as if they cast no shadow.
[[nodiscard]] Silhouette without(const CasterSet& casters, Silhouette silhouette, std::span<const std::uint8_t> left);

}  // namespace umbrage::shadow
