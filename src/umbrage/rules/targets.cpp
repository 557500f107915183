#include "umbrage/rules/targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "umbrage/base/check.hpp"
#include "umbrage/outline/combine.hpp"
#include "umbrage/study/georeference.hpp"

namespace umbrage::rules {
namespace {

// A hundredth of the nearest line: what rounding corners costs.
constexpr double kRoundness = 1e-4;

Box3 planBox(const outline::Region& region) {
  Box3 box;
  for (const outline::Polygon& polygon : region.polygons)
    for (const Vec2& p : polygon.outer) box.add(Vec3(p, 0.0));
  return box;
}

tl::unexpected<Error> tooMany(double count) {
  return fail(ErrorCode::usage,
              fmt::format("a grid this fine has {:.0f} million points, more than {} million; take larger steps",
                          count / 1e6, study::kMostReceivers / 1'000'000));
}

// Calls fn(middle) for the cells of a lattice over a box, as much of it beyond one side as beyond the other.
template <class Fn>
Result<void> forMiddles(const Box3& box, double step, Fn&& fn) {
  const Vec2 count = glm::max(glm::ceil(Vec2(box.max - box.min) / step - 1e-9), Vec2(1.0));
  if (count.x * count.y > double(study::kMostReceivers)) return tooMany(count.x * count.y);
  const Vec2 origin = 0.5 * Vec2(box.min + box.max) - 0.5 * step * count;
  for (double j = 0; j < count.y; ++j)
    for (double i = 0; i < count.x; ++i) fn(origin + step * Vec2(i + 0.5, j + 0.5));
  return {};
}

// Any point within a region too small for the grid.
Vec2 pointWithin(const outline::Region& region) {
  const outline::Polygon& polygon = region.polygons.front();
  Vec2 best = polygon.outer.front();
  double most = -1.0;
  const Vec2 first = polygon.outer[0];
  for (std::size_t i = 1; i + 1 < polygon.outer.size(); ++i) {
    const Vec2 middle = (first + polygon.outer[i] + polygon.outer[i + 1]) / 3.0;
    const Vec2 a = polygon.outer[i] - first, b = polygon.outer[i + 1] - first;
    const double size = std::abs(a.x * b.y - a.y * b.x);
    if (size > most && outline::covers(region, middle)) best = middle, most = size;
  }
  return best;
}

void addAlong(const outline::Ring& ring, double along, std::vector<Vec2>& points) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    const int parts = std::max(1, static_cast<int>(std::ceil(glm::length(b - a) / along)));
    for (int k = 0; k < parts; ++k) points.push_back(a + (b - a) * (double(k) / parts));
  }
}

std::set<double> linesOf(const Rule& rule) {
  std::set<double> lines;
  for (const Requirement& r : rule.requirements)
    if (r.band && r.band->from > 0.0) lines.insert(r.band->from);
  return lines;
}

}  // namespace

TargetSet pointTargets(const study::ReceiverSet& set) {
  TargetSet out;
  out.groups = {"points"};
  out.described = set.described;
  for (const study::Receiver& receiver : set.receivers) out.targets.push_back({receiver, 1.0, 0, 0.0});
  return out;
}

Result<TargetSet> areaTargets(const std::vector<Area>& areas, const scene::Scene& scene, double step, double height) {
  UMBRAGE_CHECK(step > 0.0, "a grid's step is a length");
  if (areas.empty()) return fail(ErrorCode::usage, "there are no areas to look at");
  TargetSet out;
  out.step = step;
  const double square = scene.metresPerUnit * scene.metresPerUnit;
  for (const Area& area : areas) {
    std::vector<Vec2> points;
    const auto done = forMiddles(planBox(area.region), step, [&](const Vec2& p) {
      if (outline::covers(area.region, p)) points.push_back(p);
    });
    if (!done) return tl::unexpected(done.error());
    if (points.empty()) points.push_back(pointWithin(area.region));
    const double weight = area.region.area * square / double(points.size());
    for (const Vec2& p : points)
      out.targets.push_back(
          {{study::scenePoint(p, height, scene.up), scene::upVector(scene.up)}, weight, out.groups.size(), 0.0});
    out.groups.push_back(area.name);
  }
  out.described = fmt::format("grid of {:g} within {} {}, at height {:g}, each cell by its middle", step, areas.size(),
                              areas.size() == 1 ? "area" : "areas", height);
  return out;
}

Result<TargetSet> siteTargets(const Area& site, const Rule& rule, const scene::Scene& scene, const SiteGrid& grid) {
  UMBRAGE_CHECK(grid.along > 0.0 && grid.step > 0.0, "points around a site need spacings");
  const std::set<double> lines = linesOf(rule);
  if (site.region.polygons.empty()) return fail(ErrorCode::usage, "the site has no area");
  if (lines.empty()) return fail(ErrorCode::usage, rule.name + " has no lines around a site (metres_from_site)");
  const double unit = scene.metresPerUnit;
  TargetSet out;
  out.groups = {site.name};
  out.step = grid.step / unit;
  const auto add = [&](const Vec2& p, double weight, double distance) {
    out.targets.push_back(
        {{study::scenePoint(p, grid.height, scene.up), scene::upVector(scene.up)}, weight, 0, distance});
  };
  for (const double line : lines) {
    std::vector<Vec2> points;
    const outline::Region ring = outline::grown(site.region, line / unit, kRoundness * line / unit);
    for (const outline::Polygon& polygon : ring.polygons) {
      addAlong(polygon.outer, grid.along / unit, points);
      for (const outline::Ring& hole : polygon.holes) addAlong(hole, grid.along / unit, points);
    }
    for (const Vec2& p : points) add(p, 0.0, line);
  }
  Box3 box = planBox(site.region);
  box.min -= Vec3(grid.reach / unit, grid.reach / unit, 0.0),
      box.max += Vec3(grid.reach / unit, grid.reach / unit, 0.0);
  const auto done = forMiddles(box, out.step, [&](const Vec2& p) {
    const double distance = outline::distanceTo(site.region, p) * unit;
    if (distance > *lines.begin() && distance <= grid.reach) add(p, grid.step * grid.step, distance);
  });
  if (!done) return tl::unexpected(done.error());
  out.described = fmt::format(
      "points every {:g} m on the lines {:g} m from the site, and a grid of {:g} m from there to {:.0f} m off it, at "
      "height {:g}",
      grid.along, fmt::join(lines, " and "), grid.step, grid.reach, grid.height);
  return out;
}

Result<scene::Scene> castersOnSite(scene::Scene scene, const Area& site) {
  bool any = false;
  for (scene::Instance& instance : scene.instances) {
    if (!instance.casts) continue;
    Box3 box;
    for (const Vec3& p : scene.meshes[instance.mesh]->positions) box.add(transformPoint(instance.toWorld, p));
    instance.casts = !box.empty() && outline::covers(site.region, study::mapPoint(0.5 * (box.min + box.max), scene.up));
    any = any || instance.casts;
  }
  if (any) return scene;
  return fail(ErrorCode::usage, fmt::format("no part that casts has its middle on the site '{}'", site.name));
}

}  // namespace umbrage::rules
