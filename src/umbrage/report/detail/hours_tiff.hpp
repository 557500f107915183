#pragma once

#include <filesystem>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/hours_table.hpp"

namespace umbrage::report::detail {

/// A GeoTIFF of a grid. Errors: unsupported (a build without GDAL), output.
[[nodiscard]] Result<void> writeHoursTiff(const study::HoursTable& table, const scene::Scene& scene,
                                          const std::filesystem::path& path);

}  // namespace umbrage::report::detail
