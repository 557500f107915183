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

/// Asks for several areas on a day: first for all of them as one, since on most days there is nothing.
Result<std::vector<AreaNews>> newsOn(const Day& day, const scene::Scene& scene, const scene::Scene& baseline,
                                     const sun::Place& place, double height, const std::vector<Area>& areas,
                                     const Area& together, const ProgressSink& progress) {
  NetNewOptions options;
  options.height = height, options.times = day.counting, options.sun = day.model;
  options.areas = {together}, options.byBuilding = false;
  auto news = netNew(scene, baseline, place, options, progress);
  if (news && areas.size() > 1 && !news->areas.front().all.empty()) {
    options.areas = areas;
    news = netNew(scene, baseline, place, options, progress);
  }
  if (!news) return tl::unexpected(news.error());
  return news->areas.size() == areas.size() ? std::move(news->areas) : std::vector<AreaNews>(areas.size());
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
    std::vector<Finding*> asked;
    std::vector<Area> areas;
    std::vector<outline::Region> regions;
    for (Finding& f : findings) {
      if (f.requirement != r || !f.passes) continue;
      asked.push_back(&f), areas.push_back(targets.areas.at(f.groupIndex)), regions.push_back(areas.back().region);
    }
    if (asked.empty()) continue;
    const Area together = areas.size() == 1 ? areas.front() : Area{"all", outline::together(regions)};
    std::vector<Seen> seen(asked.size());
    const Measure& m = requirement.anyOf.front();
    for (const auto& date : datesOf(m.days, conventions.calendar)) {
      const auto day = dayOf(m, date, conventions);
      for (Seen& one : seen) ++one.days, one.counting += day ? hoursOf(total(day->counting)) : 0.0;
      if (!day) continue;
      const auto news =
          newsOn(*day, scene, baseline, conventions.calendar.place, targets.height, areas, together, progress);
      // Nothing is added.
      if (!news && news.error().code == ErrorCode::usage) return {};
      if (!news) return tl::unexpected(news.error());
      for (std::size_t i = 0; i < asked.size(); ++i) add(seen[i], (*news)[i], date);
    }
    for (std::size_t i = 0; i < asked.size(); ++i) turn(requirement, seen[i], areas[i].region.area * square, *asked[i]);
  }
  return {};
}

}  // namespace umbrage::rules::detail
