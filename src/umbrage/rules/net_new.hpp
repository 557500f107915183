#pragma once

#include <string>
#include <vector>

#include "umbrage/outline/shadow.hpp"
#include "umbrage/rules/verify.hpp"

// The shadow that a proposal adds to what stands: its shape, how long it lies where, and whose it is.
namespace umbrage::rules {

/// The new shadow at one moment, of the areas, or of all the plane where none are given.
struct NewShadow {
  sun::Instant at;
  outline::Region region;
  std::vector<outline::Shadow> byBuilding;  ///< may overlap each other; those with new shadow only
};

/// A stretch of time during which new shadow of one building (or of all: no name) lies on an area.
struct Visit {
  std::string building;
  study::TimeSpan span;
  double most = 0.0;  ///< the largest part of the area in that shadow, m2
  sun::Instant mostAt;
};

/// What one area, or the plane, gets.
struct AreaNews {
  std::string area;
  double size = 0.0;          ///< m2; 0 for the whole plane
  double areaHours = 0.0;     ///< of all buildings together, m2 x h
  std::vector<Visit> all;     ///< by any building
  std::vector<Visit> visits;  ///< building by building, in the order in which they begin
};

struct NetNew {
  std::vector<std::string> added;  ///< the buildings that the baseline does not have
  std::vector<NewShadow> moments;
  std::vector<AreaNews> areas;
};

struct NetNewOptions {
  double height = 0.0;                 ///< of the plane, in the scene's unit
  std::vector<study::TimeSpan> times;  ///< when it counts; ascending, apart
  std::vector<Area> areas;             ///< empty: all of the plane
  std::vector<sun::Instant> moments;   ///< of these the shape is kept; the sun must be up
  study::SunModel sun;
  /// The sun must be so high: at the horizon shadows have no end.
  Angle leastElevation = Angle::degrees(0.5);
  bool byBuilding = true;  ///< false: `visits` stay empty, which saves most of the time
};

/// The difference of two scenes' shadows on a horizontal plane. Buildings are outline::castersOf's; one is added where the baseline has none of
/// its name and triangles.
/// 1. Shapes are exact as outline::newShadow's: united and subtracted on whole numbers.
/// 2. Visits begin and end within 0.1 s of the moment at which the shape appears or is gone. What comes and goes within kLook is not missed
///    where one of the looks in between sees it.
/// 3. areaHours are the integral of the area over time by Simpson's rule, refined until it changes by less than 1e-6 of the whole.
/// Errors: usage (nothing is added), cancelled.
[[nodiscard]] Result<NetNew> netNew(const scene::Scene& proposal, const scene::Scene& baseline, const sun::Place& place,
                                    const NetNewOptions& options, const ProgressSink& progress = {});

/// When new shadow lies on points, and whose it is: one entry a receiver, its size 0 and its area-hours hours.
/// 1. Exact as study::ExactHours; stretches shorter than kShortestNew are left out. Errors: as netNew.
[[nodiscard]] Result<std::vector<AreaNews>> newOnPoints(const scene::Scene& proposal, const scene::Scene& baseline,
                                                        const sun::Place& place, const study::ReceiverSet& points,
                                                        const std::vector<study::TimeSpan>& times,
                                                        const study::SunModel& sun = {},
                                                        const ProgressSink& progress = {});

/// The days worth telling of a verdict, those of the measure that decides it (decidingOf), ascending: all where they are few, else those that decide
/// for an area by it; of shares of new shadow, which no day decides, those nearest to equinoxes and solstices, and the day with most where only
/// outlines show any. At most kMostNewsDays, and one.
inline constexpr std::size_t kMostNewsDays = 4;
[[nodiscard]] std::vector<std::chrono::year_month_day> newsDates(const Verdict& verdict, const VerifyRequest& request);

/// How often visits are looked for.
inline constexpr std::chrono::milliseconds kLook{30'000};

}  // namespace umbrage::rules
