#include "umbrage/io/detail/format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace umbrage::io::detail {
namespace {

constexpr std::array<std::string_view, 18> kExtensions = {"gltf", "glb",   "obj",     "ply", "stl",  "off",
                                                          "3ds",  "ifc",   "x3d",     "iv",  "wrl",  "vrml",
                                                          "json", "jsonl", "geojson", "tif", "tiff", "asc"};
constexpr std::array<Format, 18> kFormats = {
    Format::gltf,     Format::gltf,        Format::obj,     Format::ply,      Format::stl,      Format::off,
    Format::threeDs,  Format::ifc,         Format::x3d,     Format::inventor, Format::inventor, Format::inventor,
    Format::cityJson, Format::cityJsonSeq, Format::geoJson, Format::raster,   Format::raster,   Format::raster};

}  // namespace

std::optional<Format> formatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (extension.empty()) return std::nullopt;
  extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::find(kExtensions.begin(), kExtensions.end(), extension);
  if (found == kExtensions.end()) return std::nullopt;
  return kFormats[static_cast<std::size_t>(found - kExtensions.begin())];
}

std::span<const std::string_view> extensions() { return kExtensions; }

}  // namespace umbrage::io::detail
