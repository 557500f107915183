#include "umbrage/mesh/mesh_report.hpp"

#include <algorithm>
#include <numeric>

namespace umbrage::mesh {
namespace {

// Disjoint sets over corners, with path halving.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

// True when the triangle runs from the edge's lower end to its higher end.
bool runsUpwards(const Triangle& triangle, std::uint8_t opposite, std::uint32_t lowEnd) {
  return triangle[(opposite + 1) % 3] == lowEnd;
}

}  // namespace

const char* name(Topology topology) {
  switch (topology) {
    case Topology::empty: return "empty";
    case Topology::closed: return "closed";
    case Topology::open: return "open";
    case Topology::nonManifold: return "non-manifold";
  }
  return "?";
}

MeshReport inspect(std::span<const Triangle> triangles, const EdgeTable& edges) {
  MeshReport report;
  report.triangles = triangles.size();
  report.edges = edges.size();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.usesOf(e);
    report.borderEdges += uses.size() == 1;
    report.nonManifoldEdges += uses.size() > 2;
    if (uses.size() != 2) continue;
    const std::uint32_t low = edges.ends[e][0];
    report.windingFlips += runsUpwards(triangles[uses[0].triangle], uses[0].opposite, low) ==
                           runsUpwards(triangles[uses[1].triangle], uses[1].opposite, low);
  }
  report.components = connectedComponents(triangles).count;
  if (triangles.empty()) return report;
  report.topology = report.nonManifoldEdges > 0 ? Topology::nonManifold
                    : report.borderEdges > 0    ? Topology::open
                                                : Topology::closed;
  return report;
}

Components connectedComponents(std::span<const Triangle> triangles) {
  std::uint32_t corners = 0;
  for (const Triangle& t : triangles) corners = std::max({corners, t[0] + 1, t[1] + 1, t[2] + 1});
  DisjointSets sets(corners);
  for (const Triangle& t : triangles) {
    sets.unite(t[0], t[1]);
    sets.unite(t[1], t[2]);
  }
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(corners, kNone);
  Components components;
  components.ofTriangle.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    std::uint32_t& n = number[sets.find(t[0])];
    if (n == kNone) n = components.count++;
    components.ofTriangle.push_back(n);
  }
  return components;
}

}  // namespace umbrage::mesh
