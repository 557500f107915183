// An octree over the places of a point light. Over a whole cell an edge is never on the silhouette, always on it with one sign, or
// perhaps; only the last are tested. What is decided for a cell is stored there and not again in its children.
//
// The planes of a mesh cut a cell of side s of the volume for about s of all faces, so halving cells halves the work and takes four times
// the memory: where memory is bounded, cost stays proportional to the mesh. Cells with the most open edges are divided first.
// Source: Kobrtek, Milet and Herout, Silhouette extraction for shadow volumes using potentially visible sets, 2018.
#include "umbrage/shadow/finders/potentially_visible.hpp"

#include <cmath>
#include <queue>
#include <utility>

#include "umbrage/shadow/finders/threads.hpp"

namespace umbrage::shadow {
namespace {

constexpr std::uint32_t kAway = 1u << 31;
constexpr std::size_t kEnough = 64;            // open edges in a cell that are not worth dividing it
constexpr std::size_t kSmallest = 16u << 20u;  // bytes that any mesh may take

float product(const DualPoint& p, const DualPoint& u) {
  return ((p[0] * u[0] + p[1] * u[1]) + p[2] * u[2]) + p[3] * u[3];
}

int sureSign(float value) { return value > kDoubt ? +1 : (value < -kDoubt ? -1 : 0); }

// The side of a plane that a whole box of lights lies on; 0 when it may be cut. For a light x the product with the dual light is
// (n.x + d) / (|x| + 1) in dual units, which must be beyond kDoubt with every rounding it allows for.
int sideOf(const DualPoint& p, const Vec3& centre, const Vec3& half, double doubt) {
  const double value = p[0] * centre.x + p[1] * centre.y + p[2] * centre.z + p[3];
  const double reach = std::abs(p[0]) * half.x + std::abs(p[1]) * half.y + std::abs(p[2]) * half.z + doubt;
  return value > reach ? +1 : (value < -reach ? -1 : 0);
}

Box3 octant(const Box3& box, unsigned i) {
  const Vec3 middle = box.centre();
  Box3 part = box;
  for (int k = 0; k < 3; ++k) ((i >> k & 1) != 0 ? part.min : part.max)[k] = middle[k];
  return part;
}

}  // namespace

PotentiallyVisible::PotentiallyVisible(std::shared_ptr<const CasterSet> casters, const FinderOptions& options)
    : SilhouetteFinder(FinderKind::potentiallyVisible, casters), exact_(*casters) {
  DualEdges dual = dualEdges(*casters, threadCount(options.threads));
  frame_ = dual.frame;
  always_ = std::move(dual.always);
  segments_ = std::move(dual.segments);
  if (!(frame_.radius > 0.0)) return;
  const Vec3 half = 0.5 * options.litVolume * casters->bounds.size() / frame_.radius + Vec3(1e-3);
  Box3 root;
  root.add(-half), root.add(half);
  volume_.add(frame_.centre - half * frame_.radius), volume_.add(frame_.centre + half * frame_.radius);
  std::vector<std::uint32_t> all(segments_.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  cells_.push_back(cellOf(root, all));
  grow(std::max(kSmallest, static_cast<std::size_t>(options.bytesPerEdge * double(casters->edges.size()))));
}

PotentiallyVisible::Cell PotentiallyVisible::cellOf(const Box3& box,
                                                    const std::vector<std::uint32_t>& candidates) const {
  const Vec3 centre = box.centre(), half = 0.5 * box.size();
  const double doubt = 4.0 * double(kDoubt) * (glm::length(glm::abs(centre) + half) + 1.0);
  Cell cell{box, 0, {}, {}};
  for (const std::uint32_t i : candidates) {
    const int a = sideOf(segments_[i].point[0], centre, half, doubt),
              b = sideOf(segments_[i].point[1], centre, half, doubt);
    if (a == 0 || b == 0)
      cell.maybe.push_back(i);
    else if (a != b)
      cell.always.push_back(i | (a < 0 ? kAway : 0));
  }
  cell.always.shrink_to_fit(), cell.maybe.shrink_to_fit();
  return cell;
}

void PotentiallyVisible::grow(std::size_t budget) {
  std::priority_queue<std::pair<std::size_t, std::size_t>> largest;
  largest.emplace(cells_[0].maybe.size(), 0);
  std::size_t bytes = memory();
  while (!largest.empty()) {
    const auto [open, index] = largest.top();
    largest.pop();
    if (open <= kEnough) return;
    std::vector<Cell> children;
    std::size_t more = 0;
    for (unsigned i = 0; i < 8; ++i) {
      children.push_back(cellOf(octant(cells_[index].box, i), cells_[index].maybe));
      more += (children.back().maybe.size() + children.back().always.size()) * sizeof(std::uint32_t) + sizeof(Cell);
    }
    if (bytes + more > budget + open * sizeof(std::uint32_t)) continue;
    bytes += more - open * sizeof(std::uint32_t);
    cells_[index].firstChild = static_cast<std::uint32_t>(cells_.size());
    cells_[index].maybe = {};
    for (Cell& child : children) {
      largest.emplace(child.maybe.size(), cells_.size());
      cells_.push_back(std::move(child));
    }
  }
}

void PotentiallyVisible::test(const DualEdge& segment, const DualPoint& light, const TagReader& reader,
                              Collector& out) const {
  const int a = sureSign(product(segment.point[0], light)), b = sureSign(product(segment.point[1], light));
  if (a == 0 || b == 0)
    out.addDoubtful(segment.tag & kTagEdge);
  else if (a != b)
    reader.crossed(segment.tag, a > 0, out);
}

FoundEdges PotentiallyVisible::find(const Vec4& light, const SilhouetteOptions& options) const {
  const DualPoint u = dualLight(frame_, light);
  const TagReader reader(options);
  Collector collector;
  FoundEdges found{{}, always_.size(), kind()};
  const Vec3 place = (Vec3(light) - frame_.centre) / frame_.radius;
  const auto holds = [&](const Box3& box) {
    return glm::all(glm::greaterThanEqual(place, box.min)) && glm::all(glm::lessThanEqual(place, box.max));
  };
  if (light.w == 1.0 && !cells_.empty() && holds(cells_[0].box)) {
    std::size_t cell = 0;
    while (true) {
      for (const std::uint32_t i : cells_[cell].always)
        reader.crossed(segments_[i & ~kAway].tag, (i & kAway) == 0, collector);
      if (cells_[cell].firstChild == 0) break;
      const Vec3 middle = cells_[cell].box.centre();
      cell = cells_[cell].firstChild + (place.x > middle.x) + 2u * (place.y > middle.y) + 4u * (place.z > middle.z);
    }
    for (const std::uint32_t i : cells_[cell].maybe) test(segments_[i], u, reader, collector);
    found.tested += cells_[cell].maybe.size();
  } else {
    for (const DualEdge& segment : segments_) test(segment, u, reader, collector);
    found.tested += segments_.size();
    found.answeredBy = FinderKind::bruteForceSimd;
  }
  for (const std::uint32_t edge : always_) collector.addDoubtful(edge);
  ExactEdges::Query exact(exact_, casters(), light, options);
  found.edges = collector.take(exact, casters().edges.size());
  return found;
}

std::size_t PotentiallyVisible::memory() const {
  std::size_t bytes = exact_.memory() + segments_.capacity() * sizeof(DualEdge) + cells_.capacity() * sizeof(Cell);
  for (const Cell& cell : cells_) bytes += (cell.always.capacity() + cell.maybe.capacity()) * sizeof(std::uint32_t);
  return bytes + always_.capacity() * sizeof(std::uint32_t);
}

}  // namespace umbrage::shadow
