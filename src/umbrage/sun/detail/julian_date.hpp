#pragma once

#include "umbrage/sun/sun.hpp"

namespace umbrage::sun::detail {

inline constexpr double kMillisecondsPerDay = 86400e3;

/// A Julian date in two parts, the first a whole number plus a half, as ERFA likes it.
struct JulianDate {
  double day, fraction;
};

[[nodiscard]] JulianDate julianDate(Instant instant);

/// Terrestrial time ahead of UTC, seconds.
[[nodiscard]] double ttMinusUtc(Instant instant);

}  // namespace umbrage::sun::detail
