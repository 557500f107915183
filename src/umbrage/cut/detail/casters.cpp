#include "umbrage/cut/detail/casters.hpp"

#include "umbrage/math/predicates.hpp"

namespace umbrage::cut::detail {

Casters Casters::of(const shadow::CasterSet& set, const Vec4& light) {
  Casters out{set, light, {}, {}, {}, {}, {}, {}};
  const std::size_t count = set.triangles.size();
  out.side.resize(count), out.edges.resize(count);
  std::vector<Box3> boxes;
  for (std::uint32_t t = 0; t < count; ++t) {
    const trace::Corners c = out.corners(t);
    out.side[t] = static_cast<std::int8_t>(lightSide(c.a, c.b, c.c, light));
    if (out.side[t] == 0) continue;
    out.hiding.push_back(t);
    Box3& box = boxes.emplace_back();
    box.add(c.a), box.add(c.b), box.add(c.c);
  }
  out.hidingTree = BoxTree(boxes);
  boxes.clear();
  std::vector<std::uint8_t> known(count, 0);
  for (std::uint32_t e = 0; e < set.edges.size(); ++e) {
    int multiplicity = 0;
    for (std::uint32_t u = set.edges[e].begin; u < set.edges[e].end; ++u) {
      const auto& use = set.uses[u];
      multiplicity += use.sign * out.side[use.triangle];
      if (known[use.triangle] < 3) out.edges[use.triangle][known[use.triangle]++] = e;
    }
    if (multiplicity == 0) continue;
    out.borders.push_back(e);
    Box3& box = boxes.emplace_back();
    box.add(set.position(set.edges[e].a)), box.add(set.position(set.edges[e].b));
  }
  out.borderTree = BoxTree(boxes);
  return out;
}

Standing standing(const Casters& casters, const Face& face, std::uint32_t triangle) {
  Standing s;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec3 p = casters.set.corner(triangle, k);
    s.heights[i] = face.height(p);
    s.at[i] = face.sideOf(p, s.heights[i]);
  }
  return s;
}

}  // namespace umbrage::cut::detail
