#include "umbrage/rules/detail/outlines.hpp"

#include <algorithm>

#include "umbrage/outline/combine.hpp"
#include "umbrage/rules/net_new.hpp"

namespace umbrage::rules::detail {
namespace {

using std::chrono::year_month_day;

/// No new shadow at all, anywhere in an area.
bool allowsNone(const Requirement& r) {
  if (r.mostNew) return *r.mostNew == 0.0;
  const Measure& m = r.anyOf.front();
  return r.anyOf.size() == 1 && r.share >= 1.0 && !r.former && m.statistic == Statistic::newShadow &&
         m.comparison == Comparison::atMost && m.threshold.count() == 0;
}

/// Buildings and the areas beside them have one border in two files, each rounded by itself: shadow has to reach so far into an area.
constexpr double kBorder = 1e-3;  // metres

/// An area without a strip along its border.
outline::Region inner(const outline::Region& region, double width) {
  Vec2 low(1e300), high(-1e300);
  for (const outline::Polygon& polygon : region.polygons)
    for (const Vec2& p : polygon.outer) low = glm::min(low, p), high = glm::max(high, p);
  low -= 4.0 * width, high += 4.0 * width;
  outline::Region box;
  box.polygons.push_back({{low, {high.x, low.y}, high, {low.x, high.y}}, {}});
  box.area = (high.x - low.x) * (high.y - low.y);
  constexpr double kRoundness = 0.1;
  return outline::without(region, outline::grown(outline::without(box, region), width, kRoundness * width));
}

/// Areas that a requirement asks of, each as it is and without its border.
struct Asked {
  std::vector<Area> whole, inner;
  Area together;  ///< all of `inner`
};

Asked askedOf(std::vector<Area> areas, double width) {
  Asked asked;
  std::vector<outline::Region> regions;
  for (const Area& area : areas) {
    regions.push_back(inner(area.region, width));
    asked.inner.push_back({area.name, regions.back()});
  }
  asked.whole = std::move(areas);
  asked.together = asked.inner.size() == 1 ? asked.inner.front() : Area{"all", outline::together(regions)};
  return asked;
}

/// What outlines show on one area, day by day.
struct Seen {
  std::size_t days = 0;
  double counting = 0.0;  ///< hours, of all days
  NewOutlines most;
};

void add(Seen& seen, const AreaNews& news, year_month_day date) {
  Spans spans;
  for (const Visit& visit : news.all) spans.push_back(visit.span);
  spans = atLeast(std::move(spans), kShortestNew);
  if (spans.empty()) return;
  ++seen.most.days;
  seen.most.areaHours += news.areaHours;
  if (seen.most.days > 1 && news.areaHours <= seen.most.areaHoursThen) return;
  seen.most.date = date, seen.most.areaHoursThen = news.areaHours, seen.most.spans = std::move(spans);
}

bool lasts(const AreaNews& news) {
  return std::any_of(news.all.begin(), news.all.end(), [](const Visit& v) { return v.span.length() >= kShortestNew; });
}

/// The news of each area on a day; empty of those on which nothing reaches beyond the border. All are asked as one first, since on most days there is
/// nothing.
Result<std::vector<AreaNews>> newsOn(const Day& day, const scene::Scene& scene, const scene::Scene& baseline,
                                     const sun::Place& place, double height, const Asked& asked,
                                     const ProgressSink& progress) {
  NetNewOptions options;
  options.height = height, options.times = day.counting, options.sun = day.model, options.byBuilding = false;
  const auto on = [&](const std::vector<Area>& areas) {
    options.areas = areas;
    return netNew(scene, baseline, place, options, progress);
  };
  std::vector<AreaNews> all(asked.whole.size());
  const auto any = on({asked.together});
  if (!any) return tl::unexpected(any.error());
  if (!lasts(any->areas.front())) return all;
  const auto beyond = on(asked.inner);
  if (!beyond) return tl::unexpected(beyond.error());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!lasts(beyond->areas[i])) continue;
    auto news = on({asked.whole[i]});
    if (!news) return tl::unexpected(news.error());
    all[i] = std::move(news->areas.front());
  }
  return all;
}

void turn(const Requirement& requirement, const Seen& seen, double squareMetres, Finding& finding) {
  const bool enough = requirement.anyOf.front().days.best && seen.most.days < seen.days;
  if (seen.most.days == 0 || enough) return;
  finding.outlines = seen.most;
  finding.passes = false;
  if (!requirement.mostNew) {
    finding.margin = -hoursOf(total(seen.most.spans));
    return;
  }
  finding.newAreaHours = seen.most.areaHours;
  finding.newShare = seen.most.areaHours / (squareMetres * seen.counting);
  finding.margin = -*finding.newShare;
}

}  // namespace

Result<void> holdOutlines(const scene::Scene& scene, const scene::Scene& baseline, const Rule& rule,
                          const TargetSet& targets, const Conventions& conventions, const ProgressSink& progress,
                          std::vector<Finding>& findings) {
  const double square = scene.metresPerUnit * scene.metresPerUnit;
  for (std::size_t r = 0; r < rule.requirements.size() && !targets.areas.empty(); ++r) {
    const Requirement& requirement = rule.requirements[r];
    if (!allowsNone(requirement)) continue;
    std::vector<Finding*> passing;
    std::vector<Area> areas;
    for (Finding& f : findings) {
      if (f.requirement != r || !f.passes) continue;
      passing.push_back(&f), areas.push_back(targets.areas.at(f.groupIndex));
    }
    if (passing.empty()) continue;
    const Asked asked = askedOf(std::move(areas), kBorder / scene.metresPerUnit);
    std::vector<Seen> seen(passing.size());
    const Measure& m = requirement.anyOf.front();
    for (const auto& date : datesOf(m.days, conventions.calendar)) {
      const auto day = dayOf(m, date, conventions);
      for (Seen& one : seen) ++one.days, one.counting += day ? hoursOf(total(day->counting)) : 0.0;
      if (!day) continue;
      const auto news = newsOn(*day, scene, baseline, conventions.calendar.place, targets.height, asked, progress);
      // Nothing is added.
      if (!news && news.error().code == ErrorCode::usage) return {};
      if (!news) return tl::unexpected(news.error());
      for (std::size_t i = 0; i < passing.size(); ++i) add(seen[i], (*news)[i], date);
    }
    for (std::size_t i = 0; i < passing.size(); ++i)
      turn(requirement, seen[i], asked.whole[i].region.area * square, *passing[i]);
  }
  return {};
}

}  // namespace umbrage::rules::detail
