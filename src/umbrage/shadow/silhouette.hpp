#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "umbrage/shadow/caster_set.hpp"

namespace umbrage::shadow {

/// An edge at which the number of surfaces between a point and the light changes by `multiplicity`.
struct SilhouetteEdge {
  std::uint32_t a, b;         ///< positions, in lexicographic order
  std::int32_t multiplicity;  ///< never 0; sign: the sense in which the side of the volume is wound
  std::uint32_t component;    ///< connected component of the caster it belongs to
};

/// The silhouette of a caster set as one light sees it.
struct Silhouette {
  Vec4 light{0.0};  ///< homogeneous, relative to CasterSet::origin
  /// Per triangle: lightSide of its sorted corners, -1 or +1, when it counts; 0 when it is edge-on to the light or left out.
  std::vector<std::int8_t> side;
  std::vector<SilhouetteEdge> edges;  ///< in the order of CasterSet::edges
  std::size_t edgesTested = 0;
  std::string_view finder = "brute_force";  ///< who found it, as name(FinderKind) spells it; static
};

struct SilhouetteOptions {
  /// A convex solid seen from outside hides the light wherever its lit faces do, so its averted faces are left out: half the
  /// sides and caps, and the same shadows. True counts every surface all the same.
  bool countEverySurface = false;
  /// Per component: 1 where averted faces count all the same. Empty: nowhere.
  std::span<const std::uint8_t> alsoAverted = {};
};

/// Every edge tested, one after the other: the yardstick for all other finders.
/// `light`: homogeneous, relative to the origin of `casters` (scene::homogeneous).
/// Law: for every closed surface bounding a set of triangles the multiplicities cancel, so the volume is watertight whatever the
/// topology and whatever rounding did to a sign.
/// Source: Aldridge and Woods, robust geometry-independent shadow volumes, 2004; Kim, Kim and Turk, 2008.
[[nodiscard]] Silhouette findSilhouette(const CasterSet& casters, const Vec4& light,
                                        const SilhouetteOptions& options = {});

/// Silhouette::side alone: the side of every triangle that counts.
[[nodiscard]] std::vector<std::int8_t> findSides(const CasterSet& casters, const Vec4& light,
                                                 const SilhouetteOptions& options = {});

/// The silhouette of the triangles whose `side` is not 0, which must be that of lightSide.
[[nodiscard]] Silhouette silhouetteOf(const CasterSet& casters, const Vec4& light, std::vector<std::int8_t> side);

}  // namespace umbrage::shadow
