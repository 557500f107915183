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

struct PlanBox {
  Vec2 min{1e300}, max{-1e300};
};
PlanBox planBox(const outline::Region& region) {
  PlanBox box;
  for (const outline::Polygon& polygon : region.polygons)
    for (const Vec2& p : polygon.outer) box.min = glm::min(box.min, p), box.max = glm::max(box.max, p);
  return box;
}

tl::unexpected<Error> tooMany(double count, const std::string& remedy) {
  return fail(ErrorCode::usage, fmt::format("{:.0f} million points, more than {}, are too many; {}", count / 1e6,
                                            kMostTargets / 1'000'000, remedy));
}
constexpr const char* kLargerSteps = "take larger steps (--grid)";

// The middles of a lattice's cells over a box, as much of it beyond one side as beyond the other.
struct Middles {
  Vec2 count, origin;
  double step = 1.0;
  [[nodiscard]] Vec2 at(double i, double j) const { return origin + step * Vec2(i + 0.5, j + 0.5); }
};
Middles middlesOver(const PlanBox& box, double step) {
  constexpr double kWhole = 1e-6;  // what a box may be longer than whole cells, as corners are rounded in other units
  const Vec2 count = glm::max(glm::ceil((box.max - box.min) / step * (1.0 - kWhole)), Vec2(1.0));
  return {count, 0.5 * (box.min + box.max) - 0.5 * step * count, step};
}

// Where parallels to the x axis, from south to north, cross the border of a region.
class Scan {
 public:
  explicit Scan(const outline::Region& region) {
    const auto add = [&](const outline::Ring& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (ring[i].y != ring[(i + 1) % ring.size()].y) edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
    };
    for (const outline::Polygon& polygon : region.polygons) {
      add(polygon.outer);
      for (const outline::Ring& hole : polygon.holes) add(hole);
    }
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.low() < b.low(); });
  }
  // Ascending; between the first and the second, the third and the fourth, and so on lies the region, exactly as outline::covers says.
  // REQUIRES: no y is less than that of the call before.
  const std::vector<double>& crossings(double y) {
    while (next_ < edges_.size() && edges_[next_].low() <= y) active_.push_back(next_++);
    std::erase_if(active_, [&](std::size_t i) { return edges_[i].high() <= y; });
    crossings_.clear();
    for (const std::size_t i : active_) crossings_.push_back(edges_[i].at(y));
    std::sort(crossings_.begin(), crossings_.end());
    return crossings_;
  }

 private:
  struct Edge {
    Vec2 a, b;
    [[nodiscard]] double low() const { return std::min(a.y, b.y); }
    [[nodiscard]] double high() const { return std::max(a.y, b.y); }
    [[nodiscard]] double at(double y) const { return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x); }
  };
  std::vector<Edge> edges_;
  std::size_t next_ = 0;
  std::vector<std::size_t> active_;
  std::vector<double> crossings_;
};

// The middles of cells within a region.
std::vector<Vec2> middlesWithin(const outline::Region& region, double step) {
  std::vector<Vec2> points;
  const Middles middles = middlesOver(planBox(region), step);
  Scan scan(region);
  for (double j = 0; j < middles.count.y; ++j) {
    const auto& crossings = scan.crossings(middles.at(0, j).y);
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      double i = std::max(0.0, std::floor((crossings[k] - middles.origin.x) / step - 0.5) - 1.0);
      while (middles.at(i, j).x < crossings[k]) ++i;
      for (; i < middles.count.x && middles.at(i, j).x < crossings[k + 1]; ++i) points.push_back(middles.at(i, j));
    }
  }
  return points;
}

// Any point within a region too small for the grid: on the parallel in the widest gap between its corners' heights.
Vec2 pointWithin(const outline::Region& region) {
  std::vector<double> heights;
  for (const outline::Polygon& polygon : region.polygons)
    for (const Vec2& p : polygon.outer) heights.push_back(p.y);
  std::sort(heights.begin(), heights.end());
  double y = heights.front(), gap = 0.0;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i)
    if (heights[i + 1] - heights[i] > gap) gap = heights[i + 1] - heights[i], y = 0.5 * (heights[i + 1] + heights[i]);
  Vec2 best = region.polygons.front().outer.front();
  double widest = 0.0;
  Scan scan(region);
  const auto& crossings = scan.crossings(y);
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
    if (crossings[k + 1] - crossings[k] > widest)
      widest = crossings[k + 1] - crossings[k], best = {0.5 * (crossings[k] + crossings[k + 1]), y};
  return best;
}

template <class Fn>
void forRings(const outline::Region& region, Fn&& fn) {
  for (const outline::Polygon& polygon : region.polygons) {
    fn(polygon.outer);
    for (const outline::Ring& hole : polygon.holes) fn(hole);
  }
}

double partsOf(const Vec2& a, const Vec2& b, double along) {
  return std::max(1.0, std::ceil(glm::length(b - a) / along));
}

double pointsAlong(const outline::Ring& ring, double along) {
  double count = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) count += partsOf(ring[i], ring[(i + 1) % ring.size()], along);
  return count;
}

void addAlong(const outline::Ring& ring, double along, std::vector<Vec2>& points) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    const double parts = partsOf(a, b, along);
    for (double k = 0; k < parts; ++k) points.push_back(a + (b - a) * (k / parts));
  }
}

// Where the bands of a rule begin: requirements without one look at all that lies off the site.
std::set<double> beginningsOf(const Rule& rule) {
  std::set<double> beginnings;
  for (const Requirement& r : rule.requirements) beginnings.insert(r.band ? r.band->from : 0.0);
  return beginnings;
}

Box3 boundsOf(const scene::Scene& scene, const scene::Instance& instance) {
  Box3 box;
  for (const Vec3& p : scene.meshes[instance.mesh]->positions) box.add(transformPoint(instance.toWorld, p));
  return box;
}

bool standsOn(const Area& site, const Box3& box, scene::UpAxis up) {
  return !box.empty() && outline::covers(site.region, study::mapPoint(0.5 * (box.min + box.max), up));
}

struct Line {
  double distance = 0.0;  // metres from the site
  outline::Region within;
};

// The lines around a site, at the beginnings of bands off it.
std::vector<Line> linesAround(const outline::Region& site, const std::set<double>& beginnings, double unit) {
  std::vector<Line> lines;
  for (const double distance : beginnings)
    if (distance > 0.0)
      lines.push_back({distance, outline::grown(site, distance / unit, kRoundness * distance / unit)});
  return lines;
}

// Before there is any.
Result<void> checkSiteCount(const std::vector<Line>& lines, const PlanBox& box, const SiteGrid& grid, double unit) {
  double count = 0.0;
  for (const Line& line : lines)
    forRings(line.within, [&](const outline::Ring& ring) { count += pointsAlong(ring, grid.along / unit); });
  if (count > double(kMostTargets)) return tooMany(count, kLargerSteps);
  const Vec2 cells = glm::ceil((box.max - box.min) * unit / grid.step);
  count += cells.x * cells.y;
  if (count <= double(kMostTargets)) return {};
  return tooMany(count,
                 fmt::format("shadow can matter {:.0f} m off the site: take larger steps (--grid), leave out low sun "
                             "(--min-altitude), or end the rule's last band (metres_from_site.to)",
                             grid.reach));
}

std::string siteText(const std::vector<Line>& lines, double nearest, const SiteGrid& grid) {
  std::string text;
  for (const Line& line : lines) text += fmt::format("{}{:g}", text.empty() ? "" : " and ", line.distance);
  if (!text.empty()) text = fmt::format("points every {:g} m on the lines {} m from the site, and ", grid.along, text);
  return text + fmt::format("a grid of {:g} m from {} to {:.0f} m off it, at height {:g}", grid.step,
                            lines.empty()   ? "the site's border"
                            : nearest > 0.0 ? "there"
                                            : "its border",
                            grid.reach, grid.height);
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
  double count = 0.0;
  for (const Area& area : areas) {
    const PlanBox box = planBox(area.region);
    count += std::max(area.region.area / (step * step), (box.max.y - box.min.y) / step);
  }
  if (count > double(kMostTargets)) return tooMany(count, kLargerSteps);
  TargetSet out;
  out.step = step, out.areas = areas, out.height = height;
  const double square = scene.metresPerUnit * scene.metresPerUnit;
  for (const Area& area : areas) {
    std::vector<Vec2> points = middlesWithin(area.region, step);
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
  if (site.region.polygons.empty()) return fail(ErrorCode::usage, "the site has no area");
  if (rule.receivers != ReceiverKind::site) return fail(ErrorCode::usage, rule.name + " looks at no site");
  const double unit = scene.metresPerUnit;
  const std::set<double> beginnings = beginningsOf(rule);
  const double nearest = *beginnings.begin();
  const std::vector<Line> lines = linesAround(site.region, beginnings, unit);
  PlanBox box = planBox(site.region);
  // Whole steps, so that a shorter reach has some of the points of a longer one, and no others.
  const double reach = std::ceil(grid.reach / grid.step) * grid.step / unit;
  box.min -= reach, box.max += reach;
  if (const auto fits = checkSiteCount(lines, box, grid, unit); !fits) return tl::unexpected(fits.error());
  TargetSet out;
  out.groups = {site.name};
  out.step = grid.step / unit;
  const auto add = [&](const Vec2& p, double weight, double distance) {
    out.targets.push_back(
        {{study::scenePoint(p, grid.height, scene.up), scene::upVector(scene.up)}, weight, 0, distance});
  };
  for (const Line& line : lines) {
    std::vector<Vec2> points;
    forRings(line.within, [&](const outline::Ring& ring) { addAlong(ring, grid.along / unit, points); });
    for (const Vec2& p : points) add(p, 0.0, line.distance);
  }
  const Middles middles = middlesOver(box, out.step);
  for (double j = 0; j < middles.count.y; ++j)
    for (double i = 0; i < middles.count.x; ++i) {
      const Vec2 p = middles.at(i, j);
      const double distance = outline::distanceTo(site.region, p) * unit;
      if (distance > nearest && distance <= grid.reach) add(p, grid.step * grid.step, distance);
    }
  out.described = siteText(lines, nearest, grid);
  return out;
}

double overhang(const scene::Scene& scene, const Area& site) {
  double most = 0.0;
  for (const scene::Instance& instance : scene.instances) {
    if (!instance.casts) continue;
    const Box3 box = boundsOf(scene, instance);
    if (!standsOn(site, box, scene.up)) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                   (corner & 4) != 0 ? box.max.z : box.min.z);
      most = std::max(most, outline::distanceTo(site.region, study::mapPoint(p, scene.up)));
    }
  }
  return most * scene.metresPerUnit;
}

Result<scene::Scene> castersOnSite(scene::Scene scene, const Area& site) {
  bool any = false;
  for (scene::Instance& instance : scene.instances) {
    if (!instance.casts) continue;
    instance.casts = standsOn(site, boundsOf(scene, instance), scene.up);
    any = any || instance.casts;
  }
  if (any) return scene;
  return fail(ErrorCode::usage, fmt::format("no part that casts has its middle on the site '{}'", site.name));
}

}  // namespace umbrage::rules
