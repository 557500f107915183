#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/study/sun_course.hpp"

// What a regulation of sunlight asks, as plain data: read from JSON (rule_file.hpp), held against a scene by verify.hpp.
namespace umbrage::rules {

/// Which clock the times of a rule are read from.
enum class Clock {
  solar,     ///< true solar time
  zone,      ///< the clock of the place, with daylight saving where it is in force
  standard,  ///< the same without daylight saving
};

/// The days that a rule looks at, of the year it is asked for.
struct Days {
  enum class Kind {
    dates,  ///< days of the calendar
    longitudes,  ///< the days on which the sun's apparent longitude passes so many degrees: 270 is the December solstice, 300 Dahan
    range,  ///< all days from one date to another, both included; may pass New Year
    given,  ///< the date that is asked for
  };
  Kind kind = Kind::given;
  std::vector<std::chrono::month_day> dates;  ///< of ranges the first and the last
  std::vector<Angle> longitudes;              ///< [0, 360) degrees
  int every = 1;                              ///< of ranges every so many days, the last one always
  /// One day that suits is enough, the same for all receivers, by all of the requirement; else each day counts. REQUIRES: the requirement has
  /// one measure.
  bool best = false;
};

/// The part of a day that counts: what all of its limits leave.
struct Window {
  Clock clock = Clock::solar;
  std::optional<std::chrono::milliseconds> from, to;  ///< by the clock, 00:00 to 24:00
  /// From so long after sunrise until so long before sunset, both as almanacs have them: the upper limb with refraction, the centre 0.833
  /// degrees below the horizon.
  std::optional<std::chrono::milliseconds> afterSunrise, beforeSunset;
};

/// What is added up at a receiver.
enum class Statistic {
  sun,         ///< all of the sun
  longestSun,  ///< the longest stretch of sun
  shadow,      ///< shadow while the sun counts
  newShadow,   ///< shadow where the baseline has sun; stretches below kShortestNew are left out
};

/// Two scenes are solved apart, each within a fraction of a second: shorter stretches of new shadow are rounding.
inline constexpr std::chrono::milliseconds kShortestNew{1000};

enum class Comparison { atLeast, moreThan, atMost, lessThan };

struct Measure {
  std::string name;  ///< "4 h in all"
  Days days;
  Window window;
  std::optional<Angle> leastAltitude;  ///< lower sun does not count
  Statistic statistic = Statistic::sun;
  std::chrono::milliseconds leastRun{0};  ///< of sun: shorter stretches do not count
  Comparison comparison = Comparison::atLeast;
  std::chrono::milliseconds threshold{0};
};

/// Receivers by their distance from the site, in metres.
struct Band {
  double from = 0.0;
  std::optional<double> to;
};

/// What a share of the receivers must have.
struct Requirement {
  std::string name;
  std::vector<Measure> anyOf;  ///< a receiver passes where one of them holds; never empty
  std::optional<Band> band;    ///< only these receivers
  double share = 1.0;          ///< of the receivers, by area, that must pass
  /// Less than `share` will do while it is at least this times the share that passes in the baseline.
  std::optional<double> former;
  /// Instead of shares: the hours of new shadow times area, of all hours times area that count, at most so many parts.
  std::optional<double> mostNew;
};

enum class Hemisphere { both, north, south };

/// Where a rule wants its receivers.
enum class ReceiverKind {
  points,  ///< windows, or any points with a normal
  areas,   ///< open spaces
  site,    ///< around the boundary of a site
};

/// Which parts of a scene cast for a rule.
enum class CastersOf { scene, site };

struct Rule {
  std::string name, title, source, where;
  Hemisphere hemisphere = Hemisphere::both;
  ReceiverKind receivers = ReceiverKind::points;
  double height = 0.0;  ///< of receivers in areas and around sites, metres above the ground
  CastersOf casters = CastersOf::scene;
  study::SunModel sun;
  bool fixedDeclination = false;          ///< the declination of a day's noon for all of the day
  std::vector<Requirement> requirements;  ///< all must hold; never empty
  /// Least altitudes by country, for measures without one; empty where the rule has none.
  std::vector<std::pair<std::string, Angle>> altitudeByCountry;
  std::vector<std::string> notes;
  std::vector<std::string> checked;    ///< public texts that figures were held against, with addresses
  std::vector<std::string> uncertain;  ///< what no text has settled
};

/// A requirement speaks of what the baseline has, and means nothing without one.
[[nodiscard]] bool needsBaseline(const Rule& rule);

/// The least altitude of a country ("DE"), or one that is given. Errors: usage, where the rule has no figure for the country (with those
/// it has) or wants neither.
[[nodiscard]] Result<Rule> withCountry(Rule rule, const std::string& country);
[[nodiscard]] Rule withLeastAltitude(Rule rule, Angle altitude);

}  // namespace umbrage::rules
