#pragma once

#include <filesystem>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/image/image.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/hours_table.hpp"

namespace umbrage::report {

/// A plan of a grid's hours with scale, statistics and ledger; what stands above the grid is drawn pale. North is up, as the scene's frame
/// has it. REQUIRES: table.set.lattice has columns; `scene` is the one the table was made of.
[[nodiscard]] image::RgbImage hoursPlan(const scene::Scene& scene, const study::HoursTable& table);

/// Writes a table by extension, each file whole or not at all, and returns their paths:
/// .csv  a line per receiver, hours,longest,intervals and more where it was asked for; of grids and faces x,y,z,nx,ny,nz before them; the
///       ledger beside it, in NAME.ledger.txt;
/// .png  hoursPlan; .tif  a GeoTIFF of grids in 32-bit numbers, -9999 where there is no receiver, the ledger as its metadata;
/// .glb  a small square per receiver, coloured by its hours, which are also an attribute _HOURS; the ledger as "extras".
/// Errors: usage (another extension; a .png or .tif of what is no grid), output, unsupported (.tif in a build without GDAL).
[[nodiscard]] Result<std::vector<std::filesystem::path>> writeHours(const study::HoursTable& table,
                                                                    const scene::Scene& scene,
                                                                    const std::filesystem::path& path);

}  // namespace umbrage::report
