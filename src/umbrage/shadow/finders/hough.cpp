// A tree over the edges in Hough space.
//
// The plane n.x = p becomes the point h = p n, the foot of the perpendicular from the origin (the casters' centre). With a light at l,
// h.l - |h|^2 = p (n.l - p): h lies inside the sphere over the diameter from the origin to l exactly when the light is on the side of
// the plane that does not hold the origin. For a direction the sphere is a half-space. So a box of points that the sphere does not cut
// decides all faces whose points it holds; edges whose planes see the origin on different sides form a tree of their own, in which
// a box that is not cut means on the silhouette instead of off it. Faces whose planes pass close by the origin cluster there, on the sphere,
// and are tested every time: the price of three dimensions instead of four.
// Source: Olson and Zhang, Silhouette extraction in Hough space, 2006.
#include "umbrage/shadow/finders/hough.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/shadow/finders/threads.hpp"

namespace umbrage::shadow {
namespace {

// A dual point holds n and -p.
constexpr auto coordinate = [](const DualEdge& segment, int k) {
  const DualPoint& p = segment.point[static_cast<std::size_t>(k / 3)];
  return -p[3] * p[k % 3];
};

SegmentTree<3> makeTree(std::span<const DualEdge> segments, unsigned threads) {
  return SegmentTree<3>::build<6>(segments, threads, coordinate, [](const DualEdge& s, const auto& add) {
    for (int end = 0; end < 6; end += 3) add({coordinate(s, end), coordinate(s, end + 1), coordinate(s, end + 2)});
  });
}

// Which of eight boxes lie inside the sphere, and which outside, for certain.
//
// f(h) = h.u - w |h|^2 over the light u of dualLight is (p / r) (p.u of the dual point), so |f| > 2 kDoubt |h| proves the sign that the
// predicate finds (the plane's distance as it was rounded into h stands for itself: kDoubt covers that rounding). Computing f in single
// precision errs by less than 2^-20 of the sum of |h| over the axes, which bounds |h|.
struct Sides {
  std::uint32_t inside, outside;
};

constexpr float kSphereDoubt = 4.0f * kDoubt;

Sides sides(const Boxes<3>& boxes, const DualPoint& light) {
  const float w = light[3];
  float least[kLanes]{}, most[kLanes]{}, reach[kLanes]{};
  for (int k = 0; k < 3; ++k) {
    const float u = light[k];
    // Where the concave f is greatest on this axis.
    const float top = w > 0.0f ? u / (2.0f * w) : std::copysign(2.0f, u);
    for (int lane = 0; lane < kLanes; ++lane) {
      const float low = boxes.bound[0][k][lane], high = boxes.bound[1][k][lane];
      const float x = std::min(std::max(top, low), high);
      least[lane] += std::min(low * u - w * low * low, high * u - w * high * high);
      most[lane] += x * u - w * x * x;
      reach[lane] += std::max(std::abs(low), std::abs(high));
    }
  }
  Sides s{};
  for (int lane = 0; lane < kLanes; ++lane) {
    s.inside |= std::uint32_t{least[lane] > kSphereDoubt * reach[lane]} << lane;
    s.outside |= std::uint32_t{most[lane] < -kSphereDoubt * reach[lane]} << lane;
  }
  return s;
}

// Ends in the order that makes the first see the origin behind it, so that inside the sphere it faces the light.
DualEdge outwardFirst(DualEdge segment) {
  if (segment.point[0][3] > 0.0f) {
    std::swap(segment.point[0], segment.point[1]);
    segment.tag ^= kTagNegative;
  }
  return segment;
}

}  // namespace

Hough::Hough(std::shared_ptr<const CasterSet> casters, const FinderOptions& options)
    : SilhouetteFinder(FinderKind::hough, casters), exact_(*casters), avx2_(options.vectorUnits && processorHasAvx2()) {
  DualEdges dual = dualEdges(*casters, threadCount(options.threads));
  frame_ = dual.frame;
  always_ = std::move(dual.always);
  const auto border = std::partition(dual.segments.begin(), dual.segments.end(), [](const DualEdge& s) {
    return (s.point[0][3] > 0.0f) == (s.point[1][3] > 0.0f) && s.point[0][3] != 0.0f && s.point[1][3] != 0.0f;
  });
  std::transform(border, dual.segments.end(), border, outwardFirst);
  const unsigned threads = threadCount(options.threads);
  alike_ = makeTree(std::span(dual.segments.begin(), border), threads);
  opposite_ = makeTree(std::span(border, dual.segments.end()), threads);
}

FoundEdges Hough::find(const Vec4& light, const SilhouetteOptions& options) const {
  const DualPoint u = dualLight(frame_, light);
  const TagReader reader(options);
  Collector collector;
  std::size_t tested = alike_.find(
      u,
      [&](const Boxes<3>& boxes) -> NodeFate {
        const Sides s = sides(boxes, u);
        return {s.inside | s.outside, 0, 0};
      },
      reader, avx2_, collector);
  tested += opposite_.find(
      u,
      [&](const Boxes<3>& boxes) -> NodeFate {
        const Sides s = sides(boxes, u);
        return {0, s.inside, s.outside};
      },
      reader, avx2_, collector);
  for (const std::uint32_t edge : always_) collector.addDoubtful(edge);
  ExactEdges::Query exact(exact_, casters(), light, options);
  return {collector.take(exact, casters().edges.size()), tested + always_.size(), kind()};
}

std::size_t Hough::memory() const {
  return exact_.memory() + always_.capacity() * sizeof(std::uint32_t) + alike_.memory() + opposite_.memory();
}

}  // namespace umbrage::shadow
