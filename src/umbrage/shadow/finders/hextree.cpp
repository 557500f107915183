// A tree over the edges in dual space, in which a light is a hyperplane and the silhouette is what it cuts.
//
// The published hextree keeps a segment in the smallest fixed cell that holds both its ends. Cells are cut where geometry does not care:
// whatever has its ends on either side of n.z = 0 stays at the root, be it as short as it may, and is tested every time. Of a city
// of boxes that is 64 % of the edges, of a smooth mesh 33 % in the upper four levels, and no depth helps. Here
// 1. a segment has one of its two equivalent forms, chosen by directions that no model is built along, so that
//    edges which are crossed alike lie together;
// 2. there are no cells: segments are ordered by halving them along the axis of their widest spread, all 8 coordinates of the two
//    ends alike, and every 16 neighbours are a leaf, every 16 nodes a node, with tight boxes around what they hold;
// 3. first and second ends have a box each, so a node is not only skipped when both lie on one side of the hyperplane; when they
//    lie on different sides, all its edges are on the silhouette, with a known sign, untested;
// 4. bounds carry what rounding can do (kDoubt), and only edges within it go to the predicate.
// Source: Hertzmann and Zorin, Illustrating smooth surfaces, 2000; the hextree is that of the paper Geometry of Real Time Shadows.
#include "umbrage/shadow/finders/hextree.hpp"

#include "umbrage/shadow/finders/threads.hpp"

namespace umbrage::shadow {
namespace {

// An object, not a function, so that it is inlined where segments are ordered.
constexpr auto coordinate = [](const DualEdge& segment, int k) {
  return segment.point[static_cast<std::size_t>(k >> 2)][static_cast<std::size_t>(k & 3)];
};

}  // namespace

Hextree::Hextree(std::shared_ptr<const CasterSet> casters, const FinderOptions& options)
    : SilhouetteFinder(FinderKind::hextree, casters),
      exact_(*casters),
      avx2_(options.vectorUnits && processorHasAvx2()) {
  DualEdges dual = dualEdges(*casters, threadCount(options.threads));
  frame_ = dual.frame;
  always_ = std::move(dual.always);
  tree_ = SegmentTree<8>::build<8>(dual.segments, threadCount(options.threads), coordinate,
                                   [](const DualEdge& s, const auto& add) {
                                     SegmentTree<8>::Point p;
                                     for (int k = 0; k < 8; ++k) p[k] = coordinate(s, k);
                                     add(p);
                                   });
}

FoundEdges Hextree::find(const Vec4& light, const SilhouetteOptions& options) const {
  const DualPoint u = dualLight(frame_, light);
  const auto judge = [&](const Boxes<8>& boxes) -> NodeFate {
    const LaneSigns signs = laneSigns(boxes.bound, u, avx2_);
    return {signs.same(), signs.falling(), signs.rising()};
  };
  Collector collector;
  const std::size_t tested = tree_.find(u, judge, TagReader(options), avx2_, collector);
  for (const std::uint32_t edge : always_) collector.addDoubtful(edge);
  ExactEdges::Query exact(exact_, casters(), light, options);
  return {collector.take(exact, casters().edges.size()), tested + always_.size(), kind()};
}

std::size_t Hextree::memory() const {
  return exact_.memory() + always_.capacity() * sizeof(std::uint32_t) + tree_.memory();
}

}  // namespace umbrage::shadow
