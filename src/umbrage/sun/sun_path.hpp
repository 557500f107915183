#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::sun {

/// The sun's day at a place. Rise and set belong to the transit: the last rise before it and the first set after it.
struct SunDay {
  enum class Kind { risesAndSets, alwaysUp, alwaysDown };
  Kind kind = Kind::risesAndSets;
  Instant transit;                   ///< upper transit: hour angle 0
  SunPosition highest;               ///< at the transit
  std::optional<Instant> rise, set;  ///< absent on polar days and nights; near their ends one alone may be absent
};

struct SunDayOptions {
  /// The elevation of the sun's centre that counts as rise and set: 0, geometric; -0.833 degrees is the almanacs' upper
  /// limb with refraction.
  Angle horizon;
};

/// The day whose transit is nearest to the clock's noon. Errors: those of instantOf.
[[nodiscard]] Result<SunDay> sunDay(const Place& place, const Zone& zone, std::chrono::year_month_day date,
                                    const SunDayOptions& options = {});

struct SunSample {
  Instant instant;
  SunPosition position;
};

/// The sun from `from` to `to`, every `step`, and at `to` where it falls on a step.
/// REQUIRES: step > 0, from <= to.
[[nodiscard]] std::vector<SunSample> sunPath(const Place& place, Instant from, Instant to,
                                             std::chrono::milliseconds step, Refraction refraction = Refraction::none);

}  // namespace umbrage::sun
