#include "choice.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "graphics.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

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
  std::string renderer;
};

Choice chooseAutomatically(Needs needs) {
  if (needs.soft) return {"soft_cpu", "auto: there are lights with an extent", ""};
  if (needs.tinted) return {"transparent_cpu", "auto: there are surfaces that let light through", ""};
  const Graphics graphics = findGraphics();
  if (graphics.renderer.empty()) return {"hybrid_cpu", fmt::format("auto: no graphics ({})", graphics.reason), ""};
  if (graphics.software)
    return {"hybrid_cpu",
            fmt::format("auto: no GPU, and our own rasteriser is faster than OpenGL on the processor ({})",
                        graphics.renderer),
            graphics.renderer};
  return {"zpass", fmt::format("auto: shadow volumes on the GPU ({})", graphics.renderer), graphics.renderer};
}

}  // namespace

std::vector<shadow::TechniqueEntry> allTechniques(const TechniqueOptions& options) {
  auto entries = techniques::cpuTechniques();
  auto graphics = graphicsTechniques(options);
  std::move(graphics.begin(), graphics.end(), std::back_inserter(entries));
  return entries;
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

Result<Chosen> chooseTechnique(const std::string& name, Needs needs, const TechniqueOptions& options) {
  const Choice choice = name == "auto" ? chooseAutomatically(needs) : Choice{name, "as asked", ""};
  const auto entries = allTechniques(options);
  const auto* entry = find(entries, choice.name);
  if (entry == nullptr) return fail(ErrorCode::usage, fmt::format("there is no technique '{}'", choice.name));
  auto technique = entry->create();
  if (!technique) {
    Error error = technique.error();
    error.message = fmt::format("the technique {} cannot run here: {}", choice.name, error.text());
    error.where.clear();
    return tl::unexpected(error);
  }
  const bool named = name != "auto" && entry->traits.needsGraphics;
  return Chosen{std::move(*technique), choice.reason, named ? findGraphics().renderer : choice.renderer};
}

}  // namespace umbrage::cli
