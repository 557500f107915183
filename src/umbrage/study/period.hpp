#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::study {

/// When and where a study looks at the sun: a part of one day, by the clock of `zone`, in steps.
struct Period {
  sun::Place place;
  sun::Zone zone;
  std::chrono::year_month_day date;
  std::chrono::milliseconds from{0};  ///< what the clock shows, 00:00 to 24:00
  std::chrono::milliseconds to{0};
  std::chrono::milliseconds step{0};
};

/// One moment of a period.
struct PeriodStep {
  sun::Instant instant;
  std::string label;  ///< what the clock shows: "12:30"; with "CEST" or the like where clocks change in the period
  std::chrono::milliseconds share{0};  ///< the time this step stands for
  sun::SunPosition sun;                ///< centre, geometric
  [[nodiscard]] bool sunIsUp() const { return sun.elevation > Angle{}; }
};

struct PeriodSteps {
  std::vector<PeriodStep> steps;
  std::string offset;                 ///< how the clock stands to UTC: "UTC+02:00 (CEST)"
  std::vector<std::string> warnings;  ///< readings that occur twice
};

inline constexpr std::size_t kMostSteps = 1440;

/// The moments of a period.
/// 1. The first is `from`; they follow each other by `step` of elapsed time (in solar time: of the sundial's); `to` is
/// one of them
///    when it falls on a step, otherwise the last comes before it.
/// 2. Each stands for the time of the period that is nearer to it than to the others; the shares add up to the period
/// exactly. Errors: usage where the period is empty or runs backwards, the step is not positive or makes more than
/// kMostSteps, and those of sun::instantOf.
[[nodiscard]] Result<PeriodSteps> stepsOf(const Period& period);

}  // namespace umbrage::study
