#include "umbrage/outline/combine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "umbrage/base/check.hpp"
#include "umbrage/outline/detail/above.hpp"
#include "umbrage/outline/detail/grid.hpp"
#include "umbrage/outline/detail/winding.hpp"

namespace umbrage::outline {
namespace {

using detail::Extent;
using detail::Grid;
using detail::Loop;

Extent extentOf(const Region& region) {
  Extent extent;
  for (const Polygon& polygon : region.polygons)
    for (const Vec2& p : polygon.outer) extent.add(p);
  return extent;
}

void addRing(const Ring& ring, const Grid& grid, std::vector<Loop>& loops) {
  Loop& loop = loops.emplace_back();
  for (const Vec2& p : ring) loop.push_back(grid.snap(p));
}

void addLoops(const Region& region, const Grid& grid, std::vector<Loop>& loops) {
  for (const Polygon& polygon : region.polygons) {
    addRing(polygon.outer, grid, loops);
    for (const Ring& hole : polygon.holes) addRing(hole, grid, loops);
  }
}

std::vector<Loop> loopsOf(const Region& region, const Grid& grid) {
  std::vector<Loop> loops;
  addLoops(region, grid, loops);
  return loops;
}

Region combined(const Region& a, const Region& b, detail::Set set) {
  Extent extent = extentOf(a);
  if (extent.empty()) return {};
  extent.add(extentOf(b));
  const Grid grid(extent);
  return detail::unite(detail::combine(loopsOf(a, grid), loopsOf(b, grid), set), grid);
}

// A polygon of the points at `distance` around an edge: a rectangle with round ends.
Loop roundedEdge(const Vec2& a, const Vec2& b, double distance, int corners, const Grid& grid) {
  Loop loop;
  const Vec2 along = b - a;
  const double turn = std::atan2(along.y, along.x);
  for (const auto& [centre, start] :
       {std::pair(b, turn - 0.5 * std::numbers::pi), std::pair(a, turn + 0.5 * std::numbers::pi)})
    for (int i = 0; i <= corners; ++i) {
      const double angle = start + std::numbers::pi * i / corners;
      loop.push_back(grid.snap(centre + distance * Vec2(std::cos(angle), std::sin(angle))));
    }
  return loop;
}

bool holdsRing(const Ring& ring, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
  }
  return in;
}

double distanceToEdge(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * along);
}

template <class Fn>
void forEdges(const Region& region, Fn&& fn) {
  const auto ring = [&](const Ring& r) {
    for (std::size_t i = 0; i < r.size(); ++i) fn(r[i], r[(i + 1) % r.size()]);
  };
  for (const Polygon& polygon : region.polygons) {
    ring(polygon.outer);
    for (const Ring& hole : polygon.holes) ring(hole);
  }
}

Vec2 projected(const Vec3& p, const Vec2& slope) { return Vec2(p) + p.z * slope; }

Extent shadowExtent(const CasterPart& part, const Vec2& slope) {
  Extent extent;
  for (const mesh::Triangle& t : part.triangles)
    for (const std::uint32_t corner : t) extent.add(projected(part.points[corner], slope));
  return extent;
}

void addShadow(const CasterPart& part, const Vec2& slope, const Grid& grid, std::vector<Loop>& loops) {
  std::vector<detail::GridPoint> points;
  points.reserve(part.points.size());
  for (const Vec3& p : part.points) points.push_back(grid.snap(projected(p, slope)));
  for (Loop& loop : detail::windingLoops(points, part.triangles)) loops.push_back(std::move(loop));
}

struct ShadowLoops {
  std::vector<Loop> loops;
  Grid grid{Vec2(0.0), 1.0};
};

// The new shadow of what touches the window, if there is one; empty where nothing does.
ShadowLoops newLoops(const std::vector<CasterPart>& added, const std::vector<CasterPart>& standing, const Vec2& slope,
                     const Extent* window) {
  // Casters whose shadow is wholly elsewhere change nothing and would only coarsen the grid.
  std::vector<const CasterPart*> ours, others;
  Extent extent, reach;
  for (const CasterPart& part : added) {
    const Extent shadow = shadowExtent(part, slope);
    if (shadow.empty() || (window != nullptr && (window->empty() || !shadow.touches(*window)))) continue;
    ours.push_back(&part);
    reach.add(shadow);
  }
  if (ours.empty()) return {};
  extent = reach;
  for (const CasterPart& part : standing) {
    const Extent shadow = shadowExtent(part, slope);
    if (shadow.empty() || !shadow.touches(reach) || (window != nullptr && !shadow.touches(*window))) continue;
    others.push_back(&part);
    extent.add(shadow);
  }
  if (window != nullptr) extent.add(*window);
  const Grid grid(extent);
  std::vector<Loop> loops, covered;
  for (const CasterPart* part : ours) addShadow(*part, slope, grid, loops);
  for (const CasterPart* part : others) addShadow(*part, slope, grid, covered);
  return {detail::combine(loops, covered, detail::Set::difference), grid};
}

std::size_t cornersOf(const Region& region) {
  std::size_t count = 0;
  forEdges(region, [&](const Vec2&, const Vec2&) { ++count; });
  return count;
}

Region rectangleOf(const Extent& e) {
  Region region;
  region.polygons.push_back({{e.min, {e.max.x, e.min.y}, e.max, {e.min.x, e.max.y}}, {}});
  region.area = (e.max.x - e.min.x) * (e.max.y - e.min.y);
  return region;
}

// The parallel to an axis through the middle that meets the fewest edges: each edge that is met is in both halves.
struct Cut {
  int axis = 0;
  double at = 0.0;
  std::size_t met = 0;
};
Cut bestCut(const Region& region, const Extent& extent) {
  Cut cuts[2];
  for (int axis = 0; axis < 2; ++axis) {
    cuts[axis] = {axis, 0.5 * (extent.min[axis] + extent.max[axis]), 0};
    forEdges(region, [&](const Vec2& a, const Vec2& b) {
      if ((a[axis] < cuts[axis].at) != (b[axis] < cuts[axis].at)) ++cuts[axis].met;
    });
  }
  return cuts[1].met < cuts[0].met ? cuts[1] : cuts[0];
}

constexpr int kDeepestCut = 16;  // where many corners lie in one place

void addPieces(const Region& region, std::size_t corners, int deepest, std::vector<Region>& pieces) {
  if (region.polygons.empty()) return;
  const std::size_t count = cornersOf(region);
  Extent low = extentOf(region), high = low;
  const Cut cut = bestCut(region, low);
  if (deepest == 0 || count <= corners || 4 * cut.met > count) {
    pieces.push_back(region);
    return;
  }
  low.max[cut.axis] = high.min[cut.axis] = cut.at;
  for (const Extent& half : {low, high}) addPieces(common(region, rectangleOf(half)), corners, deepest - 1, pieces);
}

}  // namespace

Region without(const Region& a, const Region& b) { return combined(a, b, detail::Set::difference); }
Region common(const Region& a, const Region& b) { return combined(a, b, detail::Set::intersection); }

Region together(const std::vector<Region>& regions) {
  Extent extent;
  for (const Region& region : regions) extent.add(extentOf(region));
  if (extent.empty()) return {};
  const Grid grid(extent);
  std::vector<Loop> loops;
  for (const Region& region : regions) addLoops(region, grid, loops);
  return detail::unite(loops, grid);
}

Region grown(const Region& region, double distance, double tolerance) {
  UMBRAGE_CHECK(distance > 0.0 && tolerance > 0.0, "growing needs a distance and a tolerance");
  Extent extent = extentOf(region);
  if (extent.empty()) return {};
  extent.min -= distance, extent.max += distance;
  const Grid grid(extent);
  // The sagitta of a chord of 2 pi / n is distance x (1 - cos(pi / n)).
  const double share = std::clamp(tolerance / distance, 1e-9, 0.5);
  const int corners = std::max(2, static_cast<int>(std::ceil(0.5 * std::numbers::pi / std::acos(1.0 - share))));
  std::vector<Loop> loops = loopsOf(region, grid);
  forEdges(region, [&](const Vec2& a, const Vec2& b) { loops.push_back(roundedEdge(a, b, distance, corners, grid)); });
  return detail::unite(loops, grid);
}

bool covers(const Region& region, const Vec2& point) {
  bool in = false;
  for (const Polygon& polygon : region.polygons) {
    in = in != holdsRing(polygon.outer, point);
    for (const Ring& hole : polygon.holes) in = in != holdsRing(hole, point);
  }
  return in;
}

double distanceTo(const Region& region, const Vec2& point) {
  if (covers(region, point)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  forEdges(region, [&](const Vec2& a, const Vec2& b) { nearest = std::min(nearest, distanceToEdge(a, b, point)); });
  return nearest;
}

std::vector<CasterPart> aboveHeight(const std::vector<CasterPart>& parts, double height) {
  std::vector<CasterPart> raised;
  for (const CasterPart& part : parts)
    if (CasterPart above = detail::above(part, height); !above.triangles.empty()) raised.push_back(std::move(above));
  return raised;
}

std::vector<Region> inPieces(const Region& region, std::size_t corners) {
  UMBRAGE_CHECK(corners >= 16, "pieces of so few corners are cut for ever");
  std::vector<Region> pieces;
  addPieces(region, corners, kDeepestCut, pieces);
  return pieces;
}

Region newShadow(const std::vector<CasterPart>& added, const std::vector<CasterPart>& standing, const Vec2& slope,
                 const std::optional<Region>& within) {
  const Extent window = within ? extentOf(*within) : Extent{};
  const ShadowLoops shadow = newLoops(added, standing, slope, within ? &window : nullptr);
  if (shadow.loops.empty()) return {};
  if (!within) return detail::unite(shadow.loops, shadow.grid);
  return detail::unite(detail::combine(shadow.loops, loopsOf(*within, shadow.grid), detail::Set::intersection),
                       shadow.grid);
}

double newShadowArea(const std::vector<CasterPart>& added, const std::vector<CasterPart>& standing, const Vec2& slope,
                     const std::vector<Region>& regions) {
  Extent window;
  std::vector<Extent> extents;
  for (const Region& region : regions) extents.push_back(extentOf(region)), window.add(extents.back());
  if (window.empty()) return 0.0;
  const ShadowLoops shadow = newLoops(added, standing, slope, &window);
  if (shadow.loops.empty()) return 0.0;
  Extent reach;
  for (const Loop& loop : shadow.loops)
    for (const detail::GridPoint& p : loop) reach.add(shadow.grid.place(p));
  double area = 0.0;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (!extents[i].touches(reach)) continue;
    const auto common = detail::combine(shadow.loops, loopsOf(regions[i], shadow.grid), detail::Set::intersection);
    area += detail::unite(common, shadow.grid).area;
  }
  return area;
}

}  // namespace umbrage::outline
