#pragma once

#include <cstddef>

#include "umbrage/sun/sun.hpp"

namespace umbrage::sun {

/// The sun as ERFA's own chain for an observer gives it, by another road than sunPosition's: the observer on the WGS 84
/// ellipsoid and moving with it (diurnal aberration), the sun where it was when its light left, ERFA's refraction.
/// secondsUt1MinusUtc: what the Earth's turning is ahead of the clock, within 0.9 s; 0 is what sunPosition assumes.
/// REQUIRES: a year of 1960 or later.
/// CAVEAT: ERFA's refraction is no model for elevations below 5 degrees.
/// Source: ERFA (IAU SOFA's routines), apco13, epv00, ab, atioq.
[[nodiscard]] SunPosition sunPositionByObserver(const Place& place, Instant instant,
                                                Refraction refraction = Refraction::none,
                                                double secondsUt1MinusUtc = 0.0);

/// How far two answers are apart, in the unit of what is compared.
struct Deviation {
  std::size_t count = 0;
  double worst = 0.0;
  double sum = 0.0;
  Place place;      ///< of the worst
  Instant instant;  ///< of the worst

  [[nodiscard]] double mean() const { return count > 0 ? sum / double(count) : 0.0; }
  void add(double difference, const Place& where, Instant when);
};

struct PlaceAndTime {
  Place place;
  Instant instant;
};

/// The i-th of a sequence that fills the Earth's surface, the years and the hours of the day evenly.
/// Source: Martin Roberts, The unreasonable effectiveness of quasirandom sequences, 2018.
[[nodiscard]] PlaceAndTime spreadPlaceAndTime(std::size_t i, int firstYear, int lastYear);

/// How long ago `measure` (of an Instant), which moves steadily, was 0; seconds, negative where it is yet to be.
template <class Measure>
[[nodiscard]] double secondsSinceZero(Instant instant, Measure measure) {
  constexpr std::chrono::seconds kStep(30);
  const double perSecond = (measure(instant + kStep) - measure(instant - kStep)) / (2.0 * double(kStep.count()));
  return measure(instant) / perSecond;
}

struct SelfCheckOptions {
  std::size_t moments = 5000;  ///< spread evenly over the Earth, the years and the hours; the same at each run
  int firstYear = 1972;        ///< [1972, 2100]: since then the clock has whole leap seconds
  int lastYear = 2050;         ///< [firstYear, 2100], with it
};

/// sunPosition and sunDay held against sunPositionByObserver.
struct SelfCheck {
  Deviation direction;      ///< degrees between the two directions
  Deviation refraction;     ///< degrees of refracted elevation, where the sun stands 5 degrees high or more
  Deviation universalTime;  ///< degrees that UT1 - UTC of 0.9 s, its greatest, would turn the sun by
  Deviation noon;           ///< seconds, of the sun's transit between 60 degrees south and north
  Deviation riseAndSet;     ///< seconds, of the centre through the geometric horizon there
};
/// REQUIRES: options in their ranges.
[[nodiscard]] SelfCheck selfCheck(const SelfCheckOptions& options = {});

/// What selfCheck keeps to, for any options.
inline constexpr double kDirectionBound = 1e-4;   ///< degrees
inline constexpr double kRefractionBound = 0.02;  ///< degrees
inline constexpr double kCrossingBound = 0.1;     ///< seconds
[[nodiscard]] bool holds(const SelfCheck& check);

}  // namespace umbrage::sun
