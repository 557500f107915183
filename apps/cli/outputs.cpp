#include "outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "console.hpp"

namespace umbrage::cli {
namespace {

Result<void> checkWritable(const std::filesystem::path& path) {
  std::error_code ignored, fault;
  const auto status = std::filesystem::status(path, fault);
  if (fault == std::errc::filename_too_long)
    return fail(ErrorCode::output, "cannot be written: " + fault.message(), path.string());
  if (std::filesystem::is_directory(status)) return fail(ErrorCode::output, "is a folder, not a file", path.string());
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return fail(ErrorCode::output, "is not a regular file and is left alone", path.string());
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, ignored))
    return fail(ErrorCode::output, fmt::format("cannot be written: there is no folder {}", folder.string()),
                path.string());
  if (::access(folder.c_str(), W_OK) != 0)
    return fail(ErrorCode::output,
                fmt::format("cannot be written: the folder {} is closed to writing", folder.string()), path.string());
  return {};
}

// The same file: by one name, or through links.
bool sameFile(const std::string& a, const std::string& b) {
  std::error_code absent;
  return std::filesystem::equivalent(a, b, absent);
}

std::string absolute(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::weakly_canonical(path, ignored).string();
}

// The libraries of materials that an .obj names; they lie beside it.
std::vector<std::filesystem::path> materialsNamedBy(const std::string& scene) {
  std::vector<std::filesystem::path> named;
  if (!hasExtension(scene, ".obj")) return named;
  std::ifstream file(scene);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != "mtllib") continue;
    // Several names, or one with blanks in it.
    std::string rest;
    std::getline(words >> std::ws, rest);
    while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest.back())) != 0) rest.pop_back();
    const auto folder = std::filesystem::path(scene).parent_path();
    named.push_back(folder / rest);
    for (std::istringstream names(rest); names >> word;) named.push_back(folder / word);
  }
  return named;
}

// An .obj brings an .mtl of its name. One that is there without its .obj is somebody's, and so is one that the scene is read with.
Result<void> checkMaterials(const std::string& path, const std::string& input) {
  if (!hasExtension(path, ".obj")) return {};
  const auto materials = std::filesystem::path(path).replace_extension(".mtl");
  std::error_code ignored;
  if (!std::filesystem::exists(materials, ignored)) return {};
  for (const auto& named : materialsNamedBy(input))
    if (sameFile(named.string(), materials.string()))
      return fail(ErrorCode::usage,
                  fmt::format("would overwrite {}, which {} is read with; give the output another name",
                              materials.filename().string(), std::filesystem::path(input).filename().string()),
                  path);
  if (std::filesystem::exists(path, ignored)) return {};
  return fail(ErrorCode::usage,
              fmt::format("would overwrite {}, which belongs to something else; give the output another name",
                          materials.filename().string()),
              path);
}

}  // namespace

bool hasExtension(const std::string& path, std::string_view extension) {
  const auto alike = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return path.size() >= extension.size() && std::equal(extension.rbegin(), extension.rend(), path.rbegin(), alike);
}

Result<void> checkOutputs(const std::vector<std::string>& paths, const std::string& input) {
  std::vector<std::string> seen;
  for (const auto& path : paths) {
    if (sameFile(path, input))
      return fail(ErrorCode::usage, "is what the command reads; give the output another name", path);
    if (const auto writable = checkWritable(path); !writable) return writable;
    if (const auto free = checkMaterials(path, input); !free) return free;
    const auto place = absolute(path);
    if (std::find(seen.begin(), seen.end(), place) != seen.end())
      return fail(ErrorCode::usage, "is named for two outputs; give each its own name", path);
    seen.push_back(place);
  }
  return {};
}

Result<void> checkExtension(const std::string& option, const std::string& path,
                            const std::vector<std::string>& extensions) {
  const bool known = std::any_of(extensions.begin(), extensions.end(),
                                 [&](const std::string& extension) { return hasExtension(path, extension); });
  if (known) return {};
  return fail(ErrorCode::usage, fmt::format("{}: '{}' must end in {}", option, path, fmt::join(extensions, " or ")));
}

Result<void> writeOutputs(const std::vector<Output>& outputs) {
  const DeferredSignals whole;
  std::vector<std::string> written;
  for (const auto& output : outputs) {
    auto done = output.write(output.path);
    if (!done) {
      Error error = done.error();
      if (!written.empty()) error.message += fmt::format(" (written before it: {})", fmt::join(written, ", "));
      return tl::unexpected(error);
    }
    written.push_back(output.path);
  }
  return {};
}

}  // namespace umbrage::cli
