#include "umbrage/study/detail/hours_casters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "umbrage/mesh/edge_table.hpp"

namespace umbrage::study::detail {
namespace {

using mesh::EdgeTable;
using mesh::EdgeUse;

// Whether a triangle runs along an edge from its first end to its second.
bool runsForward(const mesh::Triangle& triangle, const EdgeUse& use, std::uint32_t firstEnd) {
  return triangle[(use.opposite + 1u) % 3u] == firstEnd;
}

// Which triangles hang together, which of them are closed solids, and which triangles to turn so that all look outwards.
class Solids {
 public:
  Solids(const scene::Surfaces& surfaces, const std::vector<mesh::Triangle>& triangles, const EdgeTable& edges)
      : surfaces_(surfaces),
        triangles_(triangles),
        edges_(edges),
        solid(triangles.size(), -1),
        turned(triangles.size(), 0) {
    findNeighbours();
    std::vector<std::uint8_t> seen(triangles.size(), 0);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      if (seen[t] == 0) explore(t, seen);
  }

 private:
  const scene::Surfaces& surfaces_;
  const std::vector<mesh::Triangle>& triangles_;
  const EdgeTable& edges_;
  // Per triangle and side: the edge.
  std::vector<std::array<std::uint32_t, 3>> sides_;

 public:
  std::vector<std::int32_t> solid;
  std::vector<std::uint8_t> turned;
  std::vector<Casters::Solid> solids;

 private:
  static constexpr std::size_t kMostSides = 64;

  void findNeighbours() {
    sides_.resize(triangles_.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      for (const EdgeUse& use : edges_.usesOf(e)) sides_[use.triangle][use.opposite] = e;
  }

  // All that hangs together with `start` over edges of any number of triangles.
  void explore(std::uint32_t start, std::vector<std::uint8_t>& seen) {
    std::vector<std::uint32_t> members{start};
    seen[start] = 1;
    bool closed = true;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::uint32_t t = members[i];
      for (const std::uint32_t e : sides_[t]) {
        const auto uses = edges_.usesOf(e);
        if (uses.size() != 2) closed = false;
        for (const EdgeUse& use : uses) closed = visit(t, use.triangle, e, seen, members) && closed;
      }
    }
    if (!closed) return;
    const auto id = static_cast<std::int32_t>(solids.size());
    solids.emplace_back();
    double volume = 0.0;
    const Vec3 origin = surfaces_.corner(0, 0);
    for (const std::uint32_t t : members) {
      solid[t] = id;
      const Vec3 a = corner(t, 0) - origin, b = corner(t, 1) - origin, c = corner(t, 2) - origin;
      volume += (turned[t] != 0 ? -1.0 : 1.0) * glm::dot(a, glm::cross(b, c));
      for (int k = 0; k < 3; ++k) solids.back().box.add(corner(t, k));
    }
    if (volume < 0.0)
      for (const std::uint32_t t : members) turned[t] ^= 1;
    if (members.size() <= kMostSides) solids.back().sides = convexSides(members, solids.back().box);
  }

  // The planes of all triangles, or none where a corner lies before one by more than rounding.
  [[nodiscard]] std::vector<Casters::Plane> convexSides(const std::vector<std::uint32_t>& members,
                                                        const Box3& box) const {
    const Vec3 far = glm::max(glm::abs(box.min), glm::abs(box.max));
    const double rounding = 0x1p-23 * std::max({far.x, far.y, far.z});
    std::vector<Casters::Plane> sides;
    for (const std::uint32_t t : members) {
      const Vec3 a = corner(t, 0), n = glm::cross(corner(t, 1) - a, corner(t, 2) - a) * (turned[t] != 0 ? -1.0 : 1.0);
      if (!(glm::length(n) > 0.0)) return {};
      sides.push_back({a, glm::normalize(n)});
    }
    for (const std::uint32_t t : members)
      for (int k = 0; k < 3; ++k)
        for (const Casters::Plane& side : sides)
          if (glm::dot(corner(t, k) - side.point, side.normal) > rounding) return {};
    return sides;
  }

  // Turns a new triangle to fit the one it was reached from; false where it cannot.
  bool visit(std::uint32_t from, std::uint32_t to, std::uint32_t edge, std::vector<std::uint8_t>& seen,
             std::vector<std::uint32_t>& members) {
    if (to == from) return true;
    const auto uses = edges_.usesOf(edge);
    if (uses.size() == 2) {
      const bool same = runsForward(triangles_[uses[0].triangle], uses[0], edges_.ends[edge][0]) ==
                        runsForward(triangles_[uses[1].triangle], uses[1], edges_.ends[edge][0]);
      const std::uint8_t wanted = turned[from] ^ (same ? 1 : 0);
      if (seen[to] != 0) return turned[to] == wanted;
      turned[to] = wanted;
    }
    if (seen[to] == 0) {
      seen[to] = 1;
      members.push_back(to);
    }
    return true;
  }

  [[nodiscard]] Vec3 corner(std::uint32_t t, int k) const { return Vec3(surfaces_.positions[triangles_[t][k]]); }
};

// How far from flat two triangles may be to count as one quad: what rounding the corners to single precision makes.
double flatness(const Vec3& a, const Vec3& b) {
  const Vec3 largest = glm::max(glm::abs(a), glm::abs(b));
  return 0x1p-22 * std::max({largest.x, largest.y, largest.z}) + 2e-6 * glm::length(b - a);
}

// The convex quad of two triangles, or nothing. Edge from a to b; p and r are the corners on either side.
bool isConvexQuad(const Vec3& a, const Vec3& r, const Vec3& b, const Vec3& p) {
  const Vec3 normal = glm::cross(b - a, p - a);
  const double size = glm::length(normal);
  if (!(size > 0.0)) return false;
  if (std::abs(glm::dot(normal, r - a)) > size * flatness(a, r)) return false;
  const Vec3 corner[4] = {a, r, b, p};
  for (int k = 0; k < 4; ++k) {
    const Vec3 x = corner[(k + 1) & 3] - corner[k], y = corner[(k + 2) & 3] - corner[(k + 1) & 3];
    if (glm::dot(glm::cross(x, y), normal) <= 1e-4 * size * glm::length(x) * glm::length(y)) return false;
  }
  return true;
}

}  // namespace

Casters makeCasters(const scene::Surfaces& surfaces, const std::vector<std::uint32_t>& chosen) {
  std::vector<mesh::Triangle> triangles;
  triangles.reserve(chosen.size());
  for (const std::uint32_t t : chosen) triangles.push_back(surfaces.triangles[t]);
  const EdgeTable edges = mesh::buildEdgeTable(triangles);
  Solids solids(surfaces, triangles, edges);

  Casters out;
  out.solids = std::move(solids.solids);
  std::vector<std::uint8_t> used(triangles.size(), 0);
  const auto at = [&](std::uint32_t position) { return Vec3(surfaces.positions[position]); };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.usesOf(e);
    if (uses.size() != 2) continue;
    EdgeUse first = uses[0], second = uses[1];
    if (used[first.triangle] != 0 || used[second.triangle] != 0) continue;
    const auto [a, b] = edges.ends[e];
    // `first` is the one that runs from a to b, once turned outwards.
    const auto forward = [&](const EdgeUse& use) {
      return runsForward(triangles[use.triangle], use, a) != (solids.turned[use.triangle] != 0);
    };
    if (!forward(first)) std::swap(first, second);
    if (solids.solid[first.triangle] >= 0 && !forward(first)) continue;
    const std::uint32_t p = triangles[first.triangle][first.opposite], r = triangles[second.triangle][second.opposite];
    if (p == r || !isConvexQuad(at(a), at(r), at(b), at(p))) continue;
    used[first.triangle] = used[second.triangle] = 1;
    out.quads.push_back({{a, r, b, p}, solids.solid[first.triangle]});
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (used[t] != 0) continue;
    const mesh::Triangle& c = triangles[t];
    const bool turn = solids.turned[t] != 0;
    out.quads.push_back({{c[0], turn ? c[2] : c[1], turn ? c[1] : c[2], turn ? c[1] : c[2]}, solids.solid[t]});
  }
  return out;
}

}  // namespace umbrage::study::detail
