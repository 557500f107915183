#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "umbrage/base/angle.hpp"
#include "umbrage/base/error.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::io {

/// A rectangle of a height raster together with all cells around it that can hide the sun from it while the sun is high enough:
/// those that rise above the rectangle's lowest height by `leastSlope` times their distance or more.
struct RasterTile {
  int column = 0, row = 0, columns = 0, rows = 0;
  double leastSlope = 0.0;  ///< tangent of the sun's least elevation; 0: the whole raster
  double highest = 0.0;     ///< RasterInfo::highest
};

/// What the caller knows better than the file, and what reading may cost.
struct LoadOptions {
  std::optional<scene::UpAxis> up;      ///< instead of the format's own
  std::optional<double> metresPerUnit;  ///< instead of the format's own; positive and finite
  std::optional<Angle> north;           ///< true north lies this much clockwise of the frame's north
  std::optional<std::string> lod;       ///< CityJSON: this level of detail instead of each object's highest
  std::optional<std::string>
      crs;  ///< what the coordinates are, instead of what the file says: "EPSG:28992", or "local", metres
  std::optional<std::string> heightProperty;  ///< GeoJSON: this property alone is the height
  std::optional<double> defaultHeight;        ///< GeoJSON: metres, for footprints without height and floors; positive
  double floorHeight = 3.0;                   ///< GeoJSON: metres from floor to floor; positive
  std::optional<RasterTile> tile;             ///< height rasters: only this
  /// glTF: textures that let something through may cut triangles into so many pieces, all instances counted; 0: they stay whole, by the
  /// mean of their texture.
  std::size_t alphaTriangles = 250'000;
  int alphaTexels = 1;       ///< glTF: along cells of at least so many texels on a side; a power of two up to 4096
  bool inspectOnly = false;  ///< for inspectRaster
  std::chrono::milliseconds timeLimit{9000};          ///< wall clock for the whole call
  std::size_t memoryLimit = std::size_t{1800} << 20;  ///< bytes of address space for the parsers
};

/// More triangles than this, all instances counted, are refused as too large.
inline constexpr std::size_t kMaxTriangles = 20'000'000;
inline constexpr std::size_t kMaxInstances = 1'000'000;

/// So begin those of Scene::warnings that say what became of textures' alpha.
inline constexpr std::string_view kAlphaNote = "alpha of textures: ";

/// Reads a scene file: glTF 2.0 (.gltf .glb), Wavefront .obj, .ply, .stl, .off, .3ds, .ifc, .x3d, Open Inventor .iv, VRML .wrl,
/// CityJSON (.json), CityJSONSeq (.jsonl), footprints with heights in GeoJSON (.geojson .json) and height
/// rasters (.tif .tiff .asc: a corner at the middle of each cell, holes where there is no height). Coordinates and units stay
/// the file's own, except degrees, which are projected to metres (Scene::crs says how).
///
/// 1. The file is parsed in a process of its own, `umbrage-reader`, with limits on time, memory and size: whatever the file
///    does to the parser becomes an Error here. The scene has no fault (scene::findFault).
/// 2. A partly readable file gives what could be read, and Scene::warnings counts the rest. A readable file without triangles
///    gives an empty scene and a warning.
/// 3. Triangles of a closed surface stay edge-closed: no vertex is moved, joined within a tolerance or invented.
/// 4. Colours are taken as sRGB and made linear, except those of glTF, which are linear.
/// 5. Names and warnings are UTF-8 without control characters; what is not UTF-8 in a file is taken as Latin-1.
/// 6. May be called from several threads at once.
/// Rasters are read by `umbrage-raster-reader` ($UMBRAGE_RASTER_READER). The reader is looked for at $UMBRAGE_READER, then beside the running program and in the libexec folder of its installation,
/// then where this library was installed or built.
/// Errors: input (missing, broken, hostile, too large, too slow), unsupported (unknown format or feature), usage (options).
/// CAVEAT: .obj .ply .stl .off .3ds .ifc .x3d .iv .wrl are read in single precision by the libraries behind them.
[[nodiscard]] Result<scene::Scene> loadScene(const std::filesystem::path& path, const LoadOptions& options = {});

/// The extensions that loadScene knows, lower case, without the dot.
[[nodiscard]] std::span<const std::string_view> readableExtensions();

}  // namespace umbrage::io
