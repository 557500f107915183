#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <vector>

#include "umbrage/base/progress.hpp"
#include "umbrage/io/raster.hpp"
#include "umbrage/study/exact_hours.hpp"

namespace umbrage::terrain {

/// Which cells of a height raster get hours, and how much of it is held at once.
struct TerrainOptions {
  int step = 1;    ///< every so many-th column and row, from the first; at least 1
  int tile = 512;  ///< cells a side of what is worked out at once; at least step
  /// The sun counts only while it is so high. What lies far away then cannot matter, which is what makes tiles possible.
  Angle leastElevation = Angle::degrees(5);
  /// Metres above the middle of a cell that a receiver stands: on the very corner of triangles "behind the slope" has no meaning.
  double lift = 0.01;
  Angle north;  ///< true north lies so much clockwise of the raster's y axis
  io::LoadOptions load;
};

/// The hours of one tile's cells, row by row from the north-west; negative where there is no height.
struct TerrainTile {
  int column = 0, row = 0;  ///< of its first value, in the grid of values
  int columns = 0, rows = 0;
  std::vector<float> hours;
  std::size_t casters = 0;  ///< triangles held for it
};

/// What the whole run was like.
struct TerrainReport {
  io::RasterInfo raster;
  int columns = 0, rows = 0;        ///< of the grid of values
  std::chrono::milliseconds up{0};  ///< how long the sun is high enough
  std::size_t tiles = 0, mostCasters = 0;
};

/// Exact hours of sun on the ground of a height raster of any size, tile by tile: each tile is held with all cells around it that can
/// hide the sun (io::RasterTile), worked out, handed to `take` and forgotten. Tiles come row by row.
/// 1. The values do not depend on the size of tiles, but for rounding to single precision around each (study::ExactHours).
/// 2. Held at once is one tile with what reaches it.
/// The ground faces up.
/// Errors: those of the raster and of `take`; usage, where the sun is never high enough; cancelled.
[[nodiscard]] Result<TerrainReport> terrainHours(const std::filesystem::path& path, const sun::Place& place,
                                                 const study::TimeSpan& span, const TerrainOptions& options,
                                                 const std::function<Result<void>(const TerrainTile&)>& take,
                                                 const ProgressSink& progress = {});

/// The part of a span in which the sun is at least so high, to the second; from the first to the last such moment.
[[nodiscard]] study::TimeSpan whileHigh(const sun::Place& place, const study::TimeSpan& span, Angle leastElevation);

}  // namespace umbrage::terrain
