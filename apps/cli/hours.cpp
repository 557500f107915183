#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "commands.hpp"
#include "moments.hpp"
#include "outputs.hpp"
#include "place.hpp"
#include "umbrage/io/raster.hpp"
#include "umbrage/report/write_hours.hpp"

namespace umbrage::cli {
namespace {

using std::chrono::milliseconds;

struct HoursOptions {
  SceneOptions scene;
  PlaceOptions place;
  milliseconds from{0}, to{std::chrono::hours(24)};
  std::optional<std::chrono::year_month_day> until;
  bool year = false;
  std::string points, output;
  std::optional<double> grid, plane;
  std::optional<double> above;
  std::vector<std::string> on, faces;
  std::optional<milliseconds> least, sampled;
  study::Transparent transparent = study::Transparent::opaque;
  study::SunModel model;
  bool refraction = false;
};

Result<double> parseLength(const std::string& word) {
  const auto value = parseNumber(word, 0.0, 1e9);
  if (value && *value <= 0.0) return fail(ErrorCode::usage, fmt::format("'{}' is no length above 0", word));
  return value;
}

Result<study::Transparent> parseTransparent(const std::string& word) {
  if (word == "opaque") return study::Transparent::opaque;
  if (word == "ignored") return study::Transparent::ignored;
  if (word == "weighted") return study::Transparent::weighted;
  return fail(ErrorCode::usage, fmt::format("'{}' is none of opaque, ignored, weighted", word));
}

Result<study::SunPoint> parseLimb(const std::string& word) {
  if (word == "centre" || word == "center") return study::SunPoint::centre;
  if (word == "upper") return study::SunPoint::upperLimb;
  return fail(ErrorCode::usage, fmt::format("'{}' is neither centre nor upper", word));
}

Result<void> check(const HoursOptions& o) {
  if (o.points.empty() == !o.grid) return fail(ErrorCode::usage, "either --points or --grid is wanted");
  const auto kinds = o.points.empty() ? std::vector<std::string>{".csv", ".png", ".glb", ".tif"}
                                      : std::vector<std::string>{".csv", ".glb"};
  if (auto known = checkExtension("-o", o.output, kinds); !known) return known;
  if (!o.points.empty() && (o.plane || o.above || !o.on.empty() || !o.faces.empty()))
    return fail(ErrorCode::usage, "--plane, --on, --faces and --above belong to --grid");
  if (o.above && !o.faces.empty()) return fail(ErrorCode::usage, "--above lifts planes and grounds, not --faces");
  if (int(o.plane.has_value()) + int(!o.on.empty()) + int(!o.faces.empty()) > 1)
    return fail(ErrorCode::usage, "--plane, --on and --faces exclude each other");
  if (o.year && o.until) return fail(ErrorCode::usage, "--year and --until exclude each other");
  std::vector<std::string> outputs{o.output};
  if (hasExtension(o.output, ".csv")) outputs.push_back(o.output + ".ledger.txt");
  if (auto open = checkOutputs(outputs, o.scene.file); !open) return open;
  return checkOutputs(outputs, o.points);
}

// The outer edges of a raster whose rows run from west to east; nothing where they run askew or the raster is in degrees.
std::optional<study::PlanExtent> extentOf(const HoursOptions& o, const scene::Scene& scene) {
  io::LoadOptions load;
  load.crs = o.scene.crs;
  const auto raster = io::inspectRaster(o.scene.file, load);
  if (!raster || scene.up != scene::UpAxis::z || raster->right.y != 0.0 || raster->down.x != 0.0) return std::nullopt;
  const Vec2 a = raster->origin, b = a + double(raster->columns) * raster->right + double(raster->rows) * raster->down;
  return study::PlanExtent{std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
}

Result<study::ReceiverSet> receiversOf(const HoursOptions& o, const scene::Scene& scene) {
  if (!o.points.empty()) return study::readReceivers(o.points);
  if (!o.faces.empty()) return study::faceReceivers(scene, o.faces, *o.grid);
  if (!o.on.empty()) return study::groundReceivers(scene, o.on, *o.grid, o.above.value_or(0.0));
  if (!o.plane && io::isRaster(o.scene.file))
    return study::rasterReceivers(scene, extentOf(o, scene), *o.grid,
                                  o.above.value_or(study::kAboveRaster / scene.metresPerUnit));
  const double lowest = glm::dot(scene::bounds(scene).min, scene::upVector(scene.up));
  return study::planeReceivers(scene, *o.grid, o.plane.value_or(lowest) + o.above.value_or(0.0));
}

study::HoursRequest requestOf(const HoursOptions& o, const sun::Place& place) {
  study::HoursRequest r;
  r.place = place, r.zone = o.place.zone;
  r.date = o.place.date, r.until = o.until;
  if (o.year) {
    r.date = o.place.date.year() / std::chrono::January / 1;
    r.until = o.place.date.year() / std::chrono::December / 31;
  }
  r.from = o.from, r.to = o.to, r.model = o.model;
  if (o.refraction) r.model.refraction = sun::Refraction::standard;
  r.transparent = o.transparent, r.sampled = o.sampled, r.least = o.least;
  r.casters = o.scene.casters;
  return r;
}

std::string summary(const study::HoursTable& table) {
  if (table.hours.empty()) return "no points\n";
  std::vector<double> sorted = table.hours;
  std::sort(sorted.begin(), sorted.end());
  double sum = 0.0;
  for (const double h : sorted) sum += h;
  // Of a grid these are mostly the points within buildings, which a picture shows as built over.
  const auto dark = std::upper_bound(sorted.begin(), sorted.end(), 0.0) - sorted.begin();
  return fmt::format("{} points: {:.3f} to {:.3f} h of sun, mean {:.3f} h, median {:.3f} h, {} always dark\n",
                     sorted.size(), sorted.front(), sorted.back(), sum / double(sorted.size()),
                     sorted[sorted.size() / 2], dark);
}

Result<Outcome> run(const HoursOptions& options, const Console& console) {
  if (const auto fine = check(options); !fine) return tl::unexpected(fine.error());
  const auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  if (const auto casts = checkCasts(*scene, options.scene); !casts) return tl::unexpected(casts.error());
  const auto place = placeOf(options.place, *scene, options.scene, console);
  if (!place) return tl::unexpected(place.error());
  auto receivers = receiversOf(options, *scene);
  if (!receivers) return tl::unexpected(receivers.error());
  Stopwatch watch;
  const auto table = study::sunHours(*scene, std::move(*receivers), requestOf(options, *place), console.progress());
  if (!table) return tl::unexpected(table.error());
  console.detail(
      fmt::format("{} points on {} days in {:.0f} ms", table->hours.size(), table->days.size(), watch.lap()));
  for (const auto& warning : table->warnings) console.warn(warning);
  const DeferredSignals whole;
  const auto written = report::writeHours(*table, *scene, options.output);
  if (!written) return tl::unexpected(written.error());
  std::string text;
  for (const auto& path : *written) text += path.string() + "\n";
  return Outcome{text + summary(*table), 0};
}

}  // namespace

Run addHours(CLI::App& app) {
  const auto options = std::make_shared<HoursOptions>();
  constexpr Manner time{.group = "Place and time"}, where{.group = "Where"}, what{.group = "What counts"};
  addSceneOptions(app, options->scene);
  addPlaceOptions(app, options->place, PlaceFrom::scene);
  addValue(app, "--from", "HH:MM", "The beginning of each day (default 00:00)", options->from, sun::parseTime, time);
  addValue(app, "--to", "HH:MM", "Its end (default 24:00)", options->to, sun::parseTime, time);
  addValue(app, "--until", "YYYY-MM-DD",
           "The last of several days, --date being the first: hours add up, and are told by month", options->until,
           sun::parseDate, time);
  addFlag(app, "--year", "All days of the year of --date", options->year);
  addWord(app, "--points", "P.csv", "Points, with the header x,y,z,nx,ny,nz", options->points, where);
  addValue(app, "--grid", "STEP", "A grid, its cells so wide, in the scene's unit", options->grid, parseLength, where);
  addValue(
      app, "--plane", "HEIGHT", "of the grid (default: the scene's lowest point; the surface of a raster)",
      options->plane, [](const std::string& w) { return parseNumber(w, -1e9, 1e9); }, where);
  addValues(app, "--on", "PART",
            "The grid lies on the highest surface of these parts, a terrain for example (repeatable)", options->on,
            parseWord, where);
  addValues(app, "--faces", "PART", "Points on all faces of these parts, STEP apart (repeatable)", options->faces,
            parseWord, where);
  addValue(
      app, "--above", "H", "Receivers lie so high above the plane or the parts (default 0; above a raster 1 cm)",
      options->above, [](const std::string& w) { return parseNumber(w, 0.0, 1e6); }, where);
  addWord(app, "-o,--output", "OUT", "H.csv; of grids also .png (heat map), .tif (GeoTIFF), .glb (coloured squares)",
          options->output, {.required = true});
  addValue(app, "--at-least", "MIN", "Counts the runs of sun at least so long, and their hours", options->least,
           parseStep, what);
  addValue(app, "--sampled", "MIN", "What samples so far apart would say, for comparison", options->sampled, parseStep,
           what);
  addValue(app, "--transparent", "HOW", "Surfaces that are not opaque: opaque (default), ignored or weighted",
           options->transparent, parseTransparent, what);
  addValue(app, "--sun", "centre|upper", "Which point of the sun's disc counts: its centre (default) or its upper limb",
           options->model.point, parseLimb, what);
  addFlag(app, "--refraction", "The air lifts the sun (1010 hPa, 10 degrees C); without, directions are geometric",
          options->refraction);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
