#include "umbrage/report/vector_map.hpp"

#include "umbrage/base/file.hpp"

namespace umbrage::report {

Result<void> writeMap(const VectorMap& map, const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  if (extension == ".geojson" || extension == ".json") return writeGeoJson(map, path);
  if (extension == ".dxf") return writeDxf(map, path);
  if (extension == ".svg") return writeSvg(map, path);
  return fail(ErrorCode::usage, "maps are written as .geojson, .dxf or .svg", path.string());
}

}  // namespace umbrage::report
