#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace umbrage::io::detail {

enum class Format { gltf, obj, ply, stl, off, threeDs, ifc, x3d, inventor, cityJson, cityJsonSeq, geoJson, raster };

/// By the last extension of the name, in any case.
[[nodiscard]] std::optional<Format> formatOf(const std::filesystem::path& path);
[[nodiscard]] std::span<const std::string_view> extensions();

}  // namespace umbrage::io::detail
