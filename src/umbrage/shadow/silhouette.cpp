#include "umbrage/shadow/silhouette.hpp"

#include "umbrage/math/predicates.hpp"

namespace umbrage::shadow {
namespace {

std::vector<std::int8_t> sidesOf(const CasterSet& casters, const Vec4& light) {
  std::vector<std::int8_t> side;
  side.reserve(casters.triangles.size());
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    side.push_back(static_cast<std::int8_t>(
        lightSide(casters.corner(t, 0), casters.corner(t, 1), casters.corner(t, 2), light)));
  return side;
}

}  // namespace

Silhouette findSilhouette(const CasterSet& casters, const Vec4& light) {
  Silhouette silhouette;
  silhouette.light = light;
  silhouette.side = sidesOf(casters, light);
  silhouette.edgesTested = casters.edges.size();
  for (const CasterEdge& edge : casters.edges) {
    std::int32_t multiplicity = 0;
    for (std::uint32_t u = edge.begin; u < edge.end; ++u)
      multiplicity += casters.uses[u].sign * silhouette.side[casters.uses[u].triangle];
    if (multiplicity != 0)
      silhouette.edges.push_back({edge.a, edge.b, multiplicity, casters.componentOf[casters.uses[edge.begin].triangle]});
  }
  return silhouette;
}

}  // namespace umbrage::shadow
