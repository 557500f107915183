#include "umbrage/sun/sun_path.hpp"

#include "umbrage/base/check.hpp"

namespace umbrage::sun {
namespace {

constexpr std::chrono::milliseconds kHalfDay = std::chrono::hours(12);

bool isUp(const Place& place, Instant instant, Angle horizon) {
  return sunPosition(place, instant).elevation > horizon;
}

// The crossing between a moment when the sun is down and one when it is up, in either order; none where both are alike.
std::optional<Instant> crossing(const Place& place, Instant a, Instant b, Angle horizon) {
  const bool upAtA = isUp(place, a, horizon);
  if (upAtA == isUp(place, b, horizon)) return std::nullopt;
  while (b - a > std::chrono::milliseconds(1)) {
    const Instant middle = a + (b - a) / 2;
    (isUp(place, middle, horizon) == upAtA ? a : b) = middle;
  }
  return b;
}

}  // namespace

Result<SunDay> sunDay(const Place& place, const Zone& zone, std::chrono::year_month_day date,
                      const SunDayOptions& options) {
  const auto noon = instantOf(zone, place, {date, kHalfDay});
  if (!noon) return tl::unexpected(noon.error());
  SunDay day;
  day.transit = instantOfHourAngle(place, noon->instant, {});
  day.highest = sunPosition(place, day.transit);
  day.rise = crossing(place, instantOfHourAngle(place, day.transit - kHalfDay, Angle::degrees(180)), day.transit,
                      options.horizon);
  day.set = crossing(place, day.transit, instantOfHourAngle(place, day.transit + kHalfDay, Angle::degrees(180)),
                     options.horizon);
  if (!day.rise && !day.set)
    day.kind = day.highest.elevation > options.horizon ? SunDay::Kind::alwaysUp : SunDay::Kind::alwaysDown;
  return day;
}

std::vector<SunSample> sunPath(const Place& place, Instant from, Instant to, std::chrono::milliseconds step,
                               Refraction refraction) {
  UMBRAGE_CHECK(step.count() > 0 && from <= to,
                "sunPath needs a positive step and a period that does not run backwards");
  std::vector<SunSample> samples;
  for (Instant t = from; t <= to; t += step) samples.push_back({t, sunPosition(place, t, refraction)});
  return samples;
}

}  // namespace umbrage::sun
