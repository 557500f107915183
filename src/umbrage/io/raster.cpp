#include "umbrage/io/raster.hpp"

#include <cmath>

#include "umbrage/io/detail/format.hpp"

namespace umbrage::io {

bool isRaster(const std::filesystem::path& path) { return detail::formatOf(path) == detail::Format::raster; }

// The reader hands the figures over as the points of a mesh (reader/raster.cpp).
Result<RasterInfo> inspectRaster(const std::filesystem::path& path, const LoadOptions& options) {
  LoadOptions asked = options;
  asked.tile.reset();
  asked.inspectOnly = true;
  const auto scene = loadScene(path, asked);
  if (!scene) return tl::unexpected(scene.error());
  if (scene->meshes.size() != 1 || scene->meshes[0]->positions.size() != 5)
    return fail(ErrorCode::unsupported, "is not a height raster", path.string());
  const auto& figures = scene->meshes[0]->positions;
  RasterInfo info;
  info.columns = std::llround(figures[0].x);
  info.rows = std::llround(figures[0].y);
  info.origin = Vec2(figures[1]);
  info.right = Vec2(figures[2]);
  info.down = Vec2(figures[3]);
  info.lowest = figures[4].x;
  info.highest = figures[4].y;
  info.crs = scene->crs;
  info.metresPerUnit = scene->metresPerUnit;
  if (info.columns < 1 || info.rows < 1) return fail(ErrorCode::input, "has no cells", path.string());
  return info;
}

}  // namespace umbrage::io
