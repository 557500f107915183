#include <algorithm>

#include <fmt/format.h>

#include "options.hpp"
#include "umbrage/io/load.hpp"
#include "umbrage/samples/samples.hpp"
#include "umbrage/study/georeference.hpp"

namespace umbrage::cli {
namespace {

constexpr std::string_view kSamplePrefix = "sample:";
constexpr std::size_t kNamesListed = 8;

Result<scene::Scene> makeSample(const SceneOptions& options) {
  auto scene = samples::make(std::string_view(options.file).substr(kSamplePrefix.size()));
  if (!scene) return scene;
  if (options.up) scene->up = *options.up;
  if (options.metresPerUnit) scene->metresPerUnit = *options.metresPerUnit;
  if (options.north) scene->northOffset = *options.north;
  return scene;
}

Result<scene::Scene> loadFile(const SceneOptions& options) {
  io::LoadOptions load;
  load.up = options.up;
  load.metresPerUnit = options.metresPerUnit;
  load.north = options.north;
  load.lod = options.lod;
  load.crs = options.crs;
  load.heightProperty = options.heightProperty;
  load.defaultHeight = options.defaultHeight;
  load.floorHeight = options.floorHeight.value_or(load.floorHeight);
  load.alphaTriangles = options.alphaTriangles.value_or(load.alphaTriangles);
  load.alphaTexels = static_cast<int>(options.alphaTexels.value_or(static_cast<std::size_t>(load.alphaTexels)));
  return io::loadScene(options.file, load);
}

std::string partNames(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const auto& instance : scene.instances) {
    const auto name = shortName(instance.name);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    if (names.size() > kNamesListed) break;
  }
  if (names.empty()) return "the scene has no parts";
  const bool more = names.size() > kNamesListed;
  if (more) names.pop_back();
  return fmt::format("there are {}{}", fmt::join(names, ", "), more ? ", ... (see umbrage info --json)" : "");
}

Result<void> checkPatterns(const scene::Scene& scene, const std::vector<std::string>& patterns) {
  for (const auto& pattern : patterns) {
    const bool found = std::any_of(scene.instances.begin(), scene.instances.end(),
                                   [&](const auto& instance) { return scene::matchesName(instance.name, pattern); });
    if (!found)
      return fail(ErrorCode::usage, fmt::format("--casters: no part is named '{}'; {}", pattern, partNames(scene)));
  }
  return {};
}

}  // namespace

Result<scene::Scene> loadScene(const SceneOptions& options) {
  auto scene = options.file.starts_with(kSamplePrefix) ? makeSample(options) : loadFile(options);
  if (scene && options.trueNorth) {
    const auto where = study::georeferenceOf(*scene);
    if (!where) return fail(where.error().code, "--north true: " + where.error().message, options.file);
    scene->northOffset = where->trueNorth;
  }
  if (!scene || options.casters.empty()) return scene;
  if (const auto known = checkPatterns(*scene, options.casters); !known) return tl::unexpected(known.error());
  return scene::withCasters(std::move(*scene), options.casters);
}

Result<void> checkCasts(const scene::Scene& scene, const SceneOptions& options) {
  if (!scene::bounds(scene, true).empty()) return {};
  return fail(ErrorCode::input, "has nothing that casts shadows", options.file);
}

Result<scene::Scene> loadScene(const SceneOptions& options, const Console& console) {
  auto scene = [&] {
    const Stage stage(console, fmt::format("reading {}", shortName(options.file)));
    return loadScene(options);
  }();
  if (!scene) return scene;
  for (const auto& warning : scene->warnings) console.warn(fmt::format("{}: {}", options.file, warning));
  return scene;
}

}  // namespace umbrage::cli
