#include "umbrage/outline/envelope.hpp"

#include <algorithm>
#include <utility>

#include "umbrage/outline/detail/above.hpp"
#include "umbrage/outline/detail/clusters.hpp"
#include "umbrage/outline/detail/parallel.hpp"
#include "umbrage/outline/detail/sweep.hpp"
#include "umbrage/outline/detail/winding.hpp"

namespace umbrage::outline {
namespace {

using detail::Extent;
using detail::Grid;
using detail::GridPoint;
using detail::Loop;

// So many loops are united at once: the work grows with the square of what lies on top of one another.
constexpr std::size_t kBatch = 12;

double fromSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length = glm::dot(ab, ab);
  const double t = length > 0.0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + t * ab));
}

// The path with fewer corners, each left out within `most` of what replaces it.
SlopePath coarser(const SlopePath& path, double most) {
  SlopePath coarse = path;
  coarse.slopes = {path.slopes.front()};
  for (std::size_t begin = 0; begin + 1 < path.slopes.size();) {
    std::size_t end = begin + 1;
    const auto fits = [&](std::size_t to) {
      for (std::size_t i = begin + 1; i < to; ++i)
        if (fromSegment(path.slopes[i], path.slopes[begin], path.slopes[to]) > most) return false;
      return true;
    };
    while (end + 1 < path.slopes.size() && fits(end + 1)) ++end;
    coarse.slopes.push_back(path.slopes[end]);
    begin = end;
  }
  return coarse;
}

// What is lower may follow the sun less closely for the same error on the ground.
std::vector<SlopePath> pathsFor(double top, double bound, const std::vector<SlopePath>& paths) {
  std::vector<SlopePath> coarse;
  for (const SlopePath& path : paths) coarse.push_back(coarser(path, std::max(0.0, bound / top - path.deviation)));
  return coarse;
}

Extent extentOf(const CasterPart& part, const std::vector<SlopePath>& paths) {
  Extent extent;
  for (const mesh::Triangle& t : part.triangles)
    for (const std::uint32_t corner : t)
      for (const SlopePath& path : paths)
        for (const Vec2& slope : path.slopes) extent.add(Vec2(part.points[corner]) + part.points[corner].z * slope);
  return extent;
}

Extent extentOf(const Region& region) {
  Extent extent;
  for (const Polygon& polygon : region.polygons)
    for (const Vec2& p : polygon.outer) extent.add(p);
  return extent;
}

std::vector<GridPoint> snapped(const CasterPart& part, const Vec2& slope, const Grid& grid) {
  std::vector<GridPoint> points;
  points.reserve(part.points.size());
  for (const Vec3& p : part.points) points.push_back(grid.snap(Vec2(p) + p.z * slope));
  return points;
}

std::vector<Loop> loopsOf(const Region& region, const Grid& grid) {
  std::vector<Loop> loops;
  const auto add = [&](const Ring& ring) {
    Loop& loop = loops.emplace_back();
    for (const Vec2& p : ring) loop.push_back(grid.snap(p));
  };
  for (const Polygon& polygon : region.polygons) {
    add(polygon.outer);
    std::for_each(polygon.holes.begin(), polygon.holes.end(), add);
  }
  return loops;
}

// Loops that only together wind around something: an outer ring and its holes are one piece.
using Piece = std::vector<Loop>;

// The union of batches of pieces, then of what they leave.
Region uniteInBatches(std::vector<Piece> pieces, const Grid& grid) {
  for (;;) {
    std::vector<Piece> united;
    std::vector<Loop> batch;
    std::size_t taken = 0;  // two pieces at least, so that every round has fewer
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (Loop& loop : pieces[i]) batch.push_back(std::move(loop));
      const bool last = i + 1 == pieces.size();
      if ((++taken < 2 || batch.size() < kBatch) && !last) continue;
      Region region = detail::unite(batch, grid);
      if (last && united.empty()) return region;
      united.push_back(loopsOf(region, grid));
      batch.clear();
      taken = 0;
    }
    pieces = std::move(united);
  }
}

Region sweptBy(const CasterPart& part, const std::vector<SlopePath>& paths) {
  const Grid grid(extentOf(part, paths));
  std::vector<Piece> pieces;
  for (const SlopePath& path : paths) {
    std::vector<GridPoint> from = snapped(part, path.slopes.front(), grid);
    pieces.push_back(detail::windingLoops(from, part.triangles));
    for (std::size_t i = 1; i < path.slopes.size(); ++i) {
      std::vector<GridPoint> to = snapped(part, path.slopes[i], grid);
      pieces.push_back(loopsOf(detail::unite(detail::sweptEdges(from, to, part.triangles), grid), grid));
      from = std::move(to);
    }
  }
  return pieces.empty() ? Region{} : uniteInBatches(std::move(pieces), grid);
}

Region merged(const std::vector<Shadow>& shadows) {
  std::vector<Extent> extents;
  for (const Shadow& shadow : shadows) extents.push_back(extentOf(shadow.region));
  const auto groups = detail::clusters(extents);
  std::vector<Region> regions(groups.size());
  detail::inParallel(groups.size(), [&](std::size_t g) {
    Extent whole;
    for (const std::size_t i : groups[g]) whole.add(extents[i]);
    const Grid grid(whole);
    std::vector<Loop> loops;
    for (const std::size_t i : groups[g])
      for (Loop& loop : loopsOf(shadows[i].region, grid)) loops.push_back(std::move(loop));
    regions[g] = detail::unite(loops, grid);
  });
  Region all;
  for (Region& region : regions) {
    all.area += region.area;
    for (Polygon& polygon : region.polygons) all.polygons.push_back(std::move(polygon));
  }
  return all;
}

}  // namespace

Result<Envelope> sweepShadows(const std::vector<CasterPart>& casters, double height,
                              const std::vector<SlopePath>& paths, Grouping grouping, const ProgressSink& progress) {
  Envelope envelope;
  double deviation = 0.0, highest = 0.0;
  for (const SlopePath& path : paths) deviation = std::max(deviation, path.deviation);
  for (const CasterPart& part : casters)
    if (!part.bounds.empty()) highest = std::max(highest, part.bounds.max.z - height);
  envelope.bound = deviation * highest;
  std::vector<Shadow> shadows(casters.size());
  const auto work = [&](std::size_t i) {
    const CasterPart part = detail::above(casters[i], height);
    if (part.triangles.empty()) return;
    shadows[i] = {part.name, sweptBy(part, pathsFor(part.bounds.max.z, envelope.bound, paths))};
  };
  if (!detail::inParallel(casters.size(), work, progress, "sweeping shadows"))
    return fail(ErrorCode::cancelled, "cancelled");
  std::erase_if(shadows, [](const Shadow& shadow) { return shadow.region.polygons.empty(); });
  if (grouping == Grouping::parts)
    envelope.shadows = std::move(shadows);
  else
    envelope.shadows.push_back({"", merged(shadows)});
  return envelope;
}

}  // namespace umbrage::outline
