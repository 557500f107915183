#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "umbrage/study/exact_hours.hpp"

namespace umbrage::study {

/// A grid in plan. Row 0 lies in the north; east and north of the scene's frame are those of scene::eastVector without its offset.
struct Lattice {
  double west = 0.0, north = 0.0;  ///< of the outer edge of the first cell, in the scene's unit
  double step = 1.0;
  int columns = 0, rows = 0;
  std::vector<std::int32_t> receiver;  ///< per cell, row by row; -1: none
};

/// Points at which a study asks for sun.
struct ReceiverSet {
  std::vector<Receiver> receivers;
  Lattice lattice;        ///< of grids in plan; no columns: the points are not a grid
  double spacing = 0.0;   ///< of points on faces
  std::string described;  ///< for the ledger: "grid of 2 m, 1.5 above ..."
};

inline constexpr std::size_t kMostReceivers = 50'000'000;

/// The middles of a grid's cells at a height, facing up, over the ground plan of the casters and a margin around it.
/// REQUIRES: step > 0. Errors: usage (more than kMostReceivers).
[[nodiscard]] Result<ReceiverSet> planeReceivers(const scene::Scene& scene, double step, double height);

/// The same on the highest surface of the parts that match a pattern (scene::matchesName), `above` it.
/// Errors: usage (nothing matches, no middle of a cell is on it, or more than kMostReceivers).
[[nodiscard]] Result<ReceiverSet> groundReceivers(const scene::Scene& scene, const std::vector<std::string>& patterns,
                                                  double step, double above);

/// A rectangle in plan, in the scene's unit, by the directions of Lattice.
struct PlanExtent {
  double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
};

/// How far above a raster's surface receivers stand unless asked otherwise, in metres: the middle of a cell is a corner of the surface, where
/// "behind the slope" has no meaning.
inline constexpr double kAboveRaster = 0.01;

/// The same on the whole surface of a height raster, `above` it, facing up as in terrain::terrainHours. Cells begin at the north-western
/// corner of `extent`, the raster's outer edges, so that steps of the raster's own cells are its cells; without one, at whole steps.
/// REQUIRES: step > 0. Errors: input (no heights), usage (no middle of a cell is on it, or more than kMostReceivers).
[[nodiscard]] Result<ReceiverSet> rasterReceivers(const scene::Scene& scene, const std::optional<PlanExtent>& extent,
                                                  double step, double above);

/// Points on all faces of the parts that match, one for each square of side `step` and at least one a face; they face outwards where the
/// part's triangles do.
[[nodiscard]] Result<ReceiverSet> faceReceivers(const scene::Scene& scene, const std::vector<std::string>& patterns,
                                                double step);

/// Points from a CSV file with the header x,y,z,nx,ny,nz.
/// Errors: input, with file and line.
[[nodiscard]] Result<ReceiverSet> readReceivers(const std::filesystem::path& path);

}  // namespace umbrage::study
