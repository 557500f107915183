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

Region newShadow(const std::vector<CasterPart>& added, const std::vector<CasterPart>& standing, const Vec2& slope,
                 const std::optional<Region>& within) {
  // Casters whose shadow is wholly elsewhere change nothing and would only coarsen the grid.
  const Extent window = within ? extentOf(*within) : Extent{};
  std::vector<const CasterPart*> ours, others;
  Extent extent, reach;
  for (const CasterPart& part : added) {
    const Extent shadow = shadowExtent(part, slope);
    if (shadow.empty() || (within && (window.empty() || !shadow.touches(window)))) continue;
    ours.push_back(&part);
    reach.add(shadow);
  }
  if (ours.empty()) return {};
  extent = reach;
  for (const CasterPart& part : standing) {
    const Extent shadow = shadowExtent(part, slope);
    if (shadow.empty() || !shadow.touches(reach) || (within && !shadow.touches(window))) continue;
    others.push_back(&part);
    extent.add(shadow);
  }
  if (within) extent.add(window);
  const Grid grid(extent);
  std::vector<Loop> loops, covered;
  for (const CasterPart* part : ours) addShadow(*part, slope, grid, loops);
  for (const CasterPart* part : others) addShadow(*part, slope, grid, covered);
  loops = detail::combine(loops, covered, detail::Set::difference);
  if (within) loops = detail::combine(loops, loopsOf(*within, grid), detail::Set::intersection);
  return detail::unite(loops, grid);
}

}  // namespace umbrage::outline
