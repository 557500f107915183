#include "umbrage/io/load.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <system_error>

#include "umbrage/io/detail/format.hpp"
#include "umbrage/io/detail/handover.hpp"
#include "umbrage/io/detail/printable.hpp"
#include "umbrage/io/detail/reader_process.hpp"

namespace umbrage::io {
namespace {

// Of the time allowed, what is kept back for checking the hand-over in this process.
constexpr double kReadersShare = 0.85;
constexpr std::size_t kLongestMessage = 400;
constexpr std::size_t kLongestName = 1000;

Result<void> checkOptions(const LoadOptions& options) {
  if (options.metresPerUnit && !(*options.metresPerUnit > 0.0 && std::isfinite(*options.metresPerUnit)))
    return fail(ErrorCode::usage, "the unit must be a positive number of metres");
  if (options.north && !std::isfinite(options.north->radians()))
    return fail(ErrorCode::usage, "north must be a finite angle");
  for (const double height : {options.defaultHeight.value_or(1.0), options.floorHeight})
    if (!(height > 0.0 && std::isfinite(height)))
      return fail(ErrorCode::usage, "the height of a building or floor must be a positive number of metres");
  if (options.alphaTexels < 1 || options.alphaTexels > 4096 ||
      !std::has_single_bit(static_cast<unsigned>(options.alphaTexels)))
    return fail(ErrorCode::usage, "cells of a texture must be 1, 2, 4, .. or 4096 texels on a side");
  if (options.timeLimit.count() <= 0) return fail(ErrorCode::usage, "the time limit must be positive");
  return {};
}

Result<void> checkFile(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return fail(ErrorCode::input, "cannot be opened: " + std::generic_category().message(errno), path.string());
  if (!S_ISREG(status.st_mode)) return fail(ErrorCode::input, "is not a regular file", path.string());
  if (::access(path.c_str(), R_OK) != 0)
    return fail(ErrorCode::input, "cannot be opened: " + std::generic_category().message(errno), path.string());
  return {};
}

std::string listOfExtensions() {
  std::string list;
  for (const std::string_view extension : detail::extensions())
    list += (list.empty() ? "." : " .") + std::string(extension);
  return list;
}

detail::Hints hintsOf(const LoadOptions& options) {
  detail::Hints hints{options.lod, options.crs, options.heightProperty, options.defaultHeight, options.floorHeight};
  if (const auto& t = options.tile) hints.tile = {t->column, t->row, t->columns, t->rows, t->leastSlope, t->highest};
  hints.inspectOnly = options.inspectOnly;
  hints.alphaTriangles = options.alphaTriangles;
  hints.alphaLevel = static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(options.alphaTexels)));
  return hints;
}

void makePrintable(scene::Scene& scene) {
  for (std::string& warning : scene.warnings) warning = detail::printable(warning, kLongestMessage);
  for (scene::Material& material : scene.materials) material.name = detail::printable(material.name, kLongestName);
  for (scene::Instance& instance : scene.instances) {
    instance.name = detail::printable(instance.name, kLongestName);
    instance.group = detail::printable(instance.group, kLongestName);
  }
  for (scene::Light& light : scene.lights) light.name = detail::printable(light.name, kLongestName);
  scene.crs = detail::printable(scene.crs, kLongestName);
}

// The file comes first in every message; the element the reader spoke of goes behind.
Error about(const std::filesystem::path& path, Error error) {
  if (!error.where.empty()) error.message += " (" + error.where + ")";
  error.message = detail::printable(error.message, kLongestMessage);
  error.where = path.string();
  return error;
}

}  // namespace

Result<scene::Scene> loadScene(const std::filesystem::path& path, const LoadOptions& options) {
  if (auto fine = checkOptions(options); !fine) return tl::unexpected(about(path, fine.error()));
  if (auto fine = checkFile(path); !fine) return tl::unexpected(fine.error());
  const auto format = detail::formatOf(path);
  if (!format)
    return fail(ErrorCode::unsupported,
                "is of a format that is not known by its extension; readable are " + listOfExtensions(), path.string());
  const auto readerTime = std::chrono::duration_cast<std::chrono::milliseconds>(options.timeLimit * kReadersShare);
  const auto bytes =
      detail::runReader({std::filesystem::absolute(path), hintsOf(options), readerTime, options.memoryLimit,
                         *format == detail::Format::raster ? detail::kRasterReader : detail::kReader});
  if (!bytes) return tl::unexpected(about(path, bytes.error()));
  auto scene = detail::unpack(*bytes);
  if (!scene) return tl::unexpected(about(path, scene.error()));
  scene->source = path.string();
  makePrintable(*scene);
  scene->up = options.up.value_or(scene->up);
  scene->metresPerUnit = options.metresPerUnit.value_or(scene->metresPerUnit);
  scene->northOffset = options.north.value_or(scene->northOffset);
  return scene;
}

std::span<const std::string_view> readableExtensions() { return detail::extensions(); }

}  // namespace umbrage::io
