#include "umbrage/rules/detail/judge.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <tuple>

#include "umbrage/base/check.hpp"

namespace umbrage::rules {

class SunDays {
 public:
  /// A window, the least height of the sun in it (0 where none is asked for), a place, and the conventions.
  using Key = std::tuple<sun::Instant, sun::Instant, double, double, double, sun::Refraction, study::SunPoint, bool>;
  std::map<Key, std::shared_ptr<const detail::Day>> known;
};

std::shared_ptr<SunDays> makeSunDays() { return std::make_shared<SunDays>(); }

}  // namespace umbrage::rules

namespace umbrage::rules::detail {
namespace {

using std::chrono::milliseconds;
using std::chrono::year_month_day;
using study::TimeSpan;

constexpr double kRounding = 1e-12;  // of shares

bool wantsMore(const Measure& m) { return m.comparison == Comparison::atLeast || m.comparison == Comparison::moreThan; }

// What a measure counts at one receiver on one day.
Spans countedSpans(const Measure& m, std::span<const TimeSpan> counting, std::span<const TimeSpan> lit,
                   std::span<const TimeSpan> litBefore) {
  switch (m.statistic) {
    case Statistic::sun: return atLeast(both(counting, lit), m.leastRun);
    case Statistic::longestSun: return both(counting, lit);
    case Statistic::shadow: return without(counting, lit);
    case Statistic::newShadow: return atLeast(without(both(counting, litBefore), lit), kShortestNew);
  }
  return {};
}

milliseconds valueOf(const Measure& m, const Spans& spans) {
  return m.statistic == Statistic::longestSun ? longest(spans) : total(spans);
}

bool passes(const Measure& m, milliseconds value) {
  switch (m.comparison) {
    case Comparison::atLeast: return value >= m.threshold;
    case Comparison::moreThan: return value > m.threshold;
    case Comparison::atMost: return value <= m.threshold;
    case Comparison::lessThan: return value < m.threshold;
  }
  return false;
}

ReceiverResult resultOf(const Measure& m, std::size_t target, year_month_day date, Spans spans) {
  ReceiverResult r;
  r.target = target, r.date = date;
  const milliseconds value = valueOf(m, spans);
  r.value = hoursOf(value), r.threshold = hoursOf(m.threshold);
  r.margin = wantsMore(m) ? r.value - r.threshold : r.threshold - r.value;
  r.passes = passes(m, value);
  r.spans = std::move(spans);
  return r;
}

// A pass is better than a fail on the same margin.
bool worse(const ReceiverResult& a, const ReceiverResult& b) {
  return a.margin != b.margin ? a.margin < b.margin : !a.passes && b.passes;
}

// The receivers of one finding, and how they are asked about.
class Panel {
 public:
  /// `group`: indices of its targets.
  Panel(const Requirement& requirement, const TargetSet& all, const std::vector<std::size_t>& group,
        const Conventions& conventions)
      : requirement_(requirement), conventions_(conventions), all_(all) {
    constexpr double kSlack = 1e-3;  // metres: a line's points lie on both of its sides
    for (const std::size_t i : group) {
      const Target& target = all.targets[i];
      const auto& band = requirement.band;
      if (band && (target.fromSite < band->from - kSlack || (band->to && target.fromSite > *band->to + kSlack)))
        continue;
      chosen_.push_back(i);
      receivers_.push_back(target.receiver);
    }
  }
  [[nodiscard]] bool empty() const { return chosen_.empty(); }

  // Of each receiver its worst day by its best measure.
  [[nodiscard]] Result<std::vector<ReceiverResult>> results(const SunOf& now, const SunOf* before,
                                                            const ProgressSink& progress) const {
    std::vector<ReceiverResult> best;
    for (std::size_t k = 0; k < requirement_.anyOf.size(); ++k) {
      auto results = ofMeasure(requirement_.anyOf[k], now, before, progress);
      if (!results) return results;
      for (ReceiverResult& r : *results) r.measure = k;
      if (k == 0)
        best = std::move(*results);
      else
        for (std::size_t i = 0; i < best.size(); ++i)
          if (worse(best[i], (*results)[i])) best[i] = std::move((*results)[i]);
    }
    return best;
  }

  // What one day says.
  [[nodiscard]] Result<std::vector<ReceiverResult>> onDate(const Measure& m, year_month_day date, const SunOf& now,
                                                           const SunOf* before, const ProgressSink& progress) const {
    std::vector<ReceiverResult> results;
    const auto day = dayOf(m, date, conventions_);
    if (!day) {
      for (const std::size_t target : chosen_) results.push_back(resultOf(m, target, date, {}));
      return results;
    }
    const auto lit = now(receivers_, day->course, progress);
    if (!lit) return tl::unexpected(lit.error());
    std::optional<study::SunHours> former;
    if (m.statistic == Statistic::newShadow) {
      UMBRAGE_CHECK(before != nullptr, "new shadow needs a baseline");
      auto found = (*before)(receivers_, day->course, progress);
      if (!found) return tl::unexpected(found.error());
      former = std::move(*found);
    }
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      results.push_back(
          resultOf(m, chosen_[i], date,
                   countedSpans(m, day->counting, lit->lit(i), former ? former->lit(i) : std::span<const TimeSpan>())));
    return results;
  }

  // The share of the receivers that pass.
  [[nodiscard]] double shareOf(const std::vector<ReceiverResult>& results) const {
    double passing = 0.0, whole = 0.0;
    for (const ReceiverResult& r : results) {
      whole += weight(r);
      if (r.passes) passing += weight(r);
    }
    if (whole > 0.0) return passing / whole;
    // Lines alone, which have no area.
    const auto count = std::count_if(results.begin(), results.end(), [](const auto& r) { return r.passes; });
    return double(count) / double(results.size());
  }

  // The receiver at which the part `wanted`, best first, is reached.
  [[nodiscard]] std::size_t deciding(const std::vector<ReceiverResult>& results, double wanted) const {
    std::vector<std::size_t> order(results.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (wanted >= 1.0)
      return *std::min_element(order.begin(), order.end(),
                               [&](auto a, auto b) { return worse(results[a], results[b]); });
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return worse(results[b], results[a]); });
    double whole = 0.0, sum = 0.0;
    for (const ReceiverResult& r : results) whole += weight(r);
    for (const std::size_t i : order) {
      sum += weight(results[i]);
      if (sum >= (wanted - kRounding) * whole) return i;
    }
    return order.back();
  }

  // Calls fn(date, progress) for each day of a measure, ascending.
  template <class Fn>
  [[nodiscard]] Result<void> forDates(const Measure& m, const ProgressSink& progress, Fn&& fn) const {
    const auto dates = datesOf(m.days, conventions_.calendar);
    for (std::size_t i = 0; i < dates.size(); ++i) {
      const ProgressSink part = [&](double fraction, std::string_view what) {
        return reportProgress(progress, (double(i) + fraction) / double(dates.size()), what);
      };
      if (const auto done = fn(dates[i], part); !done) return done;
    }
    return {};
  }

  // Hours of new shadow times area, and of all that count.
  [[nodiscard]] Result<std::pair<double, double>> newAreaHours(const Lights& lights,
                                                               const ProgressSink& progress) const {
    std::pair<double, double> sums{0.0, 0.0};
    const Measure& m = requirement_.anyOf.front();
    const auto done = forDates(m, progress, [&](year_month_day date, const ProgressSink& part) -> Result<void> {
      const auto day = dayOf(m, date, conventions_);
      if (!day) return {};
      const auto now = lights.now(receivers_, day->course, part);
      if (!now) return tl::unexpected(now.error());
      const auto before = lights.before(receivers_, day->course, part);
      if (!before) return tl::unexpected(before.error());
      const double whole = hoursOf(total(day->counting));
      for (std::size_t i = 0; i < receivers_.size(); ++i) {
        const double area = all_.targets[chosen_[i]].weight;
        sums.first += area * hoursOf(total(countedSpans(m, day->counting, now->lit(i), before->lit(i))));
        sums.second += area * whole;
      }
      return {};
    });
    if (!done) return tl::unexpected(done.error());
    return sums;
  }

 private:
  [[nodiscard]] double weight(const ReceiverResult& r) const { return all_.targets[r.target].weight; }

  [[nodiscard]] Result<std::vector<ReceiverResult>> ofMeasure(const Measure& m, const SunOf& now, const SunOf* before,
                                                              const ProgressSink& progress) const {
    std::vector<ReceiverResult> kept;
    const auto done = forDates(m, progress, [&](year_month_day date, const ProgressSink& part) -> Result<void> {
      auto today = onDate(m, date, now, before, part);
      if (!today) return tl::unexpected(today.error());
      if (kept.empty()) {
        kept = std::move(*today);
        return {};
      }
      for (std::size_t i = 0; i < today->size(); ++i)
        if (worse((*today)[i], kept[i])) kept[i] = std::move((*today)[i]);
      return {};
    });
    if (!done) return tl::unexpected(done.error());
    return kept;
  }

  const Requirement& requirement_;
  const Conventions& conventions_;
  const TargetSet& all_;
  std::vector<std::size_t> chosen_;
  std::vector<study::Receiver> receivers_;
};

Result<void> weighNew(const Requirement& requirement, const Panel& panel, const Lights& lights,
                      const ProgressSink& progress, Finding& finding) {
  const auto sums = panel.newAreaHours(lights, progress);
  if (!sums) return tl::unexpected(sums.error());
  finding.newAreaHours = sums->first;
  finding.newShare = sums->second > 0.0 ? sums->first / sums->second : 0.0;
  finding.margin = *requirement.mostNew - *finding.newShare;
  finding.passes = finding.margin >= 0.0;
  return {};
}

// The finding that receivers make, given what they had in the baseline where that counts.
void weigh(const Requirement& requirement, const Panel& panel, std::vector<ReceiverResult> results,
           const std::optional<std::vector<ReceiverResult>>& former, Finding& finding) {
  finding.wanted = requirement.share;
  if (former) {
    finding.formerShare = panel.shareOf(*former);
    finding.wanted = std::min(finding.wanted, *requirement.former * *finding.formerShare);
  }
  finding.share = panel.shareOf(results);
  finding.passes = finding.wanted >= 1.0
                       ? std::all_of(results.begin(), results.end(), [](const auto& r) { return r.passes; })
                       : finding.share >= finding.wanted - kRounding;
  finding.deciding = panel.deciding(results, finding.wanted);
  // Where nothing has to pass, no receiver can turn it.
  finding.margin =
      finding.wanted > kRounding ? results[*finding.deciding].margin : std::numeric_limits<double>::infinity();
  finding.receivers = std::move(results);
}

// `results` asks for what receivers have by one light: now or, as if it were now, in the baseline.
template <class Results>
Result<void> weighNowAndBefore(const Requirement& requirement, const Panel& panel, const Lights& lights,
                               Results&& results, Finding& finding) {
  const SunOf* before = lights.before ? &lights.before : nullptr;
  auto now = results(lights.now, before);
  if (!now) return tl::unexpected(now.error());
  std::optional<std::vector<ReceiverResult>> former;
  if (requirement.former && before != nullptr) {
    auto found = results(*before, nullptr);
    if (!found) return tl::unexpected(found.error());
    former = std::move(*found);
  }
  weigh(requirement, panel, std::move(*now), former, finding);
  return {};
}

Result<void> weighShares(const Requirement& requirement, const Panel& panel, const Lights& lights,
                         const ProgressSink& progress, Finding& finding) {
  const auto results = [&](const SunOf& now, const SunOf* before) { return panel.results(now, before, progress); };
  return weighNowAndBefore(requirement, panel, lights, results, finding);
}

// By all of the rule, what was there before included, each day against its own past.
Result<void> weighBestDay(const Requirement& requirement, const Panel& panel, const Lights& lights,
                          const ProgressSink& progress, Finding& finding) {
  const Measure& m = requirement.anyOf.front();
  const Finding blank = finding;
  const auto better = [](const Finding& a, const Finding& b) {
    return a.passes != b.passes ? a.passes : a.margin > b.margin;
  };
  return panel.forDates(m, progress, [&](year_month_day date, const ProgressSink& part) -> Result<void> {
    Finding today = blank;
    const auto results = [&](const SunOf& now, const SunOf* before) {
      return panel.onDate(m, date, now, before, part);
    };
    const auto done = weighNowAndBefore(requirement, panel, lights, results, today);
    if (done && (!finding.deciding || better(today, finding))) finding = std::move(today);
    return done;
  });
}

Result<void> weighAll(const Requirement& requirement, const Panel& panel, const Lights& lights,
                      const ProgressSink& progress, Finding& finding) {
  if (requirement.mostNew) return weighNew(requirement, panel, lights, progress, finding);
  if (requirement.anyOf.front().days.best) return weighBestDay(requirement, panel, lights, progress, finding);
  return weighShares(requirement, panel, lights, progress, finding);
}

std::vector<std::vector<std::size_t>> targetsByGroup(const TargetSet& targets) {
  std::vector<std::vector<std::size_t>> groups(targets.groups.size());
  for (std::size_t i = 0; i < targets.targets.size(); ++i) groups[targets.targets[i].group].push_back(i);
  return groups;
}

}  // namespace

SunOf sunOf(std::shared_ptr<const study::ExactHours> hours) {
  return [hours = std::move(hours)](std::span<const study::Receiver> receivers, const study::SunCourse& course,
                                    const ProgressSink& progress) { return hours->at(receivers, course, progress); };
}

bool holds(const Measure& m, std::span<const TimeSpan> counting, std::span<const TimeSpan> lit,
           std::span<const TimeSpan> litBefore) {
  return passes(m, valueOf(m, countedSpans(m, counting, lit, litBefore)));
}

bool allPass(const std::vector<Finding>& findings) {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.passes; });
}

Conventions conventionsOf(const Rule& rule, const VerifyRequest& request) {
  return {{request.place, request.zone, request.date},
          rule.sun,
          rule.fixedDeclination,
          false,
          request.days ? request.days : makeSunDays()};
}

std::shared_ptr<const Day> dayOf(const Measure& measure, year_month_day date, const Conventions& conventions) {
  const auto window = windowOn(measure.window, date, conventions.calendar, conventions.clockSwitched);
  if (!window) return nullptr;
  const TimeSpan span = *window;
  const SunDays::Key key{span.from,
                         span.to,
                         measure.leastAltitude ? measure.leastAltitude->radians() : 0.0,
                         conventions.calendar.place.latitude.radians(),
                         conventions.calendar.place.longitude.radians(),
                         conventions.sun.refraction,
                         conventions.sun.point,
                         conventions.fixedDeclination};
  if (const auto known = conventions.days->known.find(key); known != conventions.days->known.end())
    return known->second;
  study::SunModel model = conventions.sun;
  if (conventions.fixedDeclination)
    model.declination =
        study::declinationAt(sun::instantOfHourAngle(conventions.calendar.place, span.from + span.length() / 2, {}));
  Day day{date, study::SunCourse::make(conventions.calendar.place, span, model), {}, model};
  day.counting = countingTimes(day.course, measure.leastAltitude);
  auto made = day.counting.empty() ? nullptr : std::make_shared<const Day>(std::move(day));
  conventions.days->known.emplace(key, made);
  return made;
}

Result<std::vector<Finding>> judge(const Rule& rule, const Lights& lights, const TargetSet& targets,
                                   const Conventions& conventions, const ProgressSink& progress) {
  std::vector<Finding> findings;
  const double parts = double(rule.requirements.size() * targets.groups.size());
  double done = 0.0;
  const ProgressSink part = [&](double fraction, std::string_view what) {
    return reportProgress(progress, (done + fraction) / parts, what);
  };
  const auto groups = targetsByGroup(targets);
  for (std::size_t r = 0; r < rule.requirements.size(); ++r)
    for (std::size_t g = 0; g < targets.groups.size(); ++g, done += 1.0) {
      const Requirement& requirement = rule.requirements[r];
      const Panel panel(requirement, targets, groups[g], conventions);
      if (panel.empty()) continue;
      Finding finding;
      finding.requirement = r, finding.groupIndex = g, finding.group = targets.groups[g];
      if (const auto weighed = weighAll(requirement, panel, lights, part, finding); !weighed)
        return tl::unexpected(weighed.error());
      findings.push_back(std::move(finding));
    }
  return findings;
}

}  // namespace umbrage::rules::detail
