#include "moments.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "umbrage/sun/sun_path.hpp"

namespace umbrage::cli {
namespace {

// One moment of the clock as a step of a period.
Result<study::PeriodStep> stepAt(std::chrono::milliseconds at, const PlaceOptions& when, const sun::Place& place,
                                 std::vector<std::string>& warnings) {
  const auto moment = sun::instantOf(when.zone, place, {when.date, at});
  if (!moment) return tl::unexpected(moment.error());
  if (moment->warning) warnings.push_back(*moment->warning);
  return study::PeriodStep{moment->instant, sun::timeText(at), {}, sun::sunPosition(place, moment->instant)};
}

std::string offsetText(const PlaceOptions& when, const sun::Place& place, sun::Instant instant) {
  return sun::offsetText(sun::clockAt(when.zone, place, instant));
}

Result<study::PeriodSteps> singleMoments(const MomentOptions& options, const PlaceOptions& when,
                                         const sun::Place& place) {
  study::PeriodSteps steps;
  auto times = options.at;
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (const auto at : times) {
    auto step = stepAt(at, when, place, steps.warnings);
    if (!step) return tl::unexpected(step.error());
    steps.steps.push_back(std::move(*step));
  }
  steps.offset = offsetText(when, place, steps.steps.front().instant);
  return steps;
}

Result<study::PeriodSteps> allMoments(const MomentOptions& options, const PlaceOptions& when, const sun::Place& place) {
  const bool period = options.from || options.to || options.step;
  if (!options.at.empty() && period) return fail(ErrorCode::usage, "--at and --from, --to, --step exclude one another");
  if (!options.at.empty()) return singleMoments(options, when, place);
  if (!options.from || !options.to || !options.step)
    return fail(ErrorCode::usage, "the moments are missing: --at HH:MM (repeatable), or --from, --to and --step");
  return study::stepsOf({place, when.zone, when.date, *options.from, *options.to, *options.step});
}

}  // namespace

Result<std::chrono::milliseconds> parseStep(const std::string& word) {
  const auto minutes = parseNumber(word, 0.0, 1440.0);
  if (!minutes) return tl::unexpected(minutes.error());
  const std::chrono::milliseconds step(std::llround(*minutes * 60000.0));
  if (step.count() <= 0)
    return fail(ErrorCode::usage, fmt::format("'{}' is no time: a number of minutes above 0", word));
  return step;
}

void addMomentOptions(CLI::App& app, MomentOptions& options) {
  constexpr Manner time{.group = "Place and time"};
  addValues(app, "--at", "HH:MM[:SS]", "A moment; repeatable", options.at, sun::parseTime, time);
  addValue(app, "--from", "HH:MM", "The first moment of a period", options.from, sun::parseTime, time);
  addValue(app, "--to", "HH:MM", "The end of the period", options.to, sun::parseTime, time);
  addValue(app, "--step", "MIN", "Minutes from one moment to the next", options.step, parseStep, time);
}

Result<study::TimeSpan> spanOf(std::chrono::milliseconds from, std::chrono::milliseconds to, const PlaceOptions& when,
                               const sun::Place& place, const Console& console) {
  study::TimeSpan span{};
  for (const auto& [clock, instant] : {std::pair(from, &span.from), std::pair(to, &span.to)}) {
    const auto moment = sun::instantOf(when.zone, place, {when.date, clock});
    if (!moment) return tl::unexpected(moment.error());
    if (moment->warning) console.warn(*moment->warning);
    *instant = moment->instant;
  }
  if (span.from < span.to) return span;
  return fail(ErrorCode::usage, fmt::format("the period from {} to {} is empty or runs backwards", sun::timeText(from),
                                            sun::timeText(to)));
}

std::string offsetsText(const PlaceOptions& when, const sun::Place& place, const study::TimeSpan& span) {
  const std::string first = offsetText(when, place, span.from),
                    last = offsetText(when, place, span.to - std::chrono::milliseconds(1));
  return first == last ? first : first + ", then " + last;
}

std::string clockText(const PlaceOptions& when, const sun::Place& place, sun::Instant instant) {
  const auto reading = sun::clockAt(when.zone, place, instant).clock;
  const bool nextDay = std::chrono::sys_days(reading.date) > std::chrono::sys_days(when.date);
  return sun::timeText(nextDay ? reading.time + std::chrono::hours(24) : reading.time);
}

std::string sunTimes(const PlaceOptions& when, const sun::Place& place) {
  const auto day = sun::sunDay(place, when.zone, when.date);
  if (!day) return "its day is not known";
  if (day->kind == sun::SunDay::Kind::alwaysDown) return "it does not rise on that day";
  if (day->kind == sun::SunDay::Kind::alwaysUp) return "it does not set on that day";
  const auto clock = [&](const std::optional<sun::Instant>& instant) {
    return instant ? sun::timeText(sun::clockAt(when.zone, place, *instant).clock.time) : std::string("another day");
  };
  return fmt::format("it rises at {} and sets at {} ({})", clock(day->rise), clock(day->set), when.zone.name);
}

Result<study::PeriodSteps> momentsOf(const MomentOptions& options, const PlaceOptions& when, const sun::Place& place) {
  auto steps = allMoments(options, when, place);
  if (!steps) return steps;
  const auto all = steps->steps.size();
  const auto darkest = steps->steps.front();
  std::erase_if(steps->steps, [](const study::PeriodStep& step) { return !step.sunIsUp(); });
  if (steps->steps.empty())
    return fail(ErrorCode::usage,
                fmt::format("the sun is below the horizon ({:.1f} degrees at {}): there are no shadows; {}",
                            darkest.sun.elevation.degrees(), darkest.label, sunTimes(when, place)));
  if (steps->steps.size() < all)
    steps->warnings.push_back(fmt::format("{} of {} moments left out, the sun is below the horizon: {}",
                                          all - steps->steps.size(), all, sunTimes(when, place)));
  return steps;
}

}  // namespace umbrage::cli
