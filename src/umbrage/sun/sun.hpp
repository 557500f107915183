#pragma once

#include <chrono>
#include <string_view>

#include "umbrage/base/angle.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::sun {

/// A point of the Earth's surface. latitude: [-90, 90] degrees, north positive; longitude: [-180, 180] degrees, east
/// positive.
struct Place {
  Angle latitude;
  Angle longitude;
};

/// A moment of universal time (UTC), to the millisecond; in a millisecond the sun turns by 4e-6 degrees.
using Instant = std::chrono::sys_time<std::chrono::milliseconds>;

/// Where the centre of the sun's disc stands. elevation: above the true horizon; azimuth: from true north, clockwise,
/// [0, 360) degrees. At the poles "north" is the direction of the place's meridian across the pole.
struct SunPosition {
  Angle elevation;
  Angle azimuth;
};

enum class Refraction {
  none,      ///< geometric: what the directions of shadow studies are by convention
  standard,  ///< as seen through an atmosphere of 1010 hPa and 10 degrees Celsius
};

/// The topocentric position of the sun's centre: apparent place (light time, aberration, precession, nutation) and
/// parallax.
/// 1. Within 0.0001 degrees of ERFA for an observer (selfCheck) for 1972..today; UT1 - UTC is taken as 0, which can cost 0.004
/// degrees of hour angle.
/// 2. TT - UTC comes from ERFA's table of leap seconds; its last value holds for later dates, 32.184 s before 1960. A
/// minute's
///    error here moves the sun by 0.0007 degrees.
/// CAVEAT: years outside 1900..2100 lose accuracy slowly.
/// Source: ERFA (IAU SOFA's routines), epv00, ab, pnm06a, era00; IAU 2006/2000A.
[[nodiscard]] SunPosition sunPosition(const Place& place, Instant instant, Refraction refraction = Refraction::none);

/// How far refraction lifts a body of this true elevation, at 1010 hPa and 10 degrees Celsius.
/// Source: Saemundsson, Sky and Telescope 72, 1986; below -1 degree fading as 1 / tan.
[[nodiscard]] Angle refractionAt(Angle trueElevation);

/// The sun's local hour angle in (-180, 180] degrees: 0 at true solar noon, positive in the afternoon.
[[nodiscard]] Angle hourAngle(const Place& place, Instant instant);

/// The instant nearest to `near` at which the hour angle has the given value; exact to the millisecond.
[[nodiscard]] Instant instantOfHourAngle(const Place& place, Instant near, Angle angle);

/// Unit vector (east, north, up) from the place towards the sun.
[[nodiscard]] Vec3 eastNorthUp(const SunPosition& position);

/// The sixteen-point compass name of an azimuth: "N", "NNE", ...
[[nodiscard]] std::string_view compassPoint(Angle azimuth);

}  // namespace umbrage::sun
