#include "umbrage/study/detail/hours_balls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "umbrage/math/predicates.hpp"
#include "umbrage/study/detail/binary_tree.hpp"

namespace umbrage::study::detail {
namespace {

constexpr std::size_t kFewestQuads = 256;   // of a solid with balls
constexpr std::size_t kQuadsPerSample = 8;  // of where balls are looked for
constexpr std::size_t kMostSamples = 8192;
constexpr double kLeastShare = 24.0;  // how many of the solid's faces a ball must be as large as
// Of a ball's radius: between it and the surface that it was made to touch, since at a face's edge the next face would let only a small ball
// touch both; and between it and the surface that it stands for.
constexpr double kLoose = 0.02, kNear = 0.04;
constexpr double kCoarse = 0.1;            // the former, at most
constexpr std::size_t kLeap = 2654435761;  // a prime

// The surface of one closed solid, its quads in a tree.
class SolidSurface {
 public:
  SolidSurface(const scene::Surfaces& surfaces, std::span<const CasterQuad> quads)
      : surfaces_(surfaces), quads_(quads) {
    std::vector<Box3> boxes(quads.size());
    for (std::size_t i = 0; i < quads.size(); ++i)
      for (const std::uint32_t c : quads[i].corners) boxes[i].add(at(c));
    tree_ = buildBinaryTree(boxes, 4);
  }

  [[nodiscard]] const Box3& box() const { return tree_.nodes[0].box; }

  // The nearest point of the surface.
  [[nodiscard]] Vec3 nearest(const Vec3& p) const {
    Vec3 best(0.0);
    double least2 = std::numeric_limits<double>::infinity();
    walk([&](const Box3& b) { return distance2(b, p); }, [&](double near2) { return near2 < least2; },
         [&](const Vec3& a, const Vec3& b, const Vec3& c) {
           const Vec3 q = nearestOnTriangle(p, a, b, c);
           const double d2 = glm::dot(q - p, q - p);
           if (d2 < least2) least2 = d2, best = q;
         });
    return best;
  }

  // How often the surface is wound around a point, counted along a way that starts there; nothing when the way passes too near to
  // an edge to tell.
  [[nodiscard]] std::optional<int> winding(const Vec3& p, const Vec3& way) const {
    int count = 0;
    bool doubtful = false;
    walk([&](const Box3& b) { return meetsWay(b, 0.0, p, Vec4(way, 0.0)) ? 0.0 : 1.0; },
         [](double misses) { return misses == 0.0; },
         [&](const Vec3& a, const Vec3& b, const Vec3& c) {
           const std::optional<int> crossing = cross(p, way, a, b, c);
           if (crossing)
             count += *crossing;
           else
             doubtful = true;
         });
    return doubtful ? std::nullopt : std::optional(count);
  }

 private:
  [[nodiscard]] Vec3 at(std::uint32_t position) const { return Vec3(surfaces_.positions[position]); }

  static double distance2(const Box3& b, const Vec3& p) {
    const Vec3 d = glm::max(glm::max(b.min - p, p - b.max), Vec3(0.0));
    return glm::dot(d, d);
  }

  // 1 where the way leaves through the outer side, -1 where it enters, 0 where it misses.
  static std::optional<int> cross(const Vec3& p, const Vec3& way, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 x = a - p, y = b - p, z = c - p;
    const double sides[3] = {glm::dot(way, glm::cross(x, y)), glm::dot(way, glm::cross(y, z)),
                             glm::dot(way, glm::cross(z, x))};
    const double size = std::max({glm::dot(x, x), glm::dot(y, y), glm::dot(z, z)});
    const bool out = sides[0] > 0.0 && sides[1] > 0.0 && sides[2] > 0.0;
    const bool in = sides[0] < 0.0 && sides[1] < 0.0 && sides[2] < 0.0;
    for (const double s : sides)
      if (std::abs(s) < 1e-12 * size) return std::nullopt;
    if (!out && !in) return 0;
    const double before = glm::dot(x, glm::cross(y, z));  // of one sign with `out` where the triangle is ahead
    return out ? (before > 0.0 ? 1 : 0) : (before < 0.0 ? -1 : 0);
  }

  // Visits the triangles of all nodes whose measure is wanted, the one of less measure first.
  template <class Measure, class Wanted, class Visit>
  void walk(const Measure& measure, const Wanted& wanted, const Visit& visit) const {
    struct Entry {
      std::int32_t node;
      double measure;
    };
    Entry stack[128];  // deeper than the tree
    int top = 0;
    stack[top++] = {0, measure(tree_.nodes[0].box)};
    while (top > 0) {
      const Entry entry = stack[--top];
      if (!wanted(entry.measure)) continue;
      const BinaryTree::Node& node = tree_.nodes[static_cast<std::size_t>(entry.node)];
      if (node.left >= 0) {
        const auto left = static_cast<std::size_t>(node.left);
        Entry a{node.left, measure(tree_.nodes[left].box)}, b{node.left + 1, measure(tree_.nodes[left + 1].box)};
        if (a.measure < b.measure) std::swap(a, b);
        stack[top++] = a, stack[top++] = b;
        continue;
      }
      for (std::size_t i = node.begin; i < node.end; ++i) {
        const auto& c = quads_[tree_.order[i]].corners;
        visit(at(c[0]), at(c[1]), at(c[2]));
        if (c[3] != c[2]) visit(at(c[0]), at(c[2]), at(c[3]));
      }
    }
  }

  const scene::Surfaces& surfaces_;
  std::span<const CasterQuad> quads_;
  BinaryTree tree_;
};

bool isWithin(const SolidSurface& surface, const Vec3& p) {
  const auto a = surface.winding(p, {0.3129, -0.5717, 0.7584}), b = surface.winding(p, {-0.6511, 0.2203, -0.7263});
  return a && b && *a == *b && *a != 0;
}

// About the largest ball within that touches the surface at `from`: shrunk from one of `radius` until next to nothing is in it.
std::optional<Ball> shrink(const SolidSurface& surface, const Vec3& from, const Vec3& inwards, double radius) {
  constexpr int kSteps = 24;
  // The largest among those that nearly fit, since the neighbours of a coarse face cut a part off the ball.
  Ball largest{from, 0.0}, last{from, 0.0};
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 centre = from + radius * inwards, met = surface.nearest(centre);
    last = {centre, glm::distance(met, centre)};
    if (last.radius >= radius * (1.0 - kCoarse) && last.radius > largest.radius) largest = last;
    if (last.radius >= radius * (1.0 - kLoose)) break;
    const Vec3 to = met - from;
    const double ahead = glm::dot(to, inwards), smaller = glm::dot(to, to) / (2.0 * ahead);
    if (!(ahead > 0.0) || !(smaller < radius)) break;
    radius = smaller;
  }
  if (largest.radius > 0.0 && isWithin(surface, largest.centre)) return largest;
  if (isWithin(surface, last.centre)) return last;
  return std::nullopt;
}

// Whether a ball is near enough below a place of the surface to hide what the surface there hides.
bool isBefore(std::span<const Ball> balls, const Vec3& p) {
  return std::any_of(balls.begin(), balls.end(), [&](const Ball& b) {
    const Vec3 to = p - b.centre;
    const double far = b.radius * (1.0 + kNear);
    return glm::dot(to, to) < far * far;
  });
}

void addBalls(const scene::Surfaces& surfaces, std::span<const CasterQuad> quads, std::vector<Ball>& out) {
  const SolidSurface surface(surfaces, quads);
  const auto at = [&](std::uint32_t position) { return Vec3(surfaces.positions[position]); };
  const auto area = [&](const CasterQuad& q) {
    return glm::cross(at(q.corners[1]) - at(q.corners[0]), at(q.corners[2]) - at(q.corners[0]));
  };
  double whole = 0.0;
  for (const CasterQuad& q : quads) whole += 0.5 * glm::length(area(q)) * (q.corners[3] != q.corners[2] ? 2.0 : 1.0);
  const double least = std::sqrt(kLeastShare * whole / double(quads.size()) / std::numbers::pi);

  const std::size_t samples = std::min(quads.size() / kQuadsPerSample, kMostSamples), first = out.size();
  for (std::size_t i = 0; i < samples; ++i) {
    // In an order that leaps about: then few balls stand beside each other before the gaps between them are filled.
    const CasterQuad& q = quads[(i * kLeap % samples) * quads.size() / samples];
    const Vec3 normal = area(q), middle = (at(q.corners[0]) + at(q.corners[1]) + at(q.corners[2])) / 3.0;
    if (!(glm::length(normal) > 0.0) || isBefore(std::span(out).subspan(first), middle)) continue;
    const auto ball = shrink(surface, middle, -glm::normalize(normal), surface.box().radius());
    if (ball && ball->radius >= least) out.push_back(*ball);
  }
}

}  // namespace

std::vector<Ball> findBalls(const scene::Surfaces& surfaces, const Casters& casters) {
  // The quads of each solid, together.
  std::vector<CasterQuad> quads;
  quads.reserve(casters.quads.size());
  for (const CasterQuad& q : casters.quads)
    if (q.solid >= 0) quads.push_back(q);
  std::stable_sort(quads.begin(), quads.end(),
                   [](const CasterQuad& a, const CasterQuad& b) { return a.solid < b.solid; });
  std::vector<Ball> balls;
  for (std::size_t begin = 0; begin < quads.size();) {
    std::size_t end = begin;
    while (end < quads.size() && quads[end].solid == quads[begin].solid) ++end;
    if (end - begin >= kFewestQuads) addBalls(surfaces, std::span(quads).subspan(begin, end - begin), balls);
    begin = end;
  }
  return balls;
}

}  // namespace umbrage::study::detail
