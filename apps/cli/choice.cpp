#include "choice.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "umbrage/techniques/cpu/registry.hpp"
#ifdef UMBRAGE_CLI_WITH_GL
#include "umbrage/gl/context.hpp"
#include "umbrage/techniques/gl/registry.hpp"
#endif

namespace umbrage::cli {
namespace {

const shadow::TechniqueEntry* find(const std::vector<shadow::TechniqueEntry>& entries, const std::string& name) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.traits.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

struct Choice {
  std::string name;
  std::string reason;
};

Choice chooseAutomatically() {
  const Graphics graphics = findGraphics();
  if (graphics.renderer.empty()) return {"ray_traced", fmt::format("auto: no graphics ({})", graphics.reason)};
  if (graphics.software)
    return {"ray_traced",
            fmt::format("auto: no GPU, OpenGL runs on the CPU ({}), where tracing rays is faster", graphics.renderer)};
  return {"zpass", fmt::format("auto: shadow volumes on the GPU ({})", graphics.renderer)};
}

}  // namespace

std::vector<shadow::TechniqueEntry> allTechniques() {
  auto entries = techniques::cpuTechniques();
#ifdef UMBRAGE_CLI_WITH_GL
  auto graphics = techniques::glTechniques();
  std::move(graphics.begin(), graphics.end(), std::back_inserter(entries));
#endif
  return entries;
}

Graphics findGraphics() {
#ifdef UMBRAGE_CLI_WITH_GL
  const auto context = gl::Context::createHeadless();
  if (!context) return {"", false, context.error().text()};
  return {(*context)->renderer(), (*context)->isSoftware(), ""};
#else
  return {"", false, "this build has no OpenGL"};
#endif
}

Result<std::string> parseTechnique(const std::string& word) {
  if (word == "auto") return word;
  std::string names = "auto";
  for (const auto& entry : allTechniques()) {
    if (entry.traits.name == word) return word;
    names += ", " + entry.traits.name;
  }
  return fail(ErrorCode::usage, fmt::format("there is no technique '{}'; there are {}", word, names));
}

Result<Chosen> chooseTechnique(const std::string& name) {
  const Choice choice = name == "auto" ? chooseAutomatically() : Choice{name, "as asked"};
  const auto entries = allTechniques();
  const auto* entry = find(entries, choice.name);
  if (entry == nullptr) return fail(ErrorCode::usage, fmt::format("there is no technique '{}'", choice.name));
  auto technique = entry->create();
  if (!technique) {
    Error error = technique.error();
    error.message = fmt::format("the technique {} cannot run here: {}", choice.name, error.text());
    error.where.clear();
    return tl::unexpected(error);
  }
  return Chosen{std::move(*technique), choice.reason};
}

}  // namespace umbrage::cli
