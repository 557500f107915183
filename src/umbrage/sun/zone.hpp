#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "umbrage/base/error.hpp"
#include "umbrage/sun/sun.hpp"

namespace umbrage::sun {

/// What the clock shows: the legal time of an IANA zone, a fixed offset from UTC, or true solar time.
struct Zone {
  enum class Kind { named, fixed, solar };
  Kind kind = Kind::fixed;
  std::string name = "+00:00";     ///< as it was asked for: "Europe/Vienna", "+01:00", "solar"
  std::chrono::minutes offset{0};  ///< east of Greenwich positive; of fixed zones only
};

/// A reading of a clock: a date and a time since its midnight, [0, 24] h. On the day of a change of clocks it is what
/// the clock shows, not what has passed since midnight.
struct ClockTime {
  std::chrono::year_month_day date;
  std::chrono::milliseconds time{0};
  friend bool operator==(const ClockTime&, const ClockTime&) = default;
};

/// An instant, and what the user must know about how it was found.
struct Moment {
  Instant instant;
  std::optional<std::string> warning;
};

/// What times rest on, for ledgers: "ERFA 2.0.0", and for named zones the release of the time zones too, "tzdata 2025b".
[[nodiscard]] std::string versions(const Zone& zone);

/// What a clock shows at an instant.
struct ClockReading {
  ClockTime clock;
  std::chrono::seconds offset{0};  ///< clock minus UTC
  std::string abbreviation;        ///< "CEST"; empty where the zone has none
};

inline constexpr int kFirstYear = 1900;
inline constexpr int kLastYear = 2100;

/// "Europe/Vienna", "UTC", "+01:00", "-03:30", "Z" or "solar". Errors: usage, with the names that come near.
[[nodiscard]] Result<Zone> parseZone(std::string_view text);

/// YYYY-MM-DD, a real day of the years 1900..2100. Errors: usage.
[[nodiscard]] Result<std::chrono::year_month_day> parseDate(std::string_view text);

/// HH:MM or HH:MM:SS from 00:00 to 24:00. Errors: usage.
[[nodiscard]] Result<std::chrono::milliseconds> parseTime(std::string_view text);

/// Degrees in decimal notation, latitude in [-90, 90], longitude in [-180, 180] (360 is taken off above 180 up to 360).
/// Errors: usage.
[[nodiscard]] Result<Place> makePlace(double latitudeDegrees, double longitudeDegrees);

/// The instant at which the clock of `zone` shows `clock`; `place` matters for solar time only.
/// 1. Solar time: the hour angle of the true sun is 15 degrees x (hours - 12); its day is the one nearest to the UTC
/// day shifted
///    by the longitude.
/// 2. A reading that occurs twice, as clocks are put back, means the first; a warning says so.
/// 3. After 2037 the rules of 2027..2037 go on, where the system's zone table ends there.
/// Errors: usage for a reading that clocks put forward leave out.
[[nodiscard]] Result<Moment> instantOf(const Zone& zone, const Place& place, const ClockTime& clock);

/// Which of the two moments a reading means that occurs twice.
enum class Twice { first, second };

/// As instantOf, for borders of a stretch of time that must not fail: a reading that clocks put forward leave out is the moment at which they
/// are put forward, and one that occurs twice is the one asked for. The warning says what was taken.
[[nodiscard]] Moment nearestInstantOf(const Zone& zone, const Place& place, const ClockTime& clock, Twice twice);

/// What the clock of `zone` shows at `instant`.
[[nodiscard]] ClockReading clockAt(const Zone& zone, const Place& place, Instant instant);

/// "2026-09-18".
[[nodiscard]] std::string dateText(std::chrono::year_month_day date);
/// "09:05", with seconds (rounded to whole ones) where they are not zero.
[[nodiscard]] std::string timeText(std::chrono::milliseconds time);
/// "+05:30".
[[nodiscard]] std::string offsetText(std::chrono::seconds offset);
/// "UTC+02:00 (CEST)"; zones without letters of their own have none here.
[[nodiscard]] std::string offsetText(const ClockReading& reading);

}  // namespace umbrage::sun
