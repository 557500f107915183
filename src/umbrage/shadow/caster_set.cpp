#include "umbrage/shadow/caster_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/math/predicates.hpp"
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
  for (const mesh::EdgeUse& use : table.uses) casters.uses.push_back({use.triangle, signOppositeCorner(use.opposite)});
  casters.report = mesh::inspect(casters.triangles, table);
  casters.report.windingFlips = 0;  // corners are sorted: the file's winding is gone
}

// Every corner is held against every plane, so large components are not asked; they count all their surfaces instead.
constexpr std::size_t kLargestConvexTest = 4'000'000;

std::vector<std::uint8_t> closedComponents(const CasterSet& casters) {
  std::vector<std::uint8_t> closed(casters.componentCount, 1);
  for (const CasterEdge& edge : casters.edges)
    if (edge.end - edge.begin != 2) closed[casters.componentOf[casters.uses[edge.begin].triangle]] = 0;
  return closed;
}

std::vector<std::uint32_t> cornersOf(const CasterSet& casters, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t t : triangles)
    corners.insert(corners.end(), casters.triangles[t].begin(), casters.triangles[t].end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

// How far rounding to float may push a corner out of a plane: a few units in the last place of the largest coordinate.
double roundingReach(const CasterSet& casters, std::span<const std::uint32_t> corners) {
  double largest = 0.0;
  for (const std::uint32_t i : corners) {
    const Vec3 p = glm::abs(casters.position(i));
    largest = std::max({largest, p.x, p.y, p.z});
  }
  return 8.0 * std::numeric_limits<float>::epsilon() * largest;
}

// Marks the triangles of one closed component as outward or not, or leaves them at 0 when it is not convex.
void markIfConvex(CasterSet& casters, std::span<const std::uint32_t> triangles) {
  // A convex solid of n triangles has n / 2 + 2 corners (Euler); gathering those of a large component only to find it too large takes long.
  if ((triangles.size() / 2 + 2) * triangles.size() > kLargestConvexTest) return;
  const auto corners = cornersOf(casters, triangles);
  if (corners.size() < 4 || corners.size() * triangles.size() > kLargestConvexTest) return;
  Vec3 middle(0.0);
  for (const std::uint32_t i : corners) middle += casters.position(i) / double(corners.size());
  const double tolerance = roundingReach(casters, corners);
  std::vector<std::int8_t> outward;
  for (const std::uint32_t t : triangles) {
    const Vec3 a = casters.corner(t, 0), b = casters.corner(t, 1), c = casters.corner(t, 2);
    const int away = -lightSide(a, b, c, Vec4(middle, 1.0));
    const Vec3 normal = double(away) * glm::cross(b - a, c - a);
    const double allowed = tolerance * glm::length(normal);
    if (away == 0 || -glm::dot(normal, middle - a) <= 2.0 * allowed) return;  // flat: it has no inside
    for (const std::uint32_t i : corners)
      if (glm::dot(normal, casters.position(i) - a) > allowed) return;
    outward.push_back(static_cast<std::int8_t>(away));
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) casters.outward[triangles[i]] = outward[i];
}

void findConvexSolids(CasterSet& casters) {
  casters.outward.assign(casters.triangles.size(), 0);
  const auto closed = closedComponents(casters);
  std::vector<std::uint32_t> begin(casters.componentCount + 1, 0);
  for (const std::uint32_t component : casters.componentOf) ++begin[component + 1];
  for (std::size_t c = 0; c < casters.componentCount; ++c) begin[c + 1] += begin[c];
  std::vector<std::uint32_t> byComponent(casters.triangles.size()), next = begin;
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) byComponent[next[casters.componentOf[t]]++] = t;
  for (std::size_t c = 0; c < casters.componentCount; ++c)
    if (closed[c] != 0) markIfConvex(casters, std::span(byComponent).subspan(begin[c], begin[c + 1] - begin[c]));
}

void describeComponents(CasterSet& casters) {
  casters.componentBounds.assign(casters.componentCount, Box3{});
  casters.componentOfPosition.assign(casters.positions.size(), kNoComponent);
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    for (const std::uint32_t i : casters.triangles[t]) {
      casters.componentBounds[casters.componentOf[t]].add(casters.position(i));
      casters.componentOfPosition[i] = casters.componentOf[t];
    }
}

// Everything that follows from positions and triangles.
CasterSet finish(CasterSet casters) {
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) casters.bounds.add(casters.corner(t, k));
  buildEdges(casters);
  auto components = mesh::connectedComponents(casters.triangles);
  casters.componentOf = std::move(components.ofTriangle);
  casters.componentCount = components.count;
  describeComponents(casters);
  findConvexSolids(casters);
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

CasterSet moveCasters(const scene::Surfaces& surfaces, CasterSet before) {
  CasterSet casters = std::move(before);
  casters.origin = surfaces.origin;
  casters.positions = surfaces.positions;
  casters.bounds = {};
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
    casters.triangles[t] = surfaces.triangles[casters.surfaceTriangle[t]];
    for (int k = 0; k < 3; ++k) casters.bounds.add(casters.corner(t, k));
  }
  for (CasterEdge& edge : casters.edges) {
    if (lexicographicallyLess(casters.positions[edge.b], casters.positions[edge.a])) std::swap(edge.a, edge.b);
    for (std::uint32_t u = edge.begin; u < edge.end; ++u) {
      const mesh::Triangle& t = casters.triangles[casters.uses[u].triangle];
      casters.uses[u].sign = signOppositeCorner(edge.a == t[0] && edge.b == t[2] ? 1 : 0);
    }
  }
  describeComponents(casters);
  findConvexSolids(casters);
  return casters;
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
