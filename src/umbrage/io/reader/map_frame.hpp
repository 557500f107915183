#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>

#include "umbrage/base/error.hpp"
#include "umbrage/math/vec.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::io::reader {

/// What the coordinates of a map file mean.
struct MapClaim {
  std::string crs;                ///< as Projection::make knows it; empty: lengths from nowhere in particular
  std::string from = "the file";  ///< who says so, for messages
};

/// How coordinates become those of a scene.
struct MapFrame {
  std::string crs;  ///< of the scene's coordinates; empty: none
  double metresPerUnit = 1.0;
  std::string warning;  ///< empty: none
};

/// A footprint's, a cell's or a file's extent.
struct Extent {
  Vec2 min{std::numeric_limits<double>::infinity()};
  Vec2 max{-std::numeric_limits<double>::infinity()};
  void add(const Vec2& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y); }
  [[nodiscard]] double size() const { return empty() ? 0.0 : std::max(max.x - min.x, max.y - min.y); }
};

/// Takes all points of a map into the frame of a scene, in place: degrees are projected to metres around their middle
/// (geo::localCrs), lengths stay as they are. `typicalSize` is the usual extent of one thing of the map, in the file's unit.
/// Errors: input, where the claim cannot be true (degrees beyond the world or a thing of many kilometres; lengths that look like
/// degrees), where the reference system is not known or PROJ's data are missing.
[[nodiscard]] Result<MapFrame> placeOnMap(const MapClaim& claim, std::span<Vec2> points, double typicalSize);

/// Refuses a raster whose coordinates are said to be lengths and cannot be: cells of at most a centimetre in the range of degrees, and
/// `relief`, the difference of its heights in metres, larger than all of it is wide.
[[nodiscard]] Result<void> checkCells(const MapClaim& claim, const MapFrame& frame, const Extent& extent, double cell,
                                      double relief);

/// Refuses a scene of another format whose reference system is in degrees, or whose parts are so small that they must be. Without a
/// reference system only where the format demands metres, `metric`: it is named in the message.
[[nodiscard]] Result<void> checkLengths(const scene::Scene& scene, const std::string& metric = {});

}  // namespace umbrage::io::reader
