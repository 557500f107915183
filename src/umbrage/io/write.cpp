#include "umbrage/io/write.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <string>

#include "umbrage/base/file.hpp"
#include "umbrage/io/writer/writers.hpp"

namespace umbrage::io {
namespace {

using writer::Document;

struct Format {
  std::string_view extension;
  Result<Document> (*write)(const scene::Scene&, const std::string& stem);
};

constexpr std::array kFormats{Format{"glb", writer::glb}, Format{"iv", writer::inventor},
                              Format{"city.json", writer::cityJson}, Format{"json", writer::cityJson},
                              Format{"obj", writer::obj}};

constexpr auto kExtensions = [] {
  std::array<std::string_view, kFormats.size()> extensions{};
  for (std::size_t i = 0; i < extensions.size(); ++i) extensions[i] = kFormats[i].extension;
  return extensions;
}();

const Format* formatOf(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats)
    if (name.size() > format.extension.size() + 1 && name.ends_with("." + std::string(format.extension)))
      return &format;
  return nullptr;
}

}  // namespace

std::span<const std::string_view> writableExtensions() { return kExtensions; }

Result<void> writeScene(const scene::Scene& scene, const std::filesystem::path& path) {
  const Format* format = formatOf(path);
  if (format == nullptr)
    return fail(ErrorCode::usage, "the file name must end with .glb, .iv, .city.json, .json or .obj", path.string());
  if (const auto fault = scene::findFault(scene))
    return fail(ErrorCode::input, "cannot be written: " + *fault, scene.source);
  auto document = format->write(scene, path.stem().string());
  if (!document) return fail(document.error().code, document.error().message, path.string());
  // The companion first: a scene file never stands there without it.
  if (!document->companion.empty()) {
    auto beside = path;
    if (auto written = writeFile(beside.replace_extension(document->companionExtension), document->companion); !written)
      return written;
  }
  return writeFile(path, document->content);
}

}  // namespace umbrage::io
