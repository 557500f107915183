#include "umbrage/shadow/caster_set.hpp"

#include <algorithm>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/mesh/weld.hpp"

namespace umbrage::shadow {
namespace {

// The sorted triangle A<B<C runs A->B, B->C and C->A, so only the edge opposite B (A to C) is run against its order.
std::int32_t signOppositeCorner(std::uint8_t opposite) { return opposite == 1 ? -1 : +1; }

void buildEdges(CasterSet& casters) {
  const mesh::EdgeTable table = mesh::buildEdgeTable(casters.triangles);
  casters.edges.reserve(table.size());
  casters.uses.reserve(table.uses.size());
  for (std::size_t e = 0; e < table.size(); ++e) {
    auto [a, b] = table.ends[e];
    if (lexicographicallyLess(casters.positions[b], casters.positions[a])) std::swap(a, b);
    casters.edges.push_back({a, b, table.begin[e], table.begin[e + 1]});
  }
  for (const mesh::EdgeUse& use : table.uses)
    casters.uses.push_back({use.triangle, signOppositeCorner(use.opposite)});
  casters.report = mesh::inspect(casters.triangles, table);
  casters.report.windingFlips = 0;  // corners are sorted: the file's winding is gone
}

// Everything that follows from positions and triangles.
CasterSet finish(CasterSet casters) {
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) casters.bounds.add(casters.corner(t, k));
  buildEdges(casters);
  auto components = mesh::connectedComponents(casters.triangles);
  casters.componentOf = std::move(components.ofTriangle);
  casters.componentCount = components.count;
  return casters;
}

}  // namespace

CasterSet buildCasters(const scene::Surfaces& surfaces) {
  CasterSet casters;
  casters.origin = surfaces.origin;
  casters.positions = surfaces.positions;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    if (surfaces.casts[t] == 0) continue;
    casters.triangles.push_back(surfaces.triangles[t]);
    casters.surfaceTriangle.push_back(t);
  }
  return finish(std::move(casters));
}

CasterSet buildCasters(std::span<const Vec3f> positions, std::span<const mesh::Triangle> triangles) {
  CasterSet casters;
  const mesh::Weld welded = mesh::weld(positions);
  for (const std::uint32_t i : welded.first) casters.positions.push_back(positions[i] + Vec3f(0.0f));  // no -0
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return lexicographicallyLess(casters.positions[a], casters.positions[b]);
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    mesh::Triangle c = triangles[t];
    for (std::uint32_t& corner : c) {
      UMBRAGE_CHECK(corner < positions.size(), "corner index out of range");
      corner = welded.remap[corner];
    }
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    std::sort(c.begin(), c.end(), before);
    casters.triangles.push_back(c);
    casters.surfaceTriangle.push_back(t);
  }
  return finish(std::move(casters));
}

}  // namespace umbrage::shadow
