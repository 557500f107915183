#include "umbrage/cut/detail/casters.hpp"

#include <algorithm>

#include "umbrage/math/predicates.hpp"

namespace umbrage::cut::detail {

Casters Casters::of(const shadow::CasterSet& set, const Vec4& light) {
  Casters out{set, light, {}, {}, {}, {}, {}, {}, {}};
  const std::size_t count = set.triangles.size();
  out.side.resize(count), out.reach.resize(count), out.edges.resize(count);
  std::vector<Box3> boxes;
  for (std::uint32_t t = 0; t < count; ++t) {
    const trace::Corners c = out.corners(t);
    out.reach[t] = static_cast<float>(std::max({trace::largest(c.a), trace::largest(c.b), trace::largest(c.c)}));
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

// The same numbers come out relative to the light and to the face; what is nearer loses less by rounding.
Projected Face::project(const Vec3& p) const {
  const Vec3 x = p - frame.origin, y = p - Vec3(light);
  const bool fromLight = light.w != 0.0 && glm::dot(y, y) < glm::dot(x, x);
  const Vec3& from = fromLight ? y : x;
  const double above = glm::dot(up, from);
  return {glm::dot(frame.e1, from) * lightHeight - lightFlat.x * above,
          glm::dot(frame.e2, from) * lightHeight - lightFlat.y * above,
          fromLight ? -above : lightHeight - light.w * above};
}

namespace {

// Sine of the angle between two faces that rounding cannot have tilted against each other.
constexpr double kSteep = 1e-3;

/// A corner of what of a caster lies over a face.
struct Over {
  Projected at;
  double height;
};

// The highest of what of a triangle lies over the face, seen from the light; below all where nothing does.
double highestOver(const Face& face, const std::array<Over, 3>& corners) {
  std::array<Over, 8> polygon, kept;
  std::size_t count = 3;
  std::copy(corners.begin(), corners.end(), polygon.begin());
  for (const Vec3& inside : face.inside) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Over &p = polygon[i], &q = polygon[i + 1 == count ? 0 : i + 1];
      const double sp = glm::dot(inside, p.at), sq = glm::dot(inside, q.at);
      if (sp >= 0.0) kept[left++] = p;
      if ((sp < 0.0) == (sq < 0.0) || sp == 0.0 || sq == 0.0) continue;
      const double t = sp / (sp - sq);
      kept[left++] = {p.at + t * (q.at - p.at), p.height + t * (q.height - p.height)};
    }
    count = std::min<std::size_t>(left, 7);
    std::copy_n(kept.begin(), count, polygon.begin());
  }
  double highest = -1e300;
  for (std::size_t i = 0; i < count; ++i) highest = std::max(highest, polygon[i].height);
  return highest;
}

}  // namespace

bool isBefore(const Casters& casters, const Face& face, std::uint32_t triangle) {
  const double nothing = trace::resolution(std::max(face.reach, double(casters.reach[triangle])));
  std::array<Over, 3> corners;
  double highest = -1e300, lowest = 1e300;
  for (int k = 0; k < 3; ++k) {
    const double h = face.height(casters.set.corner(triangle, k));
    corners[static_cast<std::size_t>(k)].height = h;
    highest = std::max(highest, h), lowest = std::min(lowest, h);
  }
  if (highest <= nothing || lowest > nothing) return lowest > nothing;
  // A steep one only looks low where a light that rakes along the face sees no higher part of it.
  const trace::Corners c = casters.corners(triangle);
  const Vec3 normal = glm::cross(c.b - c.a, c.c - c.a);
  if (glm::length(glm::cross(normal, face.up)) > kSteep * glm::length(normal)) return true;
  for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)].at = face.project(casters.set.corner(triangle, k));
  return highestOver(face, corners) > nothing;
}

}  // namespace umbrage::cut::detail
