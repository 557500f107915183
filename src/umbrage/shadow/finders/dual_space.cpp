#include "umbrage/shadow/finders/dual_space.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "umbrage/base/check.hpp"
#include "umbrage/shadow/finders/threads.hpp"

namespace umbrage::shadow {
namespace {

constexpr double kLeastSteady = 0x1p-22;  // see kDoubt

float dot(const DualPoint& p, const DualPoint& along) {
  return p[0] * along[0] + p[1] * along[1] + p[2] * along[2] + p[3] * along[3];
}

// Directions that no model is built along: they decide which of the two equivalent forms of a segment is kept, so that like
// segments lie near each other whatever the order of their corners.
constexpr DualPoint kUp{0.4327f, 0.3119f, 0.8461f, 0.0813f}, kAcross{0.7213f, -0.6301f, -0.1931f, 0.2217f};

DualEdge canonical(DualPoint p, DualPoint q, std::uint32_t tag) {
  if (dot(p, kUp) + dot(q, kUp) < 0.0f) {
    p = -p, q = -q;
    tag ^= kTagNegative;
  }
  if (dot(p, kAcross) < dot(q, kAcross)) {
    std::swap(p, q);
    tag ^= kTagNegative;
  }
  return {{p, q}, tag};
}

DualPoint used(const std::vector<DualPlane>& planes, const CasterEdgeUse& use) {
  return use.sign > 0 ? planes[use.triangle].point : -planes[use.triangle].point;
}

class Splitter {
 public:
  Splitter(const CasterSet& casters, const std::vector<DualPlane>& planes, DualEdges& out)
      : casters_(casters), planes_(planes), out_(out) {}

  void split(std::uint32_t e) {
    const CasterEdge& edge = casters_.edges[e];
    const auto uses = std::span(casters_.uses).subspan(edge.begin, edge.end - edge.begin);
    const bool steady =
        std::all_of(uses.begin(), uses.end(), [&](const CasterEdgeUse& use) { return planes_[use.triangle].steady; });
    if (!steady)
      out_.always.push_back(e);
    else if (uses.size() == 1)
      addSingle(uses[0], e);
    else if (uses.size() == 2)
      addPairOrSolid(uses[0], uses[1], e);
    else
      addMany(uses, e | kTagPartial);
  }

 private:
  void addSingle(const CasterEdgeUse& use, std::uint32_t tag) {
    const DualPoint p = used(planes_, use);
    out_.segments.push_back(canonical(p, -p, tag | kTagSingle));
  }

  void addPair(const CasterEdgeUse& a, const CasterEdgeUse& b, std::uint32_t tag) {
    out_.segments.push_back(canonical(used(planes_, a), -used(planes_, b), tag));
  }

  void addPairOrSolid(const CasterEdgeUse& a, const CasterEdgeUse& b, std::uint32_t e) {
    const int outwardA = a.sign * casters_.outward[a.triangle], outwardB = b.sign * casters_.outward[b.triangle];
    if (outwardA == 0)
      addPair(a, b, e);
    else if (outwardA == -outwardB)
      addPair(a, b, e | kTagConvex);
    else
      out_.always.push_back(e);  // folded, within the rounding that a solid may have
  }

  // Whichever face lies nearest to being the continuation of the first.
  void addMany(std::span<const CasterEdgeUse> uses, std::uint32_t tag) {
    std::vector<CasterEdgeUse> left(uses.begin(), uses.end());
    while (left.size() > 1) {
      const CasterEdgeUse first = left.back();
      left.pop_back();
      const DualPoint p = used(planes_, first);
      const auto distance = [&](const CasterEdgeUse& use) {
        const DualPoint q = used(planes_, use);
        double square = 0.0;
        for (int k = 0; k < 4; ++k) square += double(p[k] + q[k]) * double(p[k] + q[k]);
        return square;
      };
      const auto mate = left.size() > kManyFaces
                            ? left.end() - 1
                            : std::min_element(left.begin(), left.end(),
                                               [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
      addPair(first, *mate, tag);
      left.erase(mate);
    }
    if (!left.empty()) addSingle(left.front(), tag);
  }

  static constexpr std::size_t kManyFaces = 64;

  const CasterSet& casters_;
  const std::vector<DualPlane>& planes_;
  DualEdges& out_;
};

}  // namespace

DualFrame dualFrame(const CasterSet& casters) {
  return {casters.bounds.centre(), casters.bounds.radius() * (1.0 + 0x1p-40)};
}

DualPoint dualLight(const DualFrame& frame, const Vec4& light) {
  UMBRAGE_CHECK(light.w == 0.0 || light.w == 1.0, "a light is a point with w = 1 or a direction with w = 0");
  const Vec3 from = Vec3(light) - frame.centre * light.w;
  const double reach = frame.radius * light.w, size = glm::length(from) + reach;
  // Beyond these, squares and products over- or underflow.
  if (!(size > 1e-100 && size < 1e100)) return {};
  return {float(from.x / size), float(from.y / size), float(from.z / size), float(reach / size)};
}

DualPlane dualPlane(const CasterSet& casters, const DualFrame& frame, std::uint32_t triangle) {
  const Vec3 a = casters.corner(triangle, 0);
  const Vec3 ab = casters.corner(triangle, 1) - a, ac = casters.corner(triangle, 2) - a;
  const Vec3 normal = glm::cross(ab, ac), p = glm::abs(ab), q = glm::abs(ac);
  const Vec3 uncancelled(p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x);
  const double square = glm::dot(normal, normal);
  const bool steady = square > kLeastSteady * kLeastSteady * glm::dot(uncancelled, uncancelled) && square > 1e-200;
  if (!steady) return {};
  const Vec3 n = normal * (1.0 / std::sqrt(square));
  const double d = glm::dot(n, frame.centre - a) / frame.radius;
  return {{float(n.x), float(n.y), float(n.z), float(d)}, true};
}

DualEdges dualEdges(const CasterSet& casters, unsigned threads) {
  UMBRAGE_CHECK(casters.edges.size() <= kTagEdge, "too many edges for the dual space");
  constexpr std::size_t kWorthAThread = 50'000;  // triangles or edges
  const std::size_t edges = casters.edges.size(), triangles = casters.triangles.size();
  const auto parts = static_cast<unsigned>(std::clamp<std::size_t>(edges / kWorthAThread, 1, threads));
  const DualFrame frame = dualFrame(casters);
  std::vector<DualPlane> planes(triangles);
  inParts(triangles, 1, parts, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) planes[t] = dualPlane(casters, frame, static_cast<std::uint32_t>(t));
  });
  std::vector<DualEdges> found(parts);
  inParts(edges, 1, parts, [&](unsigned part, std::size_t begin, std::size_t end) {
    found[part].segments.reserve(part == 0 ? edges : end - begin);  // the others join the first
    Splitter splitter(casters, planes, found[part]);
    for (std::size_t e = begin; e < end; ++e) splitter.split(static_cast<std::uint32_t>(e));
  });
  DualEdges all = std::move(found[0]);
  all.frame = frame;
  for (unsigned part = 1; part < parts; ++part) {
    all.segments.insert(all.segments.end(), found[part].segments.begin(), found[part].segments.end());
    all.always.insert(all.always.end(), found[part].always.begin(), found[part].always.end());
  }
  return all;
}

}  // namespace umbrage::shadow
