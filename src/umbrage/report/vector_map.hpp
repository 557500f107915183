#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/image/image.hpp"
#include "umbrage/outline/region.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::report {

/// What belongs together and looks alike: the shadows of a moment, the ground with two hours of sun.
struct MapLayer {
  std::string name;  ///< "09:00"
  image::Rgb8 colour{};
  double opacity = 0.0;  ///< in pictures; 0: by the number of layers, so that all show through
};

struct MapFeature {
  std::size_t layer = 0;
  outline::Region region;
  /// For GeoJSON, in this order.
  std::vector<std::pair<std::string, std::variant<double, std::string>>> properties;
};

/// Regions of a horizontal plane and what they mean. Coordinates are x east, y north, in the scene's unit.
/// 1. Every feature's layer exists.
struct VectorMap {
  std::string title, subtitle;
  std::vector<MapLayer> layers;
  std::vector<MapFeature> features;
  std::vector<outline::Polygon> buildings;  ///< drawn for orientation, in pictures only
  /// Pictures show the features with their neighbourhood, and those that are small (points) over the buildings; otherwise everything, with the buildings on top.
  bool aboutFeatures = false;
  std::vector<study::LedgerLine> ledger;
  std::string crs;  ///< Scene::crs
  double metresPerUnit = 1.0;
  double height = 0.0;  ///< of the plane
  Angle north;          ///< true north lies so much clockwise of the y axis
};

/// GeoJSON (RFC 7946): one feature each, the ledger as a member "umbrage". With a reference system that PROJ knows, coordinates are
/// longitude and latitude on WGS84 to 1e-12 degrees; without, they are the scene's, "crs" is null and the ledger says so.
/// Errors: input (PROJ's data are missing), output.
[[nodiscard]] Result<void> writeGeoJson(const VectorMap& map, const std::filesystem::path& path);

/// AutoCAD R12 DXF in the scene's coordinates and unit: closed polylines at the plane's height, a layer each, the ledger as comments.
[[nodiscard]] Result<void> writeDxf(const VectorMap& map, const std::filesystem::path& path);

/// A picture with legend, scale, north and ledger; paths are in the scene's unit, relative to an origin it names.
[[nodiscard]] std::string svgText(const VectorMap& map);
[[nodiscard]] Result<void> writeSvg(const VectorMap& map, const std::filesystem::path& path);

/// By extension: .geojson or .json, .dxf, .svg. Errors: usage (another extension), and those of the writer.
[[nodiscard]] Result<void> writeMap(const VectorMap& map, const std::filesystem::path& path);

}  // namespace umbrage::report
