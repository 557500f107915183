#include "umbrage/sun/self_check.hpp"

#include <erfa.h>

#include <algorithm>
#include <cmath>

#include "umbrage/base/check.hpp"
#include "umbrage/sun/detail/julian_date.hpp"
#include "umbrage/sun/sun_path.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::sun {
namespace {

using std::chrono::sys_days;

constexpr double kLightSecondsPerAu = 499.004784;
constexpr double kMostUt1MinusUtc = 0.9;
constexpr double kLowestRefracted = 5.0;  // degrees
constexpr double kFarthestDay = 60.0;     // degrees of latitude: beyond, the sun may graze the horizon

// A day costs as much as so many moments and more.
constexpr std::size_t kMomentsPerDay = 10;

// What ERFA's refraction is told of the air: that of Refraction::standard, dry, at the middle of what is seen.
constexpr double kHectopascals = 1010.0, kCelsius = 10.0, kHumidity = 0.0, kMicrometres = 0.55;

// The direction from the observer to where the sun was when the light that arrives now left it. ICRS.
void towardsSun(eraASTROM observer, double day, double tdbFraction, double direction[3]) {
  double lightDays = kLightSecondsPerAu / 86400.0, distance = 1.0;
  for (int pass = 0; pass < 3; ++pass) {
    double heliocentric[2][3], barycentric[2][3], sun[3], towards[3];
    eraEpv00(day, tdbFraction - lightDays, heliocentric, barycentric);
    eraPmp(barycentric[0], heliocentric[0], sun);
    eraPmp(sun, observer.eb, towards);
    eraPn(towards, &distance, direction);
    lightDays = distance * kLightSecondsPerAu / 86400.0;
  }
}

double separation(const SunPosition& a, const SunPosition& b) {
  return Angle::radians(2.0 * std::asin(0.5 * glm::length(eastNorthUp(a) - eastNorthUp(b)))).degrees();
}

// A moment as ERFA counts it: a day that ends with a leap second is 86,401 s long.
detail::JulianDate erfasUtc(Instant instant) {
  const auto day = std::chrono::floor<std::chrono::days>(instant);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss time(instant - day);
  const double seconds = double(time.seconds().count()) + double(time.subseconds().count()) / 1000.0;
  detail::JulianDate utc{};
  eraDtf2d("UTC", int(date.year()), int(unsigned(date.month())), int(unsigned(date.day())), int(time.hours().count()),
           int(time.minutes().count()), seconds, &utc.day, &utc.fraction);
  return utc;
}

// The sun's azimuth from the meridian that it passes at its highest, in (-180, 180] degrees.
double fromMeridian(const SunPosition& position, bool south) {
  return std::remainder(position.azimuth.degrees() - (south ? 180.0 : 0.0), 360.0);
}

void addDay(const PlaceAndTime& sample, SelfCheck& check) {
  const auto date = std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(sample.instant));
  Zone local;  // whose noon is near the sun's
  local.offset = std::chrono::minutes(std::lround(sample.place.longitude.degrees() * 4.0));
  const auto day = sunDay(sample.place, local, date);
  if (!day || !day->rise || !day->set) return;
  const auto elevation = [&](Instant t) { return sunPositionByObserver(sample.place, t).elevation.degrees(); };
  check.riseAndSet.add(secondsSinceZero(*day->rise, elevation), sample.place, *day->rise);
  check.riseAndSet.add(secondsSinceZero(*day->set, elevation), sample.place, *day->set);
  // Where the sun passes near the zenith its azimuth says little of the time.
  if (day->highest.elevation.degrees() > 85.0) return;
  const bool south = std::abs(fromMeridian(day->highest, true)) < 90.0;
  const auto azimuth = [&](Instant t) { return fromMeridian(sunPositionByObserver(sample.place, t), south); };
  check.noon.add(secondsSinceZero(day->transit, azimuth), sample.place, day->transit);
}

void addMoment(const PlaceAndTime& s, SelfCheck& check) {
  const SunPosition byErfa = sunPositionByObserver(s.place, s.instant);
  check.direction.add(separation(sunPosition(s.place, s.instant), byErfa), s.place, s.instant);
  const SunPosition turned = sunPositionByObserver(s.place, s.instant, Refraction::none, kMostUt1MinusUtc);
  check.universalTime.add(separation(turned, byErfa), s.place, s.instant);
  if (byErfa.elevation.degrees() < kLowestRefracted) return;
  const Angle seen = sunPositionByObserver(s.place, s.instant, Refraction::standard).elevation;
  const Angle ours = sunPosition(s.place, s.instant, Refraction::standard).elevation;
  check.refraction.add((ours - seen).degrees(), s.place, s.instant);
}

}  // namespace

void Deviation::add(double difference, const Place& where, Instant when) {
  const double size = std::abs(difference);
  sum += size;
  if (++count == 1 || size > worst) worst = size, place = where, instant = when;
}

PlaceAndTime spreadPlaceAndTime(std::size_t i, int firstYear, int lastYear) {
  constexpr double kRoot = 1.2207440846057596;  // of x^4 = x + 1
  const auto part = [i](double step) { return std::fmod(0.5 + double(i + 1) * step, 1.0); };
  const double u = part(1.0 / kRoot), v = part(1.0 / (kRoot * kRoot)), w = part(1.0 / (kRoot * kRoot * kRoot));
  const sys_days first = std::chrono::year(firstYear) / 1 / 1, last = std::chrono::year(lastYear + 1) / 1 / 1;
  const auto period = std::chrono::milliseconds(last - first);
  return {{Angle::radians(std::asin(2.0 * u - 1.0)), Angle::degrees(360.0 * v - 180.0)},
          first + std::chrono::milliseconds(std::int64_t(w * double(period.count())))};
}

SunPosition sunPositionByObserver(const Place& place, Instant instant, Refraction refraction,
                                  double secondsUt1MinusUtc) {
  const detail::JulianDate utc = erfasUtc(instant), even = detail::julianDate(instant);
  const double air = refraction == Refraction::standard ? kHectopascals : 0.0;
  eraASTROM observer;
  double equationOfOrigins;
  eraApco13(utc.day, utc.fraction, secondsUt1MinusUtc, place.longitude.radians(), place.latitude.radians(), 0.0, 0.0,
            0.0, air, kCelsius, kHumidity, kMicrometres, &observer, &equationOfOrigins);
  double direction[3], apparent[3], intermediate[3], rightAscension, declination;
  towardsSun(observer, even.day, even.fraction + detail::ttMinusUtc(instant) / 86400.0, direction);
  // The sun's own bending of light is no matter for its own centre.
  eraAb(direction, observer.v, observer.em, observer.bm1, apparent);
  eraRxp(observer.bpn, apparent, intermediate);
  eraC2s(intermediate, &rightAscension, &declination);
  double azimuth, zenithDistance, hourAngle, observedDeclination, observedRightAscension;
  eraAtioq(rightAscension, declination, &observer, &azimuth, &zenithDistance, &hourAngle, &observedDeclination,
           &observedRightAscension);
  return {Angle::degrees(90.0) - Angle::radians(zenithDistance), Angle::radians(azimuth).wrapped()};
}

SelfCheck selfCheck(const SelfCheckOptions& options) {
  UMBRAGE_CHECK(options.firstYear >= 1972 && options.firstYear <= options.lastYear && options.lastYear <= kLastYear,
                "the self-check is of years from 1972 to 2100");
  SelfCheck check;
  for (std::size_t i = 0; i < options.moments; ++i) {
    const PlaceAndTime s = spreadPlaceAndTime(i, options.firstYear, options.lastYear);
    addMoment(s, check);
    if (i % kMomentsPerDay == 0 && std::abs(s.place.latitude.degrees()) <= kFarthestDay) addDay(s, check);
  }
  return check;
}

bool holds(const SelfCheck& check) {
  return check.direction.worst <= kDirectionBound && check.refraction.worst <= kRefractionBound &&
         check.noon.worst <= kCrossingBound && check.riseAndSet.worst <= kCrossingBound;
}

}  // namespace umbrage::sun
