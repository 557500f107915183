// Source: Vatti, A generic solution to polygon clipping, 1992, as in Johnson's Clipper 6.
#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

#include "umbrage/outline/detail/grid.hpp"

namespace umbrage::outline::detail {
namespace {

using ClipperLib::Path;
using ClipperLib::PolyNode;

// Clipper multiplies coordinates up to this in 64 bits.
constexpr double kReach = double(1 << 29);

Ring ringOf(const Path& path, const Grid& grid) {
  Ring ring;
  ring.reserve(path.size());
  for (const auto& p : path) ring.push_back(grid.place({p.X, p.Y}));
  return ring;
}

bool isSeam(const Path& hole) {
  double around = 0.0;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const auto &a = hole[i], &b = hole[(i + 1) % hole.size()];
    around += std::hypot(double(b.X - a.X), double(b.Y - a.Y));
  }
  return std::abs(ClipperLib::Area(hole)) <= around;
}

// Outer rings are the children of holes and of the root, holes those of outer rings.
void collect(const PolyNode& parent, const Grid& grid, Region& region) {
  for (const PolyNode* outer : parent.Childs) {
    Polygon polygon{ringOf(outer->Contour, grid), {}};
    region.area += areaOf(polygon.outer);
    for (const PolyNode* hole : outer->Childs) {
      collect(*hole, grid, region);
      if (isSeam(hole->Contour)) continue;
      polygon.holes.push_back(ringOf(hole->Contour, grid));
      region.area += areaOf(polygon.holes.back());
    }
    region.polygons.push_back(std::move(polygon));
  }
}

void addLoops(ClipperLib::Clipper& clipper, const std::vector<Loop>& loops, ClipperLib::PolyType role) {
  Path path;
  for (const Loop& loop : loops) {
    path.clear();
    for (const GridPoint& p : loop) path.emplace_back(p.x, p.y);
    clipper.AddPath(path, role, true);
  }
}

}  // namespace

Grid::Grid(const Extent& extent) {
  if (extent.empty()) return;
  origin_ = 0.5 * (extent.min + extent.max);
  const double half = std::max(extent.max.x - origin_.x, extent.max.y - origin_.y);
  if (half > 0.0) step_ = std::exp2(std::ceil(std::log2(half / kReach)));
  // Points that are whole multiples of the step, as those of a regular town, stay exactly where they are.
  origin_ = step_ * glm::round(origin_ / step_);
}

GridPoint Grid::snap(const Vec2& p) const {
  const Vec2 at = (p - origin_) / step_;
  return {std::llround(at.x), std::llround(at.y)};
}

Region unite(const std::vector<Loop>& loops, const Grid& grid) {
  ClipperLib::Clipper clipper;
  addLoops(clipper, loops, ClipperLib::ptSubject);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  Region region;
  collect(tree, grid, region);
  return region;
}

std::vector<Loop> combine(const std::vector<Loop>& loops, const std::vector<Loop>& others, Set set) {
  ClipperLib::Clipper clipper;
  addLoops(clipper, loops, ClipperLib::ptSubject);
  addLoops(clipper, others, ClipperLib::ptClip);
  ClipperLib::Paths paths;
  clipper.Execute(set == Set::difference ? ClipperLib::ctDifference : ClipperLib::ctIntersection, paths,
                  ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  std::vector<Loop> out;
  for (const Path& path : paths) {
    if (isSeam(path)) continue;
    Loop& loop = out.emplace_back();
    for (const auto& p : path) loop.push_back({p.X, p.Y});
  }
  return out;
}

}  // namespace umbrage::outline::detail
