#include "umbrage/outline/shadow.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include "map.hpp"
#include "moments.hpp"
#include "umbrage/report/colours.hpp"

namespace umbrage::cli {
namespace {

struct OutlineOptions {
  SceneOptions scene;
  PlaceOptions place;
  MomentOptions moments;
  MapOptions map;
  bool merged = false;
};

using Shadows = std::vector<std::vector<outline::Shadow>>;

double areaOf(const std::vector<outline::Shadow>& shadows) {
  double area = 0.0;
  for (const auto& shadow : shadows) area += shadow.region.area;
  return area;
}

// The first moment has the first colour of the day, the last the last.
image::Rgb8 colourOf(std::size_t moment, std::size_t moments) {
  return report::timeColour(moments < 2 ? 0.35 : double(moment) / double(moments - 1));
}

void addShadows(report::VectorMap& map, const study::PeriodStep& moment, std::vector<outline::Shadow> shadows,
                const std::string& date) {
  const double square = map.metresPerUnit * map.metresPerUnit;
  for (outline::Shadow& shadow : shadows) {
    report::MapFeature feature{map.layers.size() - 1, {}, {}};
    if (!shadow.name.empty()) feature.properties.emplace_back("name", shadow.name);
    feature.properties.emplace_back("time", moment.label);
    feature.properties.emplace_back("date", date);
    feature.properties.emplace_back("area_m2", shadow.region.area * square);
    feature.properties.emplace_back("sun_elevation", moment.sun.elevation.degrees());
    feature.properties.emplace_back("sun_azimuth", moment.sun.azimuth.degrees());
    feature.region = std::move(shadow.region);
    map.features.push_back(std::move(feature));
  }
}

std::string summary(const study::PeriodStep& moment, const std::vector<outline::Shadow>& shadows, double square,
                    bool merged) {
  const auto polygons = merged && !shadows.empty() ? shadows[0].region.polygons.size() : shadows.size();
  return fmt::format("{}  sun {:6.2f} up, azimuth {:6.2f}  shadow {:.1f} m2{}, {} {}\n", moment.label,
                     moment.sun.elevation.degrees(), moment.sun.azimuth.degrees(), areaOf(shadows) * square,
                     merged ? "" : " (overlaps counted for each part)", polygons, merged ? "polygons" : "parts");
}

Result<Outcome> run(const OutlineOptions& options, const Console& console) {
  if (const auto open = checkMapFile(options.map, options.scene.file); !open) return tl::unexpected(open.error());
  const auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  if (const auto casts = checkCasts(*scene, options.scene); !casts) return tl::unexpected(casts.error());
  const auto place = placeOf(options.place, *scene, options.scene, console);
  if (!place) return tl::unexpected(place.error());
  const auto moments = momentsOf(options.moments, options.place, *place);
  if (!moments) return tl::unexpected(moments.error());
  for (const auto& warning : moments->warnings) console.warn(warning);

  Stopwatch watch;
  const auto casters = outline::castersOf(*scene);
  const double plane = planeOf(options.map, *scene);
  std::vector<Vec2> slopes;
  for (const auto& moment : moments->steps) slopes.push_back(outline::shadowSlope(moment.sun, scene->northOffset));
  const auto grouping = options.merged ? outline::Grouping::merged : outline::Grouping::parts;
  auto shadows = outline::shadowsOnPlane(casters, plane, slopes, grouping, console.progress());
  if (!shadows) return tl::unexpected(shadows.error());
  console.detail(fmt::format("shadows    {:.0f} ms", watch.lap()));

  auto map =
      mapOf(*scene, casters, plane, *place, options.place, moments->offset,
            {"Shadow outlines",
             "declination of each moment (ERFA)",
             options.merged ? "outline --merged" : "outline, part by part",
             {{"Exactness", "union of the projected triangles; corners within 2^-29 of the size of what is united"}}},
            options.scene.casters);
  if (!map) return tl::unexpected(map.error());
  const double square = scene->metresPerUnit * scene->metresPerUnit;
  std::string text = options.map.output + "\n";
  for (std::size_t i = 0; i < shadows->size(); ++i) {
    const auto& moment = moments->steps[i];
    map->layers.push_back({moment.label, colourOf(i, shadows->size())});
    text += summary(moment, (*shadows)[i], square, options.merged);
    addShadows(*map, moment, std::move((*shadows)[i]), sun::dateText(options.place.date));
  }
  if (const auto written = write(*map, options.map); !written) return tl::unexpected(written.error());
  console.detail(fmt::format("written    {:.0f} ms", watch.lap()));
  return Outcome{text, 0};
}

}  // namespace

Run addOutline(CLI::App& app) {
  const auto options = std::make_shared<OutlineOptions>();
  addSceneOptions(app, options->scene);
  addPlaceOptions(app, options->place, PlaceFrom::scene);
  addMomentOptions(app, options->moments);
  addMapOptions(app, options->map);
  addFlag(app, "--merged", "One outline for all parts together", options->merged);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
