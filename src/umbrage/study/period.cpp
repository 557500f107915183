#include "umbrage/study/period.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace umbrage::study {
namespace {

using std::chrono::milliseconds;

Result<void> check(const Period& p) {
  if (p.step.count() <= 0) return fail(ErrorCode::usage, "the step must be longer than nothing");
  if (p.from >= p.to)
    return fail(ErrorCode::usage, fmt::format("the period from {} to {} is empty or runs backwards",
                                              sun::timeText(p.from), sun::timeText(p.to)));
  if (std::size_t((p.to - p.from) / p.step) >= kMostSteps)
    return fail(ErrorCode::usage,
                fmt::format("a step of {} s makes more than {} steps", double(p.step.count()) / 1000.0, kMostSteps));
  return {};
}

// The moments between two ends, both given by the clock.
Result<std::vector<sun::Instant>> instants(const Period& p, sun::Instant from, sun::Instant to) {
  std::vector<sun::Instant> all;
  if (p.zone.kind != sun::Zone::Kind::solar) {
    for (sun::Instant t = from; t <= to; t += p.step) all.push_back(t);
    return all;
  }
  for (milliseconds clock = p.from; clock <= p.to; clock += p.step) {
    const auto moment = sun::instantOf(p.zone, p.place, {p.date, clock});
    if (!moment) return tl::unexpected(moment.error());
    all.push_back(moment->instant);
  }
  return all;
}

// Half-way to each neighbour, and all the way to the ends of the period.
void share(std::vector<PeriodStep>& steps, sun::Instant from, sun::Instant to) {
  sun::Instant begin = from;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool last = i + 1 == steps.size();
    const sun::Instant end = last ? to : steps[i].instant + (steps[i + 1].instant - steps[i].instant) / 2;
    steps[i].share = end - begin;
    begin = end;
  }
}

std::string offsetOf(const sun::ClockReading& reading, const sun::Zone& zone) {
  if (zone.kind == sun::Zone::Kind::solar)
    return "hour angle 0 at 12:00; UTC" + sun::offsetText(reading.offset) + " at first";
  return sun::offsetText(reading);
}

}  // namespace

Result<PeriodSteps> stepsOf(const Period& period) {
  if (auto fine = check(period); !fine) return tl::unexpected(fine.error());
  const auto from = sun::instantOf(period.zone, period.place, {period.date, period.from});
  if (!from) return tl::unexpected(from.error());
  const auto to = sun::instantOf(period.zone, period.place, {period.date, period.to});
  if (!to) return tl::unexpected(to.error());
  if (from->instant >= to->instant)
    return fail(ErrorCode::usage, "clocks are put back within the period, and nothing is left of it");
  const auto all = instants(period, from->instant, to->instant);
  if (!all) return tl::unexpected(all.error());

  PeriodSteps result;
  for (const auto* moment : {&*from, &*to})
    if (moment->warning) result.warnings.push_back(*moment->warning);
  const auto first = sun::clockAt(period.zone, period.place, all->front());
  const auto last = sun::clockAt(period.zone, period.place, all->back());
  const bool named = period.zone.kind == sun::Zone::Kind::named;
  const bool changes = named && first.offset != last.offset;
  result.offset = offsetOf(first, period.zone) + (changes ? ", then " + offsetOf(last, period.zone) : "");
  for (const sun::Instant t : *all) {
    const auto reading = sun::clockAt(period.zone, period.place, t);
    PeriodStep step;
    step.instant = t;
    step.label = sun::timeText(reading.clock.time) + (changes ? " " + reading.abbreviation : "");
    step.sun = sun::sunPosition(period.place, t);
    result.steps.push_back(std::move(step));
  }
  share(result.steps, from->instant, to->instant);
  return result;
}

}  // namespace umbrage::study
