#include "umbrage/outline/shadow.hpp"

#include <utility>

#include "umbrage/outline/detail/above.hpp"
#include "umbrage/outline/detail/clusters.hpp"
#include "umbrage/outline/detail/parallel.hpp"
#include "umbrage/outline/detail/winding.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::outline {
namespace {

using detail::Extent;
using detail::Grid;
using detail::Loop;

Vec2 projected(const Vec3& p, const Vec2& slope) { return Vec2(p) + p.z * slope; }

Extent extentOf(const CasterPart& part, const Vec2& slope) {
  Extent extent;
  for (const mesh::Triangle& t : part.triangles)
    for (const std::uint32_t corner : t) extent.add(projected(part.points[corner], slope));
  return extent;
}

// Appends the loops of a part's shadow.
void addLoops(const CasterPart& part, const Vec2& slope, const Grid& grid, std::vector<Loop>& loops) {
  std::vector<detail::GridPoint> points;
  points.reserve(part.points.size());
  for (const Vec3& p : part.points) points.push_back(grid.snap(projected(p, slope)));
  for (Loop& loop : detail::windingLoops(points, part.triangles)) loops.push_back(std::move(loop));
}

std::vector<Shadow> shadowsOfParts(const std::vector<CasterPart>& parts, const Vec2& slope) {
  std::vector<Shadow> shadows;
  for (const CasterPart& part : parts) {
    if (part.triangles.empty()) continue;
    const Grid grid(extentOf(part, slope));
    std::vector<Loop> loops;
    addLoops(part, slope, grid, loops);
    Shadow shadow{part.name, detail::unite(loops, grid)};
    if (!shadow.region.polygons.empty()) shadows.push_back(std::move(shadow));
  }
  return shadows;
}

std::vector<Shadow> mergedShadow(const std::vector<CasterPart>& parts, const Vec2& slope) {
  std::vector<Extent> extents;
  for (const CasterPart& part : parts) extents.push_back(extentOf(part, slope));
  Shadow merged;
  for (const auto& cluster : detail::clusters(extents)) {
    Extent whole;
    for (const std::size_t i : cluster) whole.add(extents[i]);
    const Grid grid(whole);
    std::vector<Loop> loops;
    for (const std::size_t i : cluster) addLoops(parts[i], slope, grid, loops);
    Region region = detail::unite(loops, grid);
    merged.region.area += region.area;
    for (Polygon& polygon : region.polygons) merged.region.polygons.push_back(std::move(polygon));
  }
  std::vector<Shadow> shadows;
  shadows.push_back(std::move(merged));
  return shadows;
}

}  // namespace

Vec2 shadowSlope(const sun::SunPosition& sun, Angle north) {
  const Vec3 towards = study::towardsSun(sun, scene::UpAxis::z, north);
  return -Vec2(towards) / towards.z;
}

Result<std::vector<std::vector<Shadow>>> shadowsOnPlane(const std::vector<CasterPart>& casters, double height,
                                                        const std::vector<Vec2>& slopes, Grouping grouping,
                                                        const ProgressSink& progress) {
  std::vector<CasterPart> raised(casters.size());
  detail::inParallel(casters.size(), [&](std::size_t i) { raised[i] = detail::above(casters[i], height); });
  std::vector<std::vector<Shadow>> all(slopes.size());
  const auto work = [&](std::size_t i) {
    all[i] = grouping == Grouping::parts ? shadowsOfParts(raised, slopes[i]) : mergedShadow(raised, slopes[i]);
  };
  if (!detail::inParallel(slopes.size(), work, progress, "shadows")) return fail(ErrorCode::cancelled, "cancelled");
  return all;
}

}  // namespace umbrage::outline
