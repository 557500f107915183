#include "umbrage/terrain/terrain_hours.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "umbrage/base/check.hpp"
#include "umbrage/scene/camera.hpp"

namespace umbrage::terrain {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLook{60'000};
// A disc reads faster than this; a reader that does not is stuck.
constexpr double kBytesPerMillisecond = 10'000.0;
constexpr float kNowhere = -1.0F;

io::LoadOptions withTime(io::LoadOptions options, const std::filesystem::path& path) {
  std::error_code ignored;
  const auto bytes = double(std::filesystem::file_size(path, ignored));
  options.timeLimit += milliseconds(static_cast<std::int64_t>(bytes / kBytesPerMillisecond));
  return options;
}

// The corners of a mesh by the cell whose middle they are.
class Ground {
 public:
  Ground(const scene::Scene& scene, const io::RasterInfo& raster) : raster_(raster) {
    const double across = raster.right.x * raster.down.y - raster.right.y * raster.down.x;
    for (const Vec3& p : scene.meshes.at(0)->positions) {
      const Vec2 d = Vec2(p) - raster.origin;
      const double column = (d.x * raster.down.y - d.y * raster.down.x) / across;
      const double row = (d.y * raster.right.x - d.x * raster.right.y) / across;
      heights_.emplace(key(std::llround(column - 0.5), std::llround(row - 0.5)), p.z);
    }
  }
  [[nodiscard]] const double* at(std::int64_t column, std::int64_t row) const {
    const auto found = heights_.find(key(column, row));
    return found == heights_.end() ? nullptr : &found->second;
  }

 private:
  [[nodiscard]] std::int64_t key(std::int64_t column, std::int64_t row) const { return row * raster_.columns + column; }
  const io::RasterInfo& raster_;
  std::unordered_map<std::int64_t, double> heights_;
};

struct Job {
  const std::filesystem::path& path;
  const sun::Place& place;
  const TerrainOptions& options;
  const io::RasterInfo& raster;
  const study::SunCourse& course;
};

Result<TerrainTile> workOut(const Job& job, const io::RasterTile& part) {
  io::LoadOptions load = withTime(job.options.load, job.path);
  load.tile = part;
  auto scene = io::loadScene(job.path, load);
  if (!scene) return tl::unexpected(scene.error());
  scene->northOffset = job.options.north;
  const int step = job.options.step;
  TerrainTile tile{
      part.column / step,          part.row / step, (part.columns + step - 1) / step, (part.rows + step - 1) / step, {},
      scene::triangleCount(*scene)};
  tile.hours.assign(std::size_t(tile.columns) * std::size_t(tile.rows), kNowhere);
  if (scene->meshes.empty()) return tile;  // nothing has a height here
  // Around the tile single precision is fine enough for the lift, wherever on Earth it lies.
  const Vec2 middle = job.raster.middle(part.column + 0.5 * part.columns, part.row + 0.5 * part.rows);
  const double lift = job.options.lift / job.raster.metresPerUnit;
  std::vector<study::Receiver> receivers;
  std::vector<std::size_t> places;
  {
    const Ground ground(*scene, job.raster);
    for (int r = 0; r < tile.rows; ++r)
      for (int c = 0; c < tile.columns; ++c) {
        const std::int64_t column = part.column + std::int64_t{c} * step, row = part.row + std::int64_t{r} * step;
        const double* height = ground.at(column, row);
        if (height == nullptr) continue;
        receivers.push_back({Vec3(job.raster.middle(double(column), double(row)) - middle, *height + lift),
                             scene::upVector(scene->up)});
        places.push_back(std::size_t(r) * std::size_t(tile.columns) + std::size_t(c));
      }
  }
  auto mesh = std::make_shared<mesh::Mesh>(*scene->meshes[0]);
  for (Vec3& p : mesh->positions) p -= Vec3(middle, 0.0);
  scene->meshes[0] = std::move(mesh);
  const auto hours = study::ExactHours::build(*scene, job.place);
  if (!hours) return tl::unexpected(hours.error());
  const auto lit = hours->at(receivers, job.course);
  if (!lit) return tl::unexpected(lit.error());
  for (std::size_t i = 0; i < places.size(); ++i)
    tile.hours[places[i]] = static_cast<float>(double(lit->total(i).count()) / 3.6e6);
  return tile;
}

}  // namespace

study::TimeSpan whileHigh(const sun::Place& place, const study::TimeSpan& span, Angle leastElevation) {
  const auto isHigh = [&](sun::Instant t) { return sun::sunPosition(place, t).elevation >= leastElevation; };
  const auto border = [&](sun::Instant high, sun::Instant low) {
    while (std::chrono::abs(high - low) > milliseconds(100)) {
      const sun::Instant middle = high + (low - high) / 2;
      (isHigh(middle) ? high : low) = middle;
    }
    return high;
  };
  study::TimeSpan high{span.to, span.from};
  for (sun::Instant t = span.from; t <= span.to; t += kLook) {
    if (!isHigh(t)) continue;
    high.from = std::min(high.from, t);
    high.to = std::max(high.to, t);
  }
  if (high.from > high.to) return {span.from, span.from};
  if (high.from > span.from) high.from = border(high.from, high.from - kLook);
  if (high.to < span.to) high.to = border(high.to, std::min(span.to, high.to + kLook));
  return high;
}

Result<TerrainReport> terrainHours(const std::filesystem::path& path, const sun::Place& place,
                                   const study::TimeSpan& span, const TerrainOptions& options,
                                   const std::function<Result<void>(const TerrainTile&)>& take,
                                   const ProgressSink& progress) {
  UMBRAGE_CHECK(options.step >= 1 && options.tile >= options.step, "a step below 1, or tiles smaller than a step");
  const study::TimeSpan high = whileHigh(place, span, options.leastElevation);
  if (high.from >= high.to)
    return fail(ErrorCode::usage, "the sun is never as high as the least elevation within the period");
  const auto raster = io::inspectRaster(path, withTime(options.load, path));
  if (!raster) return tl::unexpected(raster.error());
  const auto course = study::SunCourse::make(place, high);
  TerrainReport report{*raster};
  const auto count = [](std::int64_t cells, int each) { return static_cast<int>((cells + each - 1) / each); };
  report.columns = count(raster->columns, options.step);
  report.rows = count(raster->rows, options.step);
  report.up = course.upTime();
  const int side = options.tile / options.step * options.step;
  const int across = count(raster->columns, side), down = count(raster->rows, side);
  // The sun that is so high in the plane of the least elevation; heights and cells are in the same unit.
  io::RasterTile part{0, 0, side, side, tan(options.leastElevation), raster->highest};
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) {
      if (!reportProgress(progress, double(report.tiles) / (double(across) * down), "tiles"))
        return fail(ErrorCode::cancelled, "cancelled");
      part.column = i * side;
      part.row = j * side;
      part.columns = static_cast<int>(std::min<std::int64_t>(side, raster->columns - part.column));
      part.rows = static_cast<int>(std::min<std::int64_t>(side, raster->rows - part.row));
      const auto tile = workOut({path, place, options, *raster, course}, part);
      if (!tile) return tl::unexpected(tile.error());
      if (auto taken = take(*tile); !taken) return tl::unexpected(taken.error());
      ++report.tiles;
      report.mostCasters = std::max(report.mostCasters, tile->casters);
    }
  return report;
}

}  // namespace umbrage::terrain
