#pragma once

#include <optional>
#include <string>
#include <vector>

#include "umbrage/rules/detail/spans.hpp"
#include "umbrage/rules/rule.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::rules::detail {

/// Where and by which clock a rule is held.
struct Calendar {
  sun::Place place;
  sun::Zone zone;                      ///< what the clock of the place shows
  std::chrono::year_month_day date{};  ///< its year counts; rules without days of their own take it
};

/// When the sun's apparent longitude passes a value in a year (UTC), within 20 minutes.
/// Source: Meeus, Astronomical Algorithms, 2nd edition 1998, chapter 25.
[[nodiscard]] sun::Instant instantOfLongitude(Angle longitude, std::chrono::year year);

/// The dates that a rule looks at, ascending, each once. 29 February is 28 February in years without.
[[nodiscard]] std::vector<std::chrono::year_month_day> datesOf(const Days& days, const Calendar& calendar);

/// What must be known about these dates: a 29 February that the year does not have.
[[nodiscard]] std::vector<std::string> dateNotes(const Days& days, const Calendar& calendar);

/// What the true sun's clock calls the day that the calendar's clock calls `date`: the day whose solar noon is the one nearest to that clock's noon. Near
/// the date line the two differ by a day.
[[nodiscard]] std::chrono::year_month_day solarDateOf(std::chrono::year_month_day date, const Calendar& calendar);

/// The zone of one of the rule's clocks. `switched`: of the other one: the legal clock for the true sun's, the true sun's for others. Where the
/// calendar's own zone is that of the sun, its legal clock is mean solar time.
[[nodiscard]] sun::Zone zoneOf(Clock clock, const Calendar& calendar, bool switched);

/// The window of a day; nothing where its limits leave nothing. From a moment that clocks leave out it begins, or ends, when they are put
/// forward; from the first to the second of moments that come twice.
[[nodiscard]] std::optional<study::TimeSpan> windowOn(const Window& window, std::chrono::year_month_day date,
                                                      const Calendar& calendar, bool clockSwitched);

/// What must be known about the moments that a window names on a day: those that clocks leave out or show twice.
[[nodiscard]] std::vector<std::string> windowNotes(const Window& window, std::chrono::year_month_day date,
                                                   const Calendar& calendar);

/// When the sun of a course counts: it is up, and as high as that.
[[nodiscard]] Spans countingTimes(const study::SunCourse& course, const std::optional<Angle>& leastAltitude);

}  // namespace umbrage::rules::detail
