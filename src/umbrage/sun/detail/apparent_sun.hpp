#pragma once

#include "umbrage/math/vec.hpp"
#include "umbrage/sun/sun.hpp"

namespace umbrage::sun::detail {

/// The geocentric apparent sun (light time, aberration, precession, nutation), as a vector in au in the celestial intermediate frame.
/// 1. Within 1e-11 radians of what ERFA's series say; they are summed at a few moments only and drawn smoothly between, since a
///    sum takes 0.1 ms and the sun hardly moves among the stars.
/// 2. A function of the instant alone: what else was asked for, and in which thread, changes no bit.
/// Source: ERFA, apci13, epv00, ab; IAU 2006/2000A.
[[nodiscard]] Vec3 apparentSun(Instant instant);

/// The same from the series, at a moment of terrestrial time in days since 2000-01-01 12:00.
[[nodiscard]] Vec3 apparentSunBySeries(double wholeDays, double fraction);

}  // namespace umbrage::sun::detail
