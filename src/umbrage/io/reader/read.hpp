#pragma once

#include <filesystem>

#include "umbrage/base/error.hpp"
#include "umbrage/io/detail/format.hpp"
#include "umbrage/io/detail/hints.hpp"
#include "umbrage/scene/scene.hpp"

// The inside of the program umbrage-reader. Only this folder sees assimp, tinygltf, Coin, GEOS, PROJ and the JSON library.
namespace umbrage::io::reader {

struct Request {
  std::filesystem::path file;
  detail::Hints hints;
};

/// The scene of any readable file, tidied (see tidy.hpp).
[[nodiscard]] Result<scene::Scene> read(const Request& request);

// One for each foreign parser. What they return may still hold numbers that are not finite and indices out of range.
[[nodiscard]] Result<scene::Scene> readGltf(const Request& request);
[[nodiscard]] Result<scene::Scene> readWithAssimp(const Request& request, detail::Format format);
[[nodiscard]] Result<scene::Scene> readInventor(const Request& request);
[[nodiscard]] Result<scene::Scene> readCityJson(const Request& request);
[[nodiscard]] Result<scene::Scene> readCityJsonSeq(const Request& request);
[[nodiscard]] Result<scene::Scene> readGeoJson(const Request& request);
/// Of umbrage-raster-reader; tidied.
[[nodiscard]] Result<scene::Scene> readRaster(const Request& request);

}  // namespace umbrage::io::reader
