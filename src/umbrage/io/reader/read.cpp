#include "umbrage/io/reader/read.hpp"

#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

Result<scene::Scene> readAs(const Request& request, detail::Format format) {
  switch (format) {
    case detail::Format::gltf: return readGltf(request);
    case detail::Format::inventor: return readInventor(request);
    case detail::Format::cityJson: return readCityJson(request);
    case detail::Format::cityJsonSeq: return readCityJsonSeq(request);
    default: return readWithAssimp(request, format);
  }
}

bool isDouble(detail::Format format) {
  return format == detail::Format::cityJson || format == detail::Format::cityJsonSeq || format == detail::Format::gltf;
}

}  // namespace

Result<scene::Scene> read(const Request& request) {
  const auto format = detail::formatOf(request.file);
  if (!format) return fail(ErrorCode::unsupported, "is of a format that is not known by its extension");
  auto scene = readAs(request, *format);
  if (!scene) return scene;
  scene::Scene tidied = tidy(std::move(*scene));
  if (!isDouble(*format)) warnOfCoarseness(tidied);
  return tidied;
}

}  // namespace umbrage::io::reader
