// Height rasters (GeoTIFF, Esri ASCII grid) as terrain: one corner at the middle of each cell, two triangles between four of them. Only two of GDAL's
// drivers are registered, and nothing but the file itself is opened.
#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "umbrage/geo/projection.hpp"
#include "umbrage/io/reader/map_frame.hpp"
#include "umbrage/io/reader/read.hpp"
#include "umbrage/io/reader/surface_colours.hpp"
#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

// As triangles these take half a gigabyte, all copies counted.
constexpr std::int64_t kMostCells = 4'000'000;
constexpr int kStrip = 256;            // rows read at once
constexpr double kHighest = 20'000.0;  // metres; beyond it a number is no height

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

struct Window {
  int column = 0, row = 0, columns = 0, rows = 0;
};

class Raster {
 public:
  static Result<Raster> open(const std::filesystem::path& path);

  [[nodiscard]] int columns() const { return GDALGetRasterXSize(dataset_.get()); }
  [[nodiscard]] int rows() const { return GDALGetRasterYSize(dataset_.get()); }
  [[nodiscard]] Vec2 place(double column, double row) const {
    return {frame_[0] + column * frame_[1] + row * frame_[2], frame_[3] + column * frame_[4] + row * frame_[5]};
  }
  [[nodiscard]] const double* frame() const { return frame_; }
  [[nodiscard]] std::string crs() const;
  /// Heights row by row; not a number where there is none.
  [[nodiscard]] Result<std::vector<float>> read(const Window& window) const;

 private:
  Dataset dataset_;
  GDALRasterBandH band_ = nullptr;
  double frame_[6] = {0, 1, 0, 0, 0, -1};
};

tl::unexpected<Error> gdalFailure(const char* what) {
  const std::string said = CPLGetLastErrorMsg();
  return fail(ErrorCode::input, said.empty() ? what : fmt::format("{}: {}", what, said));
}

Result<Raster> Raster::open(const std::filesystem::path& path) {
  CPLSetErrorHandler(CPLQuietErrorHandler);
  CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");
  CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
  CPLSetConfigOption("GDAL_CACHEMAX", "64");
  GDALRegister_GTiff();
  GDALRegister_AAIGrid();
  Raster raster;
  const char* const drivers[] = {"GTiff", "AAIGrid", nullptr};
  raster.dataset_ = Dataset(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, nullptr, nullptr));
  if (!raster.dataset_) return gdalFailure("is not a raster that can be read");
  if (GDALGetRasterCount(raster.dataset_.get()) < 1) return fail(ErrorCode::input, "has no bands");
  raster.band_ = GDALGetRasterBand(raster.dataset_.get(), 1);
  GDALGetGeoTransform(raster.dataset_.get(), raster.frame_);
  for (const double number : raster.frame_)
    if (!std::isfinite(number)) return fail(ErrorCode::input, "has a georeference that is not finite");
  return raster;
}

// "EPSG:3006" where the file names it, else a plain projection, else nothing.
std::string Raster::crs() const {
  OGRSpatialReferenceH system = GDALGetSpatialRef(dataset_.get());
  if (system == nullptr) return {};
  const char* authority = OSRGetAuthorityName(system, nullptr);
  const char* code = OSRGetAuthorityCode(system, nullptr);
  if (authority != nullptr && code != nullptr) return std::string(authority) + ":" + code;
  OGRSpatialReferenceH known = OSRClone(system);
  std::string name;
  if (OSRAutoIdentifyEPSG(known) == OGRERR_NONE && OSRGetAuthorityCode(known, nullptr) != nullptr)
    name = std::string("EPSG:") + OSRGetAuthorityCode(known, nullptr);
  OSRDestroySpatialReference(known);
  char* plain = nullptr;
  if (name.empty() && OSRExportToProj4(system, &plain) == OGRERR_NONE && plain != nullptr) name = plain;
  CPLFree(plain);
  return name;
}

Result<std::vector<float>> Raster::read(const Window& w) const {
  std::vector<float> heights(static_cast<std::size_t>(w.columns) * static_cast<std::size_t>(w.rows));
  if (GDALRasterIO(band_, GF_Read, w.column, w.row, w.columns, w.rows, heights.data(), w.columns, w.rows, GDT_Float32,
                   0, 0) != CE_None)
    return gdalFailure("is cut short or damaged");
  int hasNothing = 0;
  const auto nothing = static_cast<float>(GDALGetRasterNoDataValue(band_, &hasNothing));
  for (float& height : heights)
    if (!(std::abs(height) < kHighest) || (hasNothing != 0 && height == nothing))
      height = std::numeric_limits<float>::quiet_NaN();
  return heights;
}

struct Heights {
  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  std::size_t missing = 0;
  void add(float height) {
    if (std::isnan(height)) {
      ++missing;
    } else {
      lowest = std::min(lowest, double(height));
      highest = std::max(highest, double(height));
    }
  }
};

Result<Heights> heightsOf(const Raster& raster, const Window& window) {
  Heights all;
  for (int row = window.row; row < window.row + window.rows; row += kStrip) {
    const auto strip =
        raster.read({window.column, row, window.columns, std::min(kStrip, window.row + window.rows - row)});
    if (!strip) return tl::unexpected(strip.error());
    for (const float height : *strip) all.add(height);
  }
  return all;
}

Result<MapClaim> claimOf(const Raster& raster, const detail::Hints& hints) {
  if (hints.crs) return MapClaim{*hints.crs == "local" ? "" : geo::shortName(*hints.crs), "--crs"};
  return MapClaim{raster.crs(), "its georeference"};
}

// Projected degrees have a frame of their own and are lengths by now; who says --crs local means it.
Result<void> checkRaster(const Raster& raster, const MapClaim& claim, const MapFrame& frame, const Heights& heights) {
  if (frame.crs != claim.crs || (claim.crs.empty() && claim.from == "--crs")) return {};
  Extent extent;
  extent.add(raster.place(0, 0));
  extent.add(raster.place(raster.columns(), raster.rows()));
  const double cell = glm::length(raster.place(1, 0) - raster.place(0, 0));
  return checkCells(claim, frame, extent, cell, (heights.highest - heights.lowest) * frame.metresPerUnit);
}

scene::Scene emptyScene(const MapFrame& frame) {
  scene::Scene scene;
  scene.up = scene::UpAxis::z;
  scene.crs = frame.crs;
  scene.metresPerUnit = frame.metresPerUnit;
  scene.materials.push_back({"Terrain", colourOfType("TINRelief"), 1.0});
  return scene;
}

// The figures of io::inspectRaster as the points of a mesh.
Result<scene::Scene> inspected(const Raster& raster, const MapClaim& claim) {
  std::vector<Vec2> corners = {raster.place(0, 0), raster.place(raster.columns(), raster.rows())};
  const auto frame = placeOnMap(claim, corners, 0.0);
  if (!frame) return tl::unexpected(frame.error());
  if (frame->crs.starts_with("+proj=tmerc") && frame->crs != claim.crs)
    return fail(ErrorCode::unsupported, "is in degrees; convert it to a map's metres to read it tile by tile");
  const auto heights = heightsOf(raster, {0, 0, raster.columns(), raster.rows()});
  if (!heights) return tl::unexpected(heights.error());
  if (!(heights->lowest <= heights->highest)) return fail(ErrorCode::input, "has no cell with a height");
  if (auto fine = checkRaster(raster, claim, *frame, *heights); !fine) return tl::unexpected(fine.error());
  const double* f = raster.frame();
  auto mesh = std::make_shared<mesh::Mesh>();
  mesh->positions = {{raster.columns(), raster.rows(), 0},
                     {f[0], f[3], 0},
                     {f[1], f[4], 0},
                     {f[2], f[5], 0},
                     {heights->lowest, heights->highest, 0}};
  scene::Scene scene = emptyScene(*frame);
  scene.meshes.push_back(mesh);
  return scene;
}

// The cells of a tile and, around it, whatever may hide the sun from it while the sun is as high as asked.
struct Reach {
  Window core;
  double slope = 0.0;  // tangent of the least elevation, in heights of the file; 0: everything
  double floor = 0.0;  // lowest height in the core
  double cell = 1.0;   // side of a cell, the shorter one
  [[nodiscard]] bool keeps(int column, int row, double height) const {
    const int dx = std::max({core.column - column, column - (core.column + core.columns - 1), 0});
    const int dy = std::max({core.row - row, row - (core.row + core.rows - 1), 0});
    // One cell nearer than its middle, as a triangle reaches that far.
    const double far = (std::hypot(dx, dy) - 2.0) * cell;
    return far <= 0.0 || height - floor >= far * slope;
  }
};

Window windowAround(const Reach& reach, double highest, const Raster& raster) {
  const double rise = std::max(0.0, highest - reach.floor);
  const double cells = reach.slope > 0.0 ? rise / reach.slope / reach.cell + 3.0 : 1e9;
  const int most = std::max(raster.columns(), raster.rows());
  const int margin = static_cast<int>(std::min(cells, double(most)));
  const int left = std::max(0, reach.core.column - margin), top = std::max(0, reach.core.row - margin);
  return {left, top, std::min(raster.columns(), reach.core.column + reach.core.columns + margin) - left,
          std::min(raster.rows(), reach.core.row + reach.core.rows + margin) - top};
}

// The triangles of two rows of heights; corners are made when first used.
class Surface {
 public:
  Surface(const Raster& raster, const Window& window, const Reach* reach)
      : raster_(raster), window_(window), reach_(reach) {}

  void addRow(int row, const float* heights) {
    std::vector<std::uint32_t> corners(static_cast<std::size_t>(window_.columns), kNone);
    if (row > window_.row)
      for (int c = 0; c + 1 < window_.columns; ++c) addQuad(row, c, heights, corners);
    before_.assign(heights, heights + window_.columns);
    above_ = std::move(corners);
  }
  mesh::Mesh mesh;
  std::vector<Vec2> places;

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  void addQuad(int row, int c, const float* heights, std::vector<std::uint32_t>& corners) {
    const float nw = before_[c], ne = before_[c + 1], sw = heights[c], se = heights[c + 1];
    const int column = window_.column + c;
    addTriangle({nw, sw, se}, {{{c, row - 1}, {c, row}, {c + 1, row}}}, column, row, corners);
    addTriangle({nw, se, ne}, {{{c, row - 1}, {c + 1, row}, {c + 1, row - 1}}}, column, row, corners);
  }
  void addTriangle(const std::array<float, 3>& z, const std::array<std::array<int, 2>, 3>& at, int column, int row,
                   std::vector<std::uint32_t>& corners) {
    if (std::isnan(z[0]) || std::isnan(z[1]) || std::isnan(z[2])) return;
    if (reach_ != nullptr && !reach_->keeps(column, row, double(std::max({z[0], z[1], z[2]})))) return;
    mesh::Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& known = at[k][1] == row ? corners[at[k][0]] : above_[at[k][0]];
      if (known == kNone) {
        known = static_cast<std::uint32_t>(mesh.positions.size());
        places.push_back(raster_.place(window_.column + at[k][0] + 0.5, at[k][1] + 0.5));
        mesh.positions.emplace_back(places.back(), double(z[k]));
      }
      t[k] = known;
    }
    mesh.triangles.push_back(t);
  }

  const Raster& raster_;
  const Window& window_;
  const Reach* reach_;
  std::vector<float> before_;
  std::vector<std::uint32_t> above_;
};

Result<scene::Scene> surfaceOf(const Raster& raster, const Window& window, const Reach* reach, const MapClaim& claim) {
  Surface surface(raster, window, reach);
  Heights heights;
  for (int row = window.row; row < window.row + window.rows; row += kStrip) {
    const int count = std::min(kStrip, window.row + window.rows - row);
    const auto strip = raster.read({window.column, row, window.columns, count});
    if (!strip) return tl::unexpected(strip.error());
    for (const float height : *strip) heights.add(height);
    for (int r = 0; r < count; ++r)
      surface.addRow(row + r, strip->data() + std::size_t(r) * std::size_t(window.columns));
    if (surface.mesh.positions.size() > static_cast<std::size_t>(kMostCells))
      return fail(ErrorCode::input,
                  fmt::format("holds more than {} cells that matter at once; smaller tiles or a higher least "
                              "elevation of the sun need fewer",
                              kMostCells));
  }
  const auto frame = placeOnMap(claim, surface.places, 0.0);
  if (!frame) return tl::unexpected(frame.error());
  if (reach == nullptr)
    if (auto fine = checkRaster(raster, claim, *frame, heights); !fine) return tl::unexpected(fine.error());
  for (std::size_t i = 0; i < surface.places.size(); ++i)
    surface.mesh.positions[i] = Vec3(surface.places[i], surface.mesh.positions[i].z);
  scene::Scene scene = emptyScene(*frame);
  if (!frame->warning.empty()) scene.warnings.push_back(frame->warning);
  if (heights.missing > 0 && reach == nullptr)
    scene.warnings.push_back(fmt::format("{} of {} have no height: holes", heights.missing,
                                         counted(std::size_t(window.columns) * std::size_t(window.rows), "cell")));
  surface.mesh.name = "terrain";
  scene.instances.push_back({"terrain", 0, Mat4(1.0), true});
  scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(surface.mesh)));
  return scene;
}

Result<scene::Scene> tileOf(const Raster& raster, const detail::TileHint& tile, const MapClaim& claim) {
  Reach reach;
  reach.core = {std::clamp(tile.column, 0, raster.columns()), std::clamp(tile.row, 0, raster.rows()), 0, 0};
  reach.core.columns = std::clamp(tile.columns, 0, raster.columns() - reach.core.column);
  reach.core.rows = std::clamp(tile.rows, 0, raster.rows() - reach.core.row);
  if (reach.core.columns == 0 || reach.core.rows == 0) return fail(ErrorCode::usage, "has no such tile");
  const auto heights = heightsOf(raster, reach.core);
  if (!heights) return tl::unexpected(heights.error());
  reach.floor = std::min(heights->lowest, tile.highest);
  reach.slope = tile.slope;
  reach.cell = std::min(glm::length(raster.place(1, 0) - raster.place(0, 0)),
                        glm::length(raster.place(0, 1) - raster.place(0, 0)));
  return surfaceOf(raster, windowAround(reach, tile.highest, raster), &reach, claim);
}

}  // namespace

Result<scene::Scene> readRaster(const Request& request) {
  const auto raster = Raster::open(request.file);
  if (!raster) return tl::unexpected(raster.error());
  const auto claim = claimOf(*raster, request.hints);
  if (!claim) return tl::unexpected(claim.error());
  if (request.hints.inspectOnly) return inspected(*raster, *claim);
  if (request.hints.tile) {
    auto scene = tileOf(*raster, *request.hints.tile, *claim);
    return scene ? Result<scene::Scene>(tidy(std::move(*scene))) : scene;
  }
  const std::int64_t cells = std::int64_t{raster->columns()} * raster->rows();
  if (cells > kMostCells)
    return fail(
        ErrorCode::input,
        fmt::format("has {} cells, and a scene holds {}; umbrage terrain reads it tile by tile", cells, kMostCells));
  auto scene = surfaceOf(*raster, {0, 0, raster->columns(), raster->rows()}, nullptr, *claim);
  return scene ? Result<scene::Scene>(tidy(std::move(*scene))) : scene;
}

}  // namespace umbrage::io::reader
