#include "umbrage/shadow/each_by_itself.hpp"

#include <utility>

namespace umbrage::shadow {

Silhouette eachByItself(const CasterSet& casters, const Vec4& light, const SilhouetteOptions& options) {
  Silhouette all;
  all.light = light;
  all.side = findSides(casters, light, options);
  all.finder = {};
  return eachByItself(casters, std::move(all));
}

Silhouette eachByItself(const CasterSet& casters, Silhouette silhouette) {
  silhouette.edges.clear();
  for (const CasterEdge& edge : casters.edges)
    for (std::uint32_t u = edge.begin; u < edge.end; ++u) {
      const CasterEdgeUse& use = casters.uses[u];
      const std::int32_t sign = use.sign * silhouette.side[use.triangle];
      if (sign != 0) silhouette.edges.push_back({edge.a, edge.b, sign, casters.componentOf[use.triangle]});
    }
  return silhouette;
}

Windings byWinding(const Silhouette& silhouette) {
  Windings out;
  out.straight.light = out.turned.light = silhouette.light;
  out.straight.side = silhouette.side;
  for (SilhouetteEdge edge : silhouette.edges) {
    if (edge.multiplicity > 0) {
      out.straight.edges.push_back(edge);
    } else {
      edge.multiplicity = -edge.multiplicity;
      out.turned.edges.push_back(edge);
    }
  }
  return out;
}

}  // namespace umbrage::shadow
