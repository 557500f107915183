#include "umbrage/terrain/terrain_hours.hpp"

#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "commands.hpp"
#include "moments.hpp"
#include "outputs.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/geo/projection.hpp"
#include "umbrage/study/ledger.hpp"

namespace umbrage::cli {
namespace {

using std::chrono::milliseconds;

struct TerrainOptions {
  SceneOptions scene;
  PlaceOptions place;
  milliseconds from{0}, to{std::chrono::hours(24)};
  terrain::TerrainOptions study;
  std::optional<double> above;  ///< in the file's unit
  std::string output;
};

constexpr const char* kNothing = "-9999";

io::LoadOptions loadOptions(const TerrainOptions& options) {
  io::LoadOptions load;
  load.crs = options.scene.crs;
  load.metresPerUnit = options.scene.metresPerUnit;
  return load;
}

// A scene of one point, so that a raster of any size says where it lies.
scene::Scene standIn(const io::RasterInfo& raster, const std::string& file) {
  scene::Scene scene;
  scene.source = file;
  scene.crs = raster.crs;
  scene.metresPerUnit = raster.metresPerUnit;
  scene.materials.emplace_back();
  auto mesh = std::make_shared<mesh::Mesh>();
  for (const Vec2& corner : {raster.middle(0, 0), raster.middle(double(raster.columns), double(raster.rows))})
    mesh->positions.emplace_back(corner, raster.lowest);
  mesh->triangles = {{0, 1, 1}};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({"terrain", 0, Mat4(1.0), true});
  return scene;
}

// An Esri ASCII grid of the values, written as the tiles come: one row of tiles is held.
class GridFile {
 public:
  GridFile(const std::filesystem::path& path, const io::RasterInfo& raster, int step)
      : out_(path), columns_(int((raster.columns + step - 1) / step)) {
    const int rows = int((raster.rows + step - 1) / step);
    const double side = raster.right.x * step;
    const Vec2 first = raster.middle(0, 0);
    out_ << fmt::format("ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value {}\n", columns_,
                        rows, first.x - 0.5 * side, first.y - (rows - 0.5) * side, side, kNothing);
  }
  void take(const terrain::TerrainTile& tile) {
    if (tile.column == 0) band_.assign(std::size_t(tile.rows) * std::size_t(columns_), -1.0F);
    for (int r = 0; r < tile.rows; ++r)
      for (int c = 0; c < tile.columns; ++c)
        band_[std::size_t(r) * std::size_t(columns_) + std::size_t(tile.column + c)] =
            tile.hours[std::size_t(r) * std::size_t(tile.columns) + std::size_t(c)];
    if (tile.column + tile.columns < columns_) return;
    std::string text;
    for (int r = 0; r < tile.rows; ++r)
      for (int c = 0; c < columns_; ++c) {
        const float hours = band_[std::size_t(r) * std::size_t(columns_) + std::size_t(c)];
        text += hours < 0.0F ? kNothing : fmt::format("{:.4f}", hours);
        text += c + 1 < columns_ ? ' ' : '\n';
      }
    out_ << text;
  }
  [[nodiscard]] bool good() {
    out_.flush();
    return out_.good();
  }

 private:
  std::ofstream out_;
  int columns_;
  std::vector<float> band_;
};

Result<void> checkSquare(const io::RasterInfo& raster, const std::string& file) {
  const double side = raster.right.x;
  if (raster.right.y == 0.0 && raster.down.x == 0.0 && side > 0.0 && std::abs(raster.down.y + side) <= 1e-9 * side)
    return {};
  return fail(ErrorCode::unsupported, "has cells that are not square and north-up, which a grid cannot be written of",
              file);
}

std::string ledgerText(const std::vector<study::LedgerLine>& ledger) {
  std::string text;
  for (const auto& line : ledger) text += line.subject + ": " + line.text + "\n";
  return text;
}

Result<Outcome> run(const TerrainOptions& options, const Console& console) {
  if (const auto known = checkExtension("-o", options.output, {".asc"}); !known) return tl::unexpected(known.error());
  const std::string notes = options.output + ".txt";
  if (const auto open = checkOutputs({options.output, notes}, options.scene.file); !open)
    return tl::unexpected(open.error());
  io::LoadOptions slow = loadOptions(options);
  slow.timeLimit = std::chrono::minutes(5);
  const auto raster = io::inspectRaster(options.scene.file, slow);
  if (!raster) return tl::unexpected(raster.error());
  if (const auto square = checkSquare(*raster, options.scene.file); !square) return tl::unexpected(square.error());
  scene::Scene where = standIn(*raster, options.scene.file);
  const auto place = placeOf(options.place, where, options.scene, console);
  if (!place) return tl::unexpected(place.error());
  const auto span = spanOf(options.from, options.to, options.place, *place, console);
  if (!span) return tl::unexpected(span.error());
  const auto high = terrain::whileHigh(*place, *span, options.study.leastElevation);
  if (high.from >= high.to)
    return fail(ErrorCode::usage,
                fmt::format("the sun is never {:g} degrees above the horizon from {} to {} (--min-elevation); {}",
                            options.study.leastElevation.degrees(), sun::timeText(options.from),
                            sun::timeText(options.to), sunTimes(options.place, *place)));

  terrain::TerrainOptions study = options.study;
  study.load = loadOptions(options);
  if (options.above) study.lift = *options.above * where.metresPerUnit;
  if (options.scene.trueNorth) {
    const auto projection = geo::Projection::make(raster->crs);
    if (!projection) return tl::unexpected(projection.error());
    study.north =
        projection->trueNorth(raster->middle(double(raster->columns) / 2, double(raster->rows) / 2)).value_or(Angle{});
  }
  if (options.scene.north) study.north = *options.scene.north;
  where.northOffset = study.north;
  Result<terrain::TerrainReport> report;
  const auto written = writeFileWith(options.output, [&](const std::filesystem::path& path) -> Result<void> {
    GridFile grid(path, *raster, study.step);
    report = terrain::terrainHours(
        options.scene.file, *place, *span, study,
        [&](const terrain::TerrainTile& tile) -> Result<void> {
          grid.take(tile);
          return {};
        },
        console.progress());
    if (!report) return tl::unexpected(report.error());
    if (!grid.good()) return fail(ErrorCode::output, "cannot be written", options.output);
    return {};
  });
  if (!written) return tl::unexpected(written.error());
  const std::vector<study::LedgerLine> ledger = {
      {"Values", "hours of sun, north to south and west to east; -9999 where the raster has no height"},
      {"Place", study::placeText(*place)},
      {"Date", sun::dateText(options.place.date)},
      study::clockLine(options.place.zone, offsetsText(options.place, *place, *span)),
      {"Period",
       fmt::format("{} to {}, while the sun is at least {:g} degrees high: {:.3f} h", sun::timeText(options.from),
                   sun::timeText(options.to), study.leastElevation.degrees(), double(report->up.count()) / 3.6e6)},
      study::sunLine(
          {}, fmt::format("declination moving (ERFA), at least {:g} degrees high", study.leastElevation.degrees())),
      {"Receivers", fmt::format("{:g} m above the middle of every {}cell, facing up", study.lift,
                                study.step == 1 ? "" : fmt::format("{}. ", study.step))},
      {"Ground", fmt::format("{} x {} cells, two triangles between four middles, heights {:g} to {:g}", raster->columns,
                             raster->rows, raster->lowest, raster->highest)},
      study::northLine(where),
      study::unitLine(where),
      study::inputLine(where),
      study::versionLine("exact hours, tile by tile", options.place.zone)};
  if (const auto noted = writeFile(notes, ledgerText(ledger)); !noted) return tl::unexpected(noted.error());
  return Outcome{
      fmt::format("{}\n{}\n{} x {} values, {} tiles, at most {} triangles at once, the sun is up for {:.3f} h\n",
                  options.output, notes, report->columns, report->rows, report->tiles, report->mostCasters,
                  double(report->up.count()) / 3.6e6),
      0};
}

}  // namespace

Run addTerrain(CLI::App& app) {
  const auto options = std::make_shared<TerrainOptions>();
  constexpr Manner time{.group = "Place and time"};
  const auto whole = [](double low, double high) {
    return [low, high](const std::string& word) -> Result<int> {
      const auto value = parseNumber(word, low, high);
      if (!value) return tl::unexpected(value.error());
      if (*value != std::floor(*value)) return fail(ErrorCode::usage, fmt::format("'{}' is no whole number", word));
      return static_cast<int>(*value);
    };
  };
  addSceneOptions(app, options->scene);
  addPlaceOptions(app, options->place, PlaceFrom::scene);
  addValue(app, "--from", "HH:MM", "The beginning of the period (default 00:00)", options->from, sun::parseTime, time);
  addValue(app, "--to", "HH:MM", "Its end (default 24:00)", options->to, sun::parseTime, time);
  addValue(
      app, "--min-elevation", "DEG",
      "Only while the sun is so high, 0.5 to 90 (default 5); what is farther cannot matter",
      options->study.leastElevation, [](const std::string& word) { return parseDegrees(word, 0.5, 90); }, time);
  addValue(app, "--every", "N", "Hours for every N-th cell and row (default 1)", options->study.step, whole(1, 10000));
  addValue(app, "--tile", "N", "Cells a side of what is held at once (default 512)", options->study.tile,
           whole(16, 4096));
  addValue(app, "--above", "H", "Receivers stand so high above the middles of cells, in the file's unit (default 1 cm)",
           options->above, [](const std::string& word) { return parseNumber(word, 0.0, 1e6); });
  addWord(app, "-o,--output", "OUT.asc", "The grid of hours; beside it OUT.asc.txt, what it rests on", options->output,
          {.required = true});
  return [options](const Console& console) {
    options->study.tile = std::max(options->study.tile, options->study.step);
    return run(*options, console);
  };
}

}  // namespace umbrage::cli
