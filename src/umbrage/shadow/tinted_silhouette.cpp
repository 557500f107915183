#include "umbrage/shadow/tinted_silhouette.hpp"

#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::shadow {
namespace {

void add(TintedEdge& edge, int sign, bool isVeil, const FilterSum& filter) {
  if (!isVeil) {
    edge.opaque += sign;
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) edge.filter[k] += sign * filter[k];
}

}  // namespace

std::vector<std::uint8_t> veiledComponents(const CasterSet& casters, const Filters& filters) {
  std::vector<std::uint8_t> veiled(casters.componentCount, 0);
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    if (filters.isVeil(casters.surfaceTriangle[t])) veiled[casters.componentOf[t]] = 1;
  return veiled;
}

TintedSilhouette findTintedSilhouette(const CasterSet& casters, const Filters& filters, const Vec4& light) {
  const auto veiled = veiledComponents(casters, filters);
  TintedSilhouette silhouette{light, findSides(casters, light, {.alsoAverted = veiled}), {}};
  for (const CasterEdge& edge : casters.edges) {
    TintedEdge sum{edge.a, edge.b, 0, {}};
    for (std::uint32_t u = edge.begin; u < edge.end; ++u) {
      const CasterEdgeUse& use = casters.uses[u];
      const std::uint32_t surface = casters.surfaceTriangle[use.triangle];
      add(sum, use.sign * silhouette.side[use.triangle], filters.isVeil(surface), filters.of(surface));
    }
    if (sum.opaque != 0 || sum.filter != FilterSum{}) silhouette.edges.push_back(sum);
  }
  return silhouette;
}

}  // namespace umbrage::shadow
