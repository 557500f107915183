#include "umbrage/sun/sun.hpp"

#include <erfa.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "umbrage/sun/detail/apparent_sun.hpp"
#include "umbrage/sun/detail/julian_date.hpp"

namespace umbrage::sun {
namespace {

constexpr double kSolarParallax = Angle::degrees(8.794143 / 3600.0).radians();  // equatorial, at 1 au
constexpr double kPi = std::numbers::pi;

// The geocentric apparent sun, in the Earth-fixed equatorial frame: hour angle at Greenwich, declination, distance in
// au.
struct ApparentSun {
  double greenwichHourAngle, declination, distance;
};

ApparentSun apparentSun(Instant instant) {
  const Vec3 sun = detail::apparentSun(instant);
  const detail::JulianDate ut = detail::julianDate(instant);
  const double rightAscension = std::atan2(sun.y, sun.x), declination = std::atan2(sun.z, std::hypot(sun.x, sun.y));
  return {eraAnpm(eraEra00(ut.day, ut.fraction) - rightAscension), declination, glm::length(sun)};
}

}  // namespace

Angle refractionAt(Angle trueElevation) {
  constexpr double kLowest = -1.0;
  const double h = std::max(trueElevation.degrees(), kLowest);
  const double arcMinutes = 1.02 / tan(Angle::degrees(h + 10.3 / (h + 5.11)));
  const double lift = std::max(0.0, arcMinutes / 60.0);
  if (trueElevation.degrees() >= kLowest) return Angle::degrees(lift);
  if (trueElevation.degrees() <= -89.0) return {};
  return Angle::degrees(lift * tan(Angle::degrees(kLowest)) / tan(trueElevation));
}

SunPosition sunPosition(const Place& place, Instant instant, Refraction refraction) {
  const ApparentSun sun = apparentSun(instant);
  const double h = sun.greenwichHourAngle + place.longitude.radians();
  const double sinLatitude = sin(place.latitude), cosLatitude = cos(place.latitude);
  const double sinDeclination = std::sin(sun.declination), cosDeclination = std::cos(sun.declination);
  const double east = -cosDeclination * std::sin(h);
  const double north = sinDeclination * cosLatitude - cosDeclination * std::cos(h) * sinLatitude;
  const double up = sinDeclination * sinLatitude + cosDeclination * std::cos(h) * cosLatitude;
  // Seen from the surface instead of the centre of the (here spherical) Earth.
  const double lowered = up - kSolarParallax / sun.distance;
  Angle elevation = Angle::radians(std::atan2(lowered, std::hypot(east, north)));
  if (refraction == Refraction::standard) elevation = elevation + refractionAt(elevation);
  return {elevation, Angle::radians(std::atan2(east, north)).wrapped()};
}

Angle hourAngle(const Place& place, Instant instant) {
  return Angle::radians(eraAnpm(apparentSun(instant).greenwichHourAngle + place.longitude.radians()));
}

Instant instantOfHourAngle(const Place& place, Instant near, Angle angle) {
  // The hour angle grows by 15 degrees an hour to within 30 s a day: each pass shrinks the error more than a
  // thousandfold.
  for (int pass = 0; pass < 4; ++pass) {
    const double missing = eraAnpm(angle.radians() - hourAngle(place, near).radians());
    near += std::chrono::milliseconds(std::llround(missing / (2.0 * kPi) * detail::kMillisecondsPerDay));
  }
  return near;
}

Vec3 eastNorthUp(const SunPosition& position) {
  const double horizontal = cos(position.elevation);
  return {horizontal * sin(position.azimuth), horizontal * cos(position.azimuth), sin(position.elevation)};
}

std::string_view compassPoint(Angle azimuth) {
  static constexpr std::array<std::string_view, 16> kNames{"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                                           "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  return kNames[static_cast<std::size_t>(std::lround(azimuth.wrapped().degrees() / 22.5)) % kNames.size()];
}

}  // namespace umbrage::sun
