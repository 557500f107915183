#pragma once

#include <optional>

#include "place.hpp"
#include "umbrage/study/period.hpp"
#include "umbrage/study/sun_course.hpp"

namespace umbrage::cli {

/// Which moments of a day: single ones (--at, repeatable), or a period in steps (--from, --to, --step).
struct MomentOptions {
  std::vector<std::chrono::milliseconds> at;
  std::optional<std::chrono::milliseconds> from, to, step;
};
void addMomentOptions(CLI::App& app, MomentOptions& options);

/// A number of minutes above 0.
[[nodiscard]] Result<std::chrono::milliseconds> parseStep(const std::string& word);

/// The moments at which the sun is up, in order; a warning counts the others. Errors: usage, where none is named or the sun is down
/// at all of them (with the times of its rise and set).
[[nodiscard]] Result<study::PeriodSteps> momentsOf(const MomentOptions& options, const PlaceOptions& when,
                                                   const sun::Place& place);

/// A period of a day by the clock, with the clock's warnings shown. Errors: usage, where it is empty or runs backwards, or the clock
/// leaves a border out.
[[nodiscard]] Result<study::TimeSpan> spanOf(std::chrono::milliseconds from, std::chrono::milliseconds to,
                                             const PlaceOptions& when, const sun::Place& place, const Console& console);
/// How the clock stands to UTC in a span, for ledgers: "UTC+01:00 (CET), then UTC+02:00 (CEST)".
[[nodiscard]] std::string offsetsText(const PlaceOptions& when, const sun::Place& place, const study::TimeSpan& span);
/// What the clock shows at an instant of a period; at its end, midnight is 24:00.
[[nodiscard]] std::string clockText(const PlaceOptions& when, const sun::Place& place, sun::Instant instant);

/// When the sun rises and sets, as a sentence: "it rises at 05:12 and sets at 19:40 (Europe/Vienna)".
[[nodiscard]] std::string sunTimes(const PlaceOptions& when, const sun::Place& place);

}  // namespace umbrage::cli
