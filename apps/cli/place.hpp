#pragma once

#include "options.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::cli {

/// PLACE+TIME of a study.
struct PlaceOptions {
  std::optional<double> latitude, longitude;  ///< degrees
  std::chrono::year_month_day date{};
  sun::Zone zone;
};

/// Whether a command may take the place from its scene, or do without any place and day (`nobody`: then without --date the day is not ok(), and without
/// --tz the zone has no name).
enum class PlaceFrom { options, scene, nobody };

/// --lat, --lon, --date and --tz, all required, but the first two where the scene may say the place.
void addPlaceOptions(CLI::App& app, PlaceOptions& options, PlaceFrom from = PlaceFrom::options);

/// REQUIRES: declared with PlaceFrom::options.
[[nodiscard]] Result<sun::Place> placeOf(const PlaceOptions& options);

/// The place given, with a warning where it is far from the scene's own; else the scene's own. A warning also where true north is
/// not the scene's and nobody has spoken of north. Errors: usage, where neither says it.
[[nodiscard]] Result<sun::Place> placeOf(const PlaceOptions& options, const scene::Scene& scene,
                                         const SceneOptions& sceneOptions, const Console& console);

}  // namespace umbrage::cli
