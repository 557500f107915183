#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/shadow/caster_set.hpp"
#include "umbrage/shadow/filters.hpp"

namespace umbrage::shadow {

/// An edge at which what lies between a point and the light changes: the number of opaque surfaces, and what veils take.
struct TintedEdge {
  std::uint32_t a, b;   ///< positions, in lexicographic order
  std::int32_t opaque;  ///< as SilhouetteEdge::multiplicity, of the opaque triangles alone
  FilterSum filter;     ///< of the veils: the sum of sign x side x what each takes, so that all colours are one
};

/// What a silhouette is where casters let light through.
struct TintedSilhouette {
  Vec4 light{0.0};                ///< homogeneous, relative to CasterSet::origin
  std::vector<std::int8_t> side;  ///< per triangle: lightSide; 0 when it does not count
  std::vector<TintedEdge> edges;  ///< in the order of CasterSet::edges
};

/// Per component of the casters: 1 when it holds a veil.
[[nodiscard]] std::vector<std::uint8_t> veiledComponents(const CasterSet& casters, const Filters& filters);

/// Every edge tested. Averted faces of convex solids are left out, as findSides has it, where the whole solid is opaque: of what lets light through each
/// surface counts.
/// `filters`: of the surfaces that `casters` were built from.
/// Source: Kim, Kim and Turk, real-time shadows of transparent casters, 2008, which draws the edges once per colour.
[[nodiscard]] TintedSilhouette findTintedSilhouette(const CasterSet& casters, const Filters& filters,
                                                    const Vec4& light);

}  // namespace umbrage::shadow
