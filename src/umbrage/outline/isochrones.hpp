#pragma once

#include <chrono>
#include <vector>

#include "umbrage/outline/region.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/exact_hours.hpp"

namespace umbrage::outline {

enum class HoursOf { sun, shadow };

struct IsochroneOptions {
  HoursOf of = HoursOf::sun;
  /// Ascending, above 0; of the time when the sun is up.
  std::vector<std::chrono::milliseconds> levels;
  double height = 0.0;     ///< of the plane, in the scene's unit
  double tolerance = 0.5;  ///< how far a border may be from the exact one, in the scene's unit; above 0
  /// So many points are looked at to find what was missed; where a border is missing or wrong, the map is refined.
  std::size_t checks = 10'000;
};

/// The parts of a horizontal plane that have at least so many hours.
struct Isochrones {
  std::vector<Region> regions;  ///< one a level; each holds the next
  Vec2 min{0.0}, max{0.0};      ///< the rectangle that was looked at, (east, north); the regions end there
  bool cutOff = false;          ///< borders go on beyond it
  std::size_t samples = 0;      ///< exact hours worked out
  std::size_t checked = 0;      ///< points looked at, at the end, ...
  std::size_t wrong = 0;        ///< ... and how many of them broke law 2
};

/// The isochrones of exact hours (study::ExactHours) on a plane.
/// 1. Every border passes between two points, nearer than `tolerance`, whose exact hours are on its two sides.
/// 2. A point farther than `tolerance` from every border has its exact hours on the side that the map says; what is smaller than 8 times the
///    tolerance may be missed, and is sought by `checks` random points (the same each time).
/// 3. Inside closed solids there is no sun.
/// REQUIRES: levels ascending and above 0, tolerance > 0, a course over the hours' place. Errors: usage (too fine for so large a
/// scene), cancelled.
[[nodiscard]] Result<Isochrones> isochrones(const scene::Scene& scene, const study::ExactHours& hours,
                                            const study::SunCourse& course, const IsochroneOptions& options,
                                            const ProgressSink& progress = {});

}  // namespace umbrage::outline
