#include "umbrage/outline/envelope.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "commands.hpp"
#include "inverse.hpp"
#include "map.hpp"
#include "moments.hpp"
#include "umbrage/report/colours.hpp"
#include "umbrage/study/georeference.hpp"
#include "umbrage/study/ledger.hpp"

namespace umbrage::cli {
namespace {

struct EnvelopeOptions {
  SceneOptions scene;
  PlaceOptions place;
  std::chrono::milliseconds from{0}, to{std::chrono::hours(24)};
  Angle leastElevation = Angle::degrees(3);
  double tolerance = 0.01;  ///< metres
  MapOptions map;
  bool merged = false;
  bool inverse = false;
  RuleOptions rule;
  std::optional<double> cell, most;
};

// What belongs to the other kind of envelope.
Result<void> checkKind(const EnvelopeOptions& o) {
  const RuleOptions& r = o.rule;
  const bool ruled = !r.preset.empty() || !r.baseline.empty() || !r.site.empty() || !r.areas.empty() ||
                     !r.points.empty() || !r.windows.empty() || !r.country.empty() || r.grid || r.height ||
                     r.leastAltitude || o.cell || o.most;
  if (ruled && !o.inverse) return fail(ErrorCode::usage, "presets, sites and columns belong to --inverse");
  return {};
}

Result<outline::SweepPeriod> periodOf(const EnvelopeOptions& options, const scene::Scene& scene,
                                      const sun::Place& place, double reach, const Console& console) {
  const auto span = spanOf(options.from, options.to, options.place, place, console);
  if (!span) return tl::unexpected(span.error());
  outline::SweepPeriod period{place, scene.northOffset, span->from, span->to, options.leastElevation, 1e-4};
  if (reach > 0.0) period.tolerance = options.tolerance / (reach * scene.metresPerUnit);
  return period;
}

// "08:12:03 to 15:40:11", with more stretches behind commas.
std::string stretches(const std::vector<outline::SlopePath>& paths, const EnvelopeOptions& options,
                      const sun::Place& place) {
  std::string text;
  for (const auto& path : paths)
    text += fmt::format("{}{} to {}", text.empty() ? "" : ", ", clockText(options.place, place, path.from),
                        clockText(options.place, place, path.to));
  return text;
}

std::chrono::milliseconds lengthOf(const std::vector<outline::SlopePath>& paths) {
  std::chrono::milliseconds length{0};
  for (const auto& path : paths) length += path.to - path.from;
  return length;
}

void addShadows(report::VectorMap& map, std::vector<outline::Shadow> shadows, const std::string& time,
                const std::string& date) {
  const double square = map.metresPerUnit * map.metresPerUnit;
  map.layers.push_back({"in shadow, " + time, report::timeColour(0.15)});
  for (outline::Shadow& shadow : shadows) {
    report::MapFeature feature{0, {}, {}};
    if (!shadow.name.empty()) feature.properties.emplace_back("name", shadow.name);
    feature.properties.emplace_back("time", time);
    feature.properties.emplace_back("date", date);
    feature.properties.emplace_back("area_m2", shadow.region.area * square);
    feature.region = std::move(shadow.region);
    map.features.push_back(std::move(feature));
  }
}

Result<Outcome> run(const EnvelopeOptions& options, const Console& console) {
  if (const auto fine = checkKind(options); !fine) return tl::unexpected(fine.error());
  if (options.inverse) {
    RuleOptions rule = options.rule;
    rule.plane = options.map.plane;
    return inverseVolume({options.scene, options.place, rule, options.cell, options.most, options.map.output}, console);
  }
  if (const auto open = checkMapFile(options.map, options.scene.file); !open) return tl::unexpected(open.error());
  const auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  if (const auto casts = checkCasts(*scene, options.scene); !casts) return tl::unexpected(casts.error());
  const auto place = placeOf(options.place, *scene, options.scene, console);
  if (!place) return tl::unexpected(place.error());
  const double plane = planeOf(options.map, *scene);
  const Box3 box = scene::bounds(*scene, true);
  const double reach = box.empty() ? 0.0 : study::mapHeight(box.max, scene->up) - plane;
  const auto period = periodOf(options, *scene, *place, reach, console);
  if (!period) return tl::unexpected(period.error());
  const auto paths = outline::slopePaths(*period);
  const double least = options.leastElevation.degrees();
  if (paths.empty())
    return fail(ErrorCode::usage,
                fmt::format("the sun is never {:g} degrees above the horizon from {} to {}; {}", least,
                            sun::timeText(options.from), sun::timeText(options.to), sunTimes(options.place, *place)));
  const std::string when = stretches(paths, options, *place);
  if (lengthOf(paths) < period->to - period->from)
    console.warn(fmt::format("only while the sun is at least {:g} degrees high (--min-elevation): {}", least, when));

  const auto casters = outline::castersOf(*scene);
  auto envelope = outline::sweepShadows(
      casters, plane, paths, options.merged ? outline::Grouping::merged : outline::Grouping::parts, console.progress());
  if (!envelope) return tl::unexpected(envelope.error());
  const double bound = envelope->bound * scene->metresPerUnit;
  auto map =
      mapOf(*scene, casters, plane, *place, options.place,
            offsetsText(options.place, *place, {paths.front().from, paths.back().to}),
            {"Shadow envelope",
             fmt::format("declination moving (ERFA), at least {:g} degrees high", least),
             options.merged ? "envelope --merged" : "envelope, part by part",
             {{"Period", when},
              {"Error bound",
               fmt::format("the border is within {:.2g} m of the exact one; nothing is sampled in time", bound)}}},
            options.scene.casters);
  if (!map) return tl::unexpected(map.error());
  double area = 0.0;
  for (const auto& shadow : envelope->shadows) area += shadow.region.area * scene->metresPerUnit * scene->metresPerUnit;
  const auto count = envelope->shadows.size();
  addShadows(*map, std::move(envelope->shadows), when, sun::dateText(options.place.date));
  if (const auto written = write(*map, options.map); !written) return tl::unexpected(written.error());
  return Outcome{
      fmt::format("{}\n{}  {:.1f} m2{}, border within {:.2g} m\n", options.map.output, when, area,
                  options.merged ? "" : fmt::format(" in {} parts (overlaps counted for each)", count), bound),
      0};
}

}  // namespace

Run addEnvelope(CLI::App& app) {
  const auto options = std::make_shared<EnvelopeOptions>();
  constexpr Manner time{.group = "Place and time"};
  addSceneOptions(app, options->scene);
  addPlaceOptions(app, options->place, PlaceFrom::scene);
  addValue(app, "--from", "HH:MM", "The beginning of the period (default 00:00)", options->from, sun::parseTime, time);
  addValue(app, "--to", "HH:MM", "Its end (default 24:00)", options->to, sun::parseTime, time);
  addValue(
      app, "--min-elevation", "DEG",
      "Only while the sun is so high, 0.1 to 90 (default 3); at the horizon shadows have no end",
      options->leastElevation, [](const std::string& word) { return parseDegrees(word, 0.1, 90); }, time);
  addValue(app, "--tolerance", "M", "How far the border may be from the exact one, in metres (default 0.01)",
           options->tolerance, [](const std::string& word) { return parseNumber(word, 1e-5, 1e3); });
  addMapOptions(app, options->map);
  addFlag(app, "--merged", "One outline for all parts together", options->merged);
  addFlag(app, "--inverse",
          "The tallest volume on a site that still passes a preset; -o may be a model (.glb, .obj, ..) too",
          options->inverse);
  addRuleOptions(app, options->rule, false);
  const auto metres = [](const std::string& word) { return parseNumber(word, 1e-3, 1e4); };
  addValue(app, "--cell", "M", "With --inverse: from column to column, in metres (default: a hundred columns)",
           options->cell, metres, {.group = "Rule"});
  addValue(app, "--max-height", "M", "With --inverse: nothing grows higher (default 100)", options->most, metres,
           {.group = "Rule"});
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
