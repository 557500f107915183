#include "umbrage/io/reader/read.hpp"

#include "umbrage/geo/projection.hpp"
#include "umbrage/io/reader/map_frame.hpp"
#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

Result<scene::Scene> readAs(const Request& request, detail::Format format) {
  switch (format) {
    case detail::Format::gltf: return readGltf(request);
    case detail::Format::inventor: return readInventor(request);
    case detail::Format::cityJson: return readCityJson(request);
    case detail::Format::cityJsonSeq: return readCityJsonSeq(request);
    case detail::Format::geoJson: return readGeoJson(request);
    case detail::Format::raster: return fail(ErrorCode::unsupported, "is read by umbrage-raster-reader");
    default: return readWithAssimp(request, format);
  }
}

bool isDouble(detail::Format format) {
  return format == detail::Format::cityJson || format == detail::Format::cityJsonSeq ||
         format == detail::Format::gltf || format == detail::Format::geoJson;
}

// Degrees were made metres, so that the file's own reference system is no longer the scene's.
bool isProjectedHere(const scene::Scene& scene) { return scene.crs.starts_with("+proj=tmerc"); }

}  // namespace

Result<scene::Scene> read(const Request& request) {
  const auto format = detail::formatOf(request.file);
  if (!format) return fail(ErrorCode::unsupported, "is of a format that is not known by its extension");
  auto scene = readAs(request, *format);
  if (!scene) return scene;
  scene::Scene tidied = tidy(std::move(*scene));
  if (request.hints.crs && !isProjectedHere(tidied))
    tidied.crs = *request.hints.crs == "local" ? "" : geo::shortName(*request.hints.crs);
  const bool inMetres = *format == detail::Format::cityJson || *format == detail::Format::cityJsonSeq;
  if (auto fine = checkLengths(tidied, inMetres && !request.hints.crs ? "CityJSON" : ""); !fine)
    return tl::unexpected(fine.error());
  if (!isDouble(*format)) warnOfCoarseness(tidied);
  return tidied;
}

}  // namespace umbrage::io::reader
