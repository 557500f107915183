#include "place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "umbrage/geo/projection.hpp"
#include "umbrage/study/georeference.hpp"
#include "umbrage/study/ledger.hpp"

namespace umbrage::cli {
namespace {

// Nearer than this a place is taken for the scene's own town.
constexpr double kNear = 20e3;
// A twentieth of a degree turns a shadow of 100 m by 9 cm.
constexpr double kSlightTurn = 0.05;

double distance(const sun::Place& a, const sun::Place& b) {
  return geo::distance({a.longitude.degrees(), a.latitude.degrees()}, {b.longitude.degrees(), b.latitude.degrees()});
}

void warnOfDistance(const sun::Place& given, const study::Georeference& own, const Console& console) {
  const double far = distance(given, own.place);
  if (far > std::max(kNear, 2.0 * own.reach))
    console.warn(fmt::format("--lat and --lon are {:.0f} km from where the scene says it stands ({})", far / 1e3,
                             study::placeText(own.place)));
}

void warnOfNorth(const study::Georeference& own, const SceneOptions& options, const std::string& crs,
                 const Console& console) {
  const double turn = own.trueNorth.degrees();
  if (options.north || options.trueNorth || std::abs(turn) < kSlightTurn) return;
  console.warn(fmt::format(
      "north is the y axis of {}; true north lies {:.2f} degrees clockwise of it here (--north true)", crs, turn));
}

}  // namespace

void addPlaceOptions(CLI::App& app, PlaceOptions& options, PlaceFrom from) {
  const bool optional = from != PlaceFrom::options;
  const Manner place{.group = "Place and time", .required = !optional};
  const std::string orScene = optional ? " (default: where the scene says it stands)" : "";
  const Manner manner{.group = "Place and time", .required = from != PlaceFrom::nobody};
  if (from == PlaceFrom::nobody) options.zone.name.clear();
  const auto degrees = [](double limit) {
    return [limit](const std::string& word) { return parseNumber(word, -limit, limit); };
  };
  addValue(app, "--lat", "DEG", "Latitude, north positive" + orScene, options.latitude, degrees(90), place);
  addValue(app, "--lon", "DEG", "Longitude, east positive" + orScene, options.longitude, degrees(180), place);
  addValue(app, "--date", "YYYY-MM-DD", "The day", options.date, sun::parseDate, manner);
  addValue(app, "--tz", "ZONE", "The clock: Europe/Vienna, +01:00, or solar (true solar time)", options.zone,
           sun::parseZone, manner);
}

Result<sun::Place> placeOf(const PlaceOptions& options) {
  return sun::makePlace(options.latitude.value_or(0.0), options.longitude.value_or(0.0));
}

Result<sun::Place> placeOf(const PlaceOptions& options, const scene::Scene& scene, const SceneOptions& sceneOptions,
                           const Console& console) {
  if (options.latitude.has_value() != options.longitude.has_value())
    return fail(ErrorCode::usage, "--lat and --lon belong together");
  const auto own = study::georeferenceOf(scene);
  if (!own && !options.latitude)
    return fail(ErrorCode::usage, fmt::format("--lat and --lon are missing, and the scene {}", own.error().message));
  if (own) warnOfNorth(*own, sceneOptions, scene.crs, console);
  if (!options.latitude) return own->place;
  const auto given = placeOf(options);
  if (given && own) warnOfDistance(*given, *own, console);
  return given;
}

}  // namespace umbrage::cli
