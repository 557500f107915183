#include "umbrage/shadow/silhouette.hpp"

#include <utility>

#include "umbrage/math/predicates.hpp"

namespace umbrage::shadow {
namespace {

std::vector<std::int8_t> sidesOf(const CasterSet& casters, const Vec4& light) {
  std::vector<std::int8_t> side;
  side.reserve(casters.triangles.size());
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    side.push_back(
        static_cast<std::int8_t>(lightSide(casters.corner(t, 0), casters.corner(t, 1), casters.corner(t, 2), light)));
  return side;
}

// A light inside a convex solid, or on it, sees none of its faces from outside; then all faces must count.
void leaveOutAvertedFaces(const CasterSet& casters, std::span<const std::uint8_t> but, std::vector<std::int8_t>& side) {
  std::vector<std::uint8_t> seenFromOutside(casters.componentCount, 0);
  for (std::size_t t = 0; t < side.size(); ++t)
    if (side[t] * casters.outward[t] > 0) seenFromOutside[casters.componentOf[t]] = 1;
  for (std::uint32_t c = 0; c < but.size(); ++c)
    if (but[c] != 0) seenFromOutside[c] = 0;
  for (std::size_t t = 0; t < side.size(); ++t)
    if (side[t] * casters.outward[t] < 0 && seenFromOutside[casters.componentOf[t]] != 0) side[t] = 0;
}

}  // namespace

std::vector<std::int8_t> findSides(const CasterSet& casters, const Vec4& light, const SilhouetteOptions& options) {
  std::vector<std::int8_t> side = sidesOf(casters, light);
  if (!options.countEverySurface) leaveOutAvertedFaces(casters, options.alsoAverted, side);
  return side;
}

Silhouette findSilhouette(const CasterSet& casters, const Vec4& light, const SilhouetteOptions& options) {
  return silhouetteOf(casters, light, findSides(casters, light, options));
}

Silhouette silhouetteOf(const CasterSet& casters, const Vec4& light, std::vector<std::int8_t> side) {
  Silhouette silhouette;
  silhouette.light = light;
  silhouette.side = std::move(side);
  silhouette.edgesTested = casters.edges.size();
  for (const CasterEdge& edge : casters.edges) {
    std::int32_t multiplicity = 0;
    for (std::uint32_t u = edge.begin; u < edge.end; ++u)
      multiplicity += casters.uses[u].sign * silhouette.side[casters.uses[u].triangle];
    if (multiplicity != 0)
      silhouette.edges.push_back(
          {edge.a, edge.b, multiplicity, casters.componentOf[casters.uses[edge.begin].triangle]});
  }
  return silhouette;
}

}  // namespace umbrage::shadow
