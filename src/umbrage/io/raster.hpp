#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "umbrage/base/error.hpp"
#include "umbrage/io/load.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::io {

/// A height raster without its heights. Cell (column, row) has its middle at origin + (column + 0.5) right + (row + 0.5) down, in the file's
/// coordinates.
struct RasterInfo {
  std::int64_t columns = 0, rows = 0;
  Vec2 origin{0.0}, right{1.0, 0.0}, down{0.0, -1.0};
  double lowest = 0.0, highest = 0.0;  ///< of the cells that have a height
  std::string crs;                     ///< as Scene::crs
  double metresPerUnit = 1.0;

  [[nodiscard]] Vec2 middle(double column, double row) const {
    return origin + (column + 0.5) * right + (row + 0.5) * down;
  }
};

/// Whether a file is read as a height raster: by its extension, in any case.
[[nodiscard]] bool isRaster(const std::filesystem::path& path);

/// Reads all heights once, block by block, in the confined process: a raster larger than memory is fine.
/// Errors: those of loadScene; unsupported, for rasters in degrees.
[[nodiscard]] Result<RasterInfo> inspectRaster(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace umbrage::io
