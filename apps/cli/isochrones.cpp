#include "umbrage/outline/isochrones.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "commands.hpp"
#include "map.hpp"
#include "moments.hpp"
#include "umbrage/report/colours.hpp"
#include "umbrage/study/ledger.hpp"

namespace umbrage::cli {
namespace {

using std::chrono::milliseconds;

struct IsochroneOptions {
  SceneOptions scene;
  PlaceOptions place;
  milliseconds from{0}, to{std::chrono::hours(24)};
  std::vector<double> hours;
  bool shadow = false;
  std::optional<double> tolerance;  ///< metres
  MapOptions map;
};

// Of the width of the scene, where no tolerance is given.
constexpr double kShare = 1.0 / 2000.0;
constexpr double kFinest = 0.1;
constexpr int kCoarser = 16;

Result<std::vector<double>> parseHours(const std::string& word) {
  std::vector<double> hours;
  for (const auto part : split(word, ',')) {
    const auto value = parseNumber(part, 0.0, 24.0);
    if (!value) return tl::unexpected(value.error());
    if (*value <= 0.0) return fail(ErrorCode::usage, fmt::format("'{}' is no number of hours above 0", part));
    hours.push_back(*value);
  }
  std::sort(hours.begin(), hours.end());
  hours.erase(std::unique(hours.begin(), hours.end()), hours.end());
  return hours;
}

double hoursOf(milliseconds time) { return double(time.count()) / 3.6e6; }

// In the scene's unit.
double toleranceOf(const IsochroneOptions& options, const scene::Scene& scene) {
  const Vec3 size = scene::bounds(scene, true).size();
  const double width = std::max({size.x, size.y, size.z}) * scene.metresPerUnit;
  return options.tolerance.value_or(std::max(kFinest, kShare * width)) / scene.metresPerUnit;
}

void addRegions(report::VectorMap& map, const outline::IsochroneOptions& options, outline::Isochrones& found) {
  const char* what = options.of == outline::HoursOf::sun ? "sun" : "shadow";
  const double square = map.metresPerUnit * map.metresPerUnit;
  for (std::size_t i = 0; i < found.regions.size(); ++i) {
    const double hours = hoursOf(options.levels[i]);
    const double t = (double(i) + 1.0) / (double(found.regions.size()) + 1.0);
    map.layers.push_back({fmt::format("at least {:g} h of {}", hours, what),
                          options.of == outline::HoursOf::sun ? report::timeColour(0.35 + 0.65 * t)
                                                              : report::heatColour(0.15 + 0.75 * t),
                          1.0});
    report::MapFeature feature{i, std::move(found.regions[i]), {}};
    feature.properties = {{"hours", hours}, {"of", std::string(what)}, {"area_m2", feature.region.area * square}};
    map.features.push_back(std::move(feature));
  }
}

std::string boundText(const outline::Isochrones& found, double tolerance) {
  return fmt::format(
      "borders are within {:.3g} m of the exact ones; of {} random points {} lie on another side than their exact "
      "hours and farther from a border",
      tolerance, found.checked, found.wrong == 0 ? "none" : std::to_string(found.wrong));
}

Result<Outcome> run(const IsochroneOptions& options, const Console& console) {
  if (const auto open = checkMapFile(options.map, options.scene.file); !open) return tl::unexpected(open.error());
  const auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  if (const auto casts = checkCasts(*scene, options.scene); !casts) return tl::unexpected(casts.error());
  const auto place = placeOf(options.place, *scene, options.scene, console);
  if (!place) return tl::unexpected(place.error());
  const auto span = spanOf(options.from, options.to, options.place, *place, console);
  if (!span) return tl::unexpected(span.error());
  const auto course = study::SunCourse::make(*place, *span);
  if (course.up().empty())
    return fail(ErrorCode::usage,
                fmt::format("the sun is below the horizon all the time; {}", sunTimes(options.place, *place)));
  const auto hours = study::ExactHours::build(*scene, *place);
  if (!hours) return tl::unexpected(hours.error());

  outline::IsochroneOptions wanted{options.shadow ? outline::HoursOf::shadow : outline::HoursOf::sun,
                                   {},
                                   planeOf(options.map, *scene),
                                   toleranceOf(options, *scene)};
  for (const double level : options.hours) wanted.levels.emplace_back(std::llround(level * 3.6e6));
  if (wanted.levels.back() > course.upTime())
    console.warn(fmt::format("the sun is up for {:.2f} h only: levels above that are empty", hoursOf(course.upTime())));
  auto found = outline::isochrones(*scene, *hours, course, wanted, console.progress());
  // A tolerance that nobody asked for gives way to the size of the map.
  for (int n = 0; n < kCoarser && !found && found.error().code == ErrorCode::usage && !options.tolerance; ++n) {
    wanted.tolerance *= 2.0;
    found = outline::isochrones(*scene, *hours, course, wanted, console.progress());
  }
  if (!found) return tl::unexpected(found.error());
  if (found->cutOff) console.warn("borders go on beyond the map, which ends at 40 heights of the scene");
  const double tolerance = wanted.tolerance * scene->metresPerUnit;
  console.detail(fmt::format("{} exact hours worked out", found->samples));

  auto map = mapOf(*scene, outline::castersOf(*scene), wanted.height, *place, options.place,
                   offsetsText(options.place, *place, *span),
                   {options.shadow ? "Hours of shadow" : "Hours of sun",
                    "declination moving (ERFA), horizon at 0 degrees",
                    "isochrones of exact hours",
                    {{"Period", fmt::format("{} to {}, the sun is up for {:.3f} h", sun::timeText(options.from),
                                            sun::timeText(options.to), hoursOf(course.upTime()))},
                     {"Error bound", boundText(*found, tolerance)}}},
                   options.scene.casters);
  if (!map) return tl::unexpected(map.error());
  std::string text = options.map.output + "\n";
  addRegions(*map, wanted, *found);
  for (std::size_t i = 0; i < map->features.size(); ++i)
    text += fmt::format("{}  {:.1f} m2\n", map->layers[i].name,
                        map->features[i].region.area * scene->metresPerUnit * scene->metresPerUnit);
  text += boundText(*found, tolerance) + "\n";
  if (const auto written = write(*map, options.map); !written) return tl::unexpected(written.error());
  return Outcome{text, 0};
}

}  // namespace

Run addIsochrones(CLI::App& app) {
  const auto options = std::make_shared<IsochroneOptions>();
  constexpr Manner time{.group = "Place and time"};
  addSceneOptions(app, options->scene);
  addPlaceOptions(app, options->place, PlaceFrom::scene);
  addValue(app, "--from", "HH:MM", "The beginning of the period (default 00:00)", options->from, sun::parseTime, time);
  addValue(app, "--to", "HH:MM", "Its end (default 24:00)", options->to, sun::parseTime, time);
  addValue(app, "--hours", "H,H,..", "The levels, in hours", options->hours, parseHours, {.required = true});
  addFlag(app, "--shadow", "Hours of shadow while the sun is up, not of sun", options->shadow);
  addValue(app, "--tolerance", "M",
           "How far borders may be from the exact ones, in metres (default: a 2000th of the scene, at least 0.1)",
           options->tolerance, [](const std::string& word) { return parseNumber(word, 1e-3, 1e4); });
  addMapOptions(app, options->map);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
