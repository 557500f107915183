#include "umbrage/io/load.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <system_error>

#include "umbrage/io/detail/format.hpp"
#include "umbrage/io/detail/handover.hpp"
#include "umbrage/io/detail/reader_process.hpp"

namespace umbrage::io {
namespace {

// Of the time allowed, what is kept back for checking the hand-over in this process.
constexpr double kReadersShare = 0.85;

Result<void> checkOptions(const LoadOptions& options) {
  if (options.metresPerUnit && !(*options.metresPerUnit > 0.0 && std::isfinite(*options.metresPerUnit)))
    return fail(ErrorCode::usage, "the unit must be a positive number of metres");
  if (options.north && !std::isfinite(options.north->radians()))
    return fail(ErrorCode::usage, "north must be a finite angle");
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

// What comes from a file may reach a terminal: control characters would be obeyed there.
std::string printable(const std::string& text) {
  constexpr std::size_t kMost = 400;
  std::string clean;
  for (const char c : text) {
    const bool blank = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (clean.size() >= kMost) return clean + "...";
    if (!blank || (!clean.empty() && clean.back() != ' ')) clean += blank ? ' ' : c;
  }
  return clean;
}

// The file comes first in every message; the element the reader spoke of goes behind.
Error about(const std::filesystem::path& path, Error error) {
  if (!error.where.empty()) error.message += " (" + error.where + ")";
  error.message = printable(error.message);
  error.where = path.string();
  return error;
}

}  // namespace

Result<scene::Scene> loadScene(const std::filesystem::path& path, const LoadOptions& options) {
  if (auto fine = checkOptions(options); !fine) return tl::unexpected(about(path, fine.error()));
  if (auto fine = checkFile(path); !fine) return tl::unexpected(fine.error());
  if (!detail::formatOf(path))
    return fail(ErrorCode::unsupported,
                "is of a format that is not known by its extension; readable are " + listOfExtensions(), path.string());
  const auto readerTime = std::chrono::duration_cast<std::chrono::milliseconds>(options.timeLimit * kReadersShare);
  const auto bytes = detail::runReader({std::filesystem::absolute(path), options.lod, readerTime, options.memoryLimit});
  if (!bytes) return tl::unexpected(about(path, bytes.error()));
  auto scene = detail::unpack(*bytes);
  if (!scene) return tl::unexpected(about(path, scene.error()));
  scene->source = path.string();
  for (std::string& warning : scene->warnings) warning = printable(warning);
  scene->up = options.up.value_or(scene->up);
  scene->metresPerUnit = options.metresPerUnit.value_or(scene->metresPerUnit);
  scene->northOffset = options.north.value_or(scene->northOffset);
  return scene;
}

std::span<const std::string_view> readableExtensions() { return detail::extensions(); }

}  // namespace umbrage::io
