#include "umbrage/rules/detail/days.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "umbrage/base/check.hpp"
#include "umbrage/sun/sun_path.hpp"

namespace umbrage::rules::detail {
namespace {

using std::chrono::milliseconds;
using std::chrono::month_day;
using std::chrono::sys_days;
using std::chrono::year_month_day;
using study::TimeSpan;

// The upper limb on the horizon, lifted by the air.
constexpr Angle kAlmanacHorizon = Angle::degrees(-0.833);
const sun::Zone kSolar{sun::Zone::Kind::solar, "solar", {}};

double longitudeAt(sun::Instant instant) {
  const double days = double((instant - sys_days(std::chrono::year(2000) / 1 / 1)).count()) / 86400e3 - 0.5;
  const double t = days / 36525.0;
  const double mean = 280.46646 + 36000.76983 * t + 0.0003032 * t * t;
  const Angle anomaly = Angle::degrees(357.52911 + 35999.05029 * t - 0.0001537 * t * t);
  const double centre = (1.914602 - 0.004817 * t) * sin(anomaly) + (0.019993 - 0.000101 * t) * sin(2.0 * anomaly) +
                        0.000289 * sin(3.0 * anomaly);
  const double nutation = 0.00478 * sin(Angle::degrees(125.04 - 1934.136 * t));
  return mean + centre - 0.00569 - nutation;
}

year_month_day inYear(const month_day& day, std::chrono::year year) {
  const year_month_day date = year / day.month() / day.day();
  return date.ok() ? date : year_month_day(year / day.month() / std::chrono::last);
}

// Of a range that passes New Year the last day is in the next year.
std::pair<year_month_day, year_month_day> endsOf(const Days& days, std::chrono::year year) {
  const auto first = inYear(days.dates[0], year), last = inYear(days.dates[1], year);
  return {first, last < first ? inYear(days.dates[1], year + std::chrono::years(1)) : last};
}

std::vector<year_month_day> rangeOf(const Days& days, std::chrono::year year) {
  const auto ends = endsOf(days, year);
  const sys_days first(ends.first), last(ends.second);
  std::vector<year_month_day> dates;
  for (sys_days day = first; day < last; day += std::chrono::days(days.every)) dates.emplace_back(day);
  dates.emplace_back(last);
  return dates;
}

sun::Zone fixedZone(std::chrono::minutes offset) {
  return {sun::Zone::Kind::fixed, sun::offsetText(std::chrono::seconds(offset)), offset};
}

// Clocks stand farthest back without daylight saving, be it in January or in July.
sun::Zone standardOf(const Calendar& calendar) {
  if (calendar.zone.kind != sun::Zone::Kind::named) return calendar.zone;
  std::chrono::seconds least = std::chrono::hours(24);
  for (const auto month : {std::chrono::January, std::chrono::July})
    least =
        std::min(least, sun::clockAt(calendar.zone, calendar.place, sys_days(calendar.date.year() / month / 1)).offset);
  return fixedZone(std::chrono::round<std::chrono::minutes>(least));
}

sun::Zone legalOf(Clock clock, const Calendar& calendar) {
  if (calendar.zone.kind == sun::Zone::Kind::solar)
    return fixedZone(std::chrono::minutes(std::lround(calendar.place.longitude.degrees() * 4.0)));
  return clock == Clock::standard ? standardOf(calendar) : calendar.zone;
}

// By the clock: all of what it shows between them, also where it shows a time twice or not at all.
std::pair<sun::Moment, sun::Moment> bordersOf(const Window& window, year_month_day date, const Calendar& calendar,
                                              bool clockSwitched) {
  const sun::Zone zone = zoneOf(window.clock, calendar, clockSwitched);
  const auto day = zone.kind == sun::Zone::Kind::solar ? solarDateOf(date, calendar) : date;
  const auto at = [&](milliseconds time, sun::Twice twice) {
    return sun::nearestInstantOf(zone, calendar.place, {day, time}, twice);
  };
  return {at(window.from.value_or(milliseconds(0)), sun::Twice::first),
          at(window.to.value_or(std::chrono::hours(24)), sun::Twice::second)};
}

}  // namespace

sun::Instant instantOfLongitude(Angle longitude, std::chrono::year year) {
  const sun::Instant start = sys_days(year / 1 / 1), end = sys_days((year + std::chrono::years(1)) / 1 / 1);
  // On New Year's Day the longitude is 280 degrees; it grows by 360 in a year.
  const double first = longitudeAt(start);
  double wanted = longitude.degrees();
  wanted += 360.0 * std::ceil((first - wanted) / 360.0);
  sun::Instant a = start, b = end + std::chrono::hours(24);
  while (b - a > milliseconds(1000)) {
    const sun::Instant middle = a + (b - a) / 2;
    (longitudeAt(middle) < wanted ? a : b) = middle;
  }
  return b;
}

std::vector<year_month_day> datesOf(const Days& days, const Calendar& calendar) {
  std::vector<year_month_day> dates;
  const std::chrono::year year = calendar.date.year();
  switch (days.kind) {
    case Days::Kind::given: dates.push_back(calendar.date); break;
    case Days::Kind::range: return rangeOf(days, year);
    case Days::Kind::dates:
      for (const month_day& day : days.dates) dates.push_back(inYear(day, year));
      break;
    case Days::Kind::longitudes:
      for (const Angle longitude : days.longitudes)
        dates.push_back(sun::clockAt(calendar.zone, calendar.place, instantOfLongitude(longitude, year)).clock.date);
  }
  std::sort(dates.begin(), dates.end());
  dates.erase(std::unique(dates.begin(), dates.end()), dates.end());
  return dates;
}

std::vector<std::string> dateNotes(const Days& days, const Calendar& calendar) {
  std::vector<year_month_day> dates;
  for (const month_day& day : days.dates) dates.push_back(inYear(day, calendar.date.year()));
  if (days.kind == Days::Kind::range) dates[1] = endsOf(days, calendar.date.year()).second;
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < dates.size(); ++i)
    if (days.dates[i].day() != dates[i].day())
      notes.push_back(fmt::format("{} has no 29 February: the 28th is taken", int(dates[i].year())));
  return notes;
}

year_month_day solarDateOf(year_month_day date, const Calendar& calendar) {
  if (calendar.zone.kind == sun::Zone::Kind::solar) return date;
  const auto clockNoon =
      sun::nearestInstantOf(calendar.zone, calendar.place, {date, std::chrono::hours(12)}, sun::Twice::first);
  // The mean sun's date is the true one's: at its noon they are never more than 17 minutes apart.
  const milliseconds east(std::llround(calendar.place.longitude.degrees() * 240e3));
  return std::chrono::floor<std::chrono::days>(clockNoon.instant + east);
}

sun::Zone zoneOf(Clock clock, const Calendar& calendar, bool switched) {
  const bool solar = (clock == Clock::solar) != switched;
  if (solar) return kSolar;
  return legalOf(clock, calendar);
}

std::vector<std::string> windowNotes(const Window& window, year_month_day date, const Calendar& calendar) {
  const auto [from, to] = bordersOf(window, date, calendar, false);
  std::vector<std::string> notes;
  if (window.from && from.warning) notes.push_back(*from.warning);
  if (window.to && to.warning) notes.push_back(*to.warning);
  return notes;
}

std::optional<TimeSpan> windowOn(const Window& window, year_month_day date, const Calendar& calendar,
                                 bool clockSwitched) {
  const auto [from, to] = bordersOf(window, date, calendar, clockSwitched);
  TimeSpan span{from.instant, to.instant};
  if (window.afterSunrise || window.beforeSunset) {
    const auto day = sun::sunDay(calendar.place, kSolar, solarDateOf(date, calendar), {kAlmanacHorizon});
    UMBRAGE_CHECK(day, "the true sun has a noon every day");
    if (day->kind == sun::SunDay::Kind::alwaysDown) return std::nullopt;
    if (window.afterSunrise && day->rise) span.from = std::max(span.from, *day->rise + *window.afterSunrise);
    if (window.beforeSunset && day->set) span.to = std::min(span.to, *day->set - *window.beforeSunset);
  }
  if (span.from >= span.to) return std::nullopt;
  return span;
}

Spans countingTimes(const study::SunCourse& course, const std::optional<Angle>& leastAltitude) {
  if (!leastAltitude) return course.up();
  const double least = sin(*leastAltitude);
  const auto high = [&](sun::Instant t) { return course.towards(t).z >= least; };
  Spans spans;
  for (const TimeSpan& up : course.up()) {
    // The highest sun is a probe too, so that no short stretch around it is missed.
    std::vector<sun::Instant> probes;
    for (sun::Instant t = up.from; t < up.to; t += std::chrono::minutes(10)) probes.push_back(t);
    probes.push_back(up.to);
    const sun::Instant noon = sun::instantOfHourAngle(course.place(), up.from + up.length() / 2, {});
    if (up.from < noon && noon < up.to) probes.push_back(noon);
    std::sort(probes.begin(), probes.end());
    bool before = high(probes.front());
    sun::Instant since = probes.front();
    for (std::size_t i = 1; i < probes.size(); ++i) {
      sun::Instant a = probes[i - 1], b = probes[i];
      if (high(b) == before) continue;
      while (b - a > milliseconds(1)) {
        const sun::Instant middle = a + (b - a) / 2;
        (high(middle) == before ? a : b) = middle;
      }
      if (before) spans.push_back({since, b});
      before = !before;
      since = b;
    }
    if (before && since < up.to) spans.push_back({since, up.to});
  }
  return spans;
}

}  // namespace umbrage::rules::detail
