#include "umbrage/report/detail/hours_tiff.hpp"

#include <vector>

#include "umbrage/base/file.hpp"

#ifdef UMBRAGE_HAVE_GDAL
#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <memory>
#endif

namespace umbrage::report::detail {

#ifdef UMBRAGE_HAVE_GDAL
namespace {

std::string reference(const std::string& crs) {
  if (crs.empty()) return {};
  const OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  std::string text;
  if (OSRSetFromUserInput(system, crs.c_str()) == OGRERR_NONE) {
    char* wkt = nullptr;
    if (OSRExportToWkt(system, &wkt) == OGRERR_NONE) text = wkt;
    CPLFree(wkt);
  }
  OSRDestroySpatialReference(system);
  return text;
}

Result<void> write(const study::HoursTable& table, const scene::Scene& scene, const std::filesystem::path& path) {
  const auto failed = [&] {
    return fail(ErrorCode::output, std::string("cannot be written: ") + CPLGetLastErrorMsg(), path.string());
  };
  const study::Lattice& l = table.set.lattice;
  const char* options[] = {"COMPRESS=DEFLATE", "PREDICTOR=3", nullptr};
  const GDALDatasetH file = GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), l.columns, l.rows, 1, GDT_Float32,
                                       const_cast<char**>(options));
  if (file == nullptr) return failed();
  double transform[6] = {l.west, l.step, 0.0, l.north, 0.0, -l.step};
  GDALSetGeoTransform(file, transform);
  if (const std::string wkt = reference(scene.crs); !wkt.empty()) GDALSetProjection(file, wkt.c_str());
  for (const study::LedgerLine& line : table.ledger) {
    std::string key = line.subject;
    for (char& c : key) c = c == ' ' || c == '=' ? '_' : c;
    GDALSetMetadataItem(file, ("UMBRAGE_" + key).c_str(), line.text.c_str(), nullptr);
  }
  const GDALRasterBandH band = GDALGetRasterBand(file, 1);
  GDALSetRasterNoDataValue(band, -9999.0);
  GDALSetDescription(band, "hours of sun");
  CPLErr fault = CE_None;
  std::vector<float> row(static_cast<std::size_t>(l.columns));
  for (int y = 0; y < l.rows && fault == CE_None; ++y) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      const std::int32_t r = l.receiver[static_cast<std::size_t>(y) * row.size() + x];
      row[x] = r < 0 ? -9999.0f : static_cast<float>(table.hours[static_cast<std::size_t>(r)]);
    }
    fault = GDALRasterIO(band, GF_Write, 0, y, l.columns, 1, row.data(), l.columns, 1, GDT_Float32, 0, 0);
  }
  CPLErrorReset();
  GDALClose(file);
  if (fault != CE_None || CPLGetLastErrorType() >= CE_Failure) return failed();
  return {};
}

}  // namespace

Result<void> writeHoursTiff(const study::HoursTable& table, const scene::Scene& scene,
                            const std::filesystem::path& path) {
  GDALAllRegister();
  CPLSetErrorHandler(CPLQuietErrorHandler);
  return writeFileWith(path, [&](const std::filesystem::path& temporary) { return write(table, scene, temporary); });
}
#else
Result<void> writeHoursTiff(const study::HoursTable&, const scene::Scene&, const std::filesystem::path& path) {
  return fail(ErrorCode::unsupported, "this build has no GDAL, which writes GeoTIFF", path.string());
}
#endif

}  // namespace umbrage::report::detail
