#include <algorithm>

#include <fmt/format.h>

#include "commands.hpp"
#include "json.hpp"
#include "judging.hpp"
#include "outputs.hpp"
#include "umbrage/png/png.hpp"

namespace umbrage::cli {
namespace {

struct CompareOptions {
  SceneOptions scene;
  ViewOptions view;
  std::string technique;
  std::string against;  ///< empty: the truth
  std::string picture;
  bool json = false;
};

struct Comparison {
  std::string technique, against;  ///< names, "auto" resolved
  std::vector<Agreement> lights;
  std::vector<VeilAgreement> veils;  ///< per light, where both show veils
  std::size_t unknown = 0;           ///< pixels on which one of them knows no shadows

  [[nodiscard]] bool agree() const {
    const auto holds = [](const auto& light) { return light.holds(); };
    return std::ranges::all_of(lights, holds) && std::ranges::all_of(veils, holds);
  }
};

std::string comparisonText(const Comparison& comparison, const View& view) {
  std::string text = fmt::format("{} against {}, {} x {} pixels\n", comparison.technique, comparison.against,
                                 view.camera.width, view.camera.height);
  for (std::size_t i = 0; i < comparison.lights.size(); ++i) {
    const auto& light = comparison.lights[i];
    text += fmt::format("light {:<3} {} of {} pixels differ, {} of them away from every edge, RMS error {:.4f}   {}\n",
                        i, light.differing, view.camera.width * view.camera.height, light.astray, light.rms,
                        shortName(view.lights[i].name));
    if (i < comparison.veils.size())
      text += fmt::format("          {} of {} surfaces that let light through, {} of them away from every edge\n",
                          comparison.veils[i].differing, comparison.veils[i].veils, comparison.veils[i].astray);
  }
  if (comparison.unknown > 0)
    text +=
        fmt::format("not compared: {} pixels, on surfaces that have no shadows by one of them\n", comparison.unknown);
  return text + (comparison.agree() ? "they agree\n" : "they do not agree\n");
}

std::string comparisonJson(const Comparison& comparison, const View& view) {
  Json json{{"technique", comparison.technique},
            {"against", comparison.against},
            {"size", {view.camera.width, view.camera.height}},
            {"agree", comparison.agree()},
            {"not_compared", comparison.unknown}};
  json["lights"] = Json::array();
  for (const auto& light : comparison.lights)
    json["lights"].push_back({{"differing", light.differing},
                              {"far_from_edge", light.astray},
                              {"covered", light.covered},
                              {"rms", light.rms}});
  for (std::size_t i = 0; i < comparison.veils.size(); ++i)
    json["lights"][i]["veils"] = {{"shown", comparison.veils[i].veils},
                                  {"differing", comparison.veils[i].differing},
                                  {"far_from_edge", comparison.veils[i].astray}};
  return jsonText(json);
}

Result<void> writePicture(const std::string& path, const Drawing& a, const Drawing& b) {
  if (path.empty()) return {};
  return writeOutputs({{path, [&](const std::string& file) { return png::write(file, differencePicture(a, b)); }}});
}

Result<void> checkPicture(const std::string& path, const std::string& scene) {
  if (path.empty()) return {};
  if (const auto png = checkExtension("-o", path, {".png"}); !png) return png;
  return checkOutputs({path}, scene);
}

Result<Outcome> run(const CompareOptions& options, const Console& console) {
  if (const auto open = checkPicture(options.picture, options.scene.file); !open) return tl::unexpected(open.error());
  auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  const auto view = makeView(std::move(*scene), options.view);
  if (!view) return tl::unexpected(view.error());
  const auto geometry = shadow::makeGeometry(view->scene);
  const auto a = draw(options.technique, geometry, *view, console);
  if (!a) return tl::unexpected(a.error());
  const auto b = draw(options.against.empty() ? truthFor(a->traits, *view) : options.against, geometry, *view, console);
  if (!b) return tl::unexpected(b.error());
  if (!geometry->filters.empty() && a->traits.tinted != b->traits.tinted)
    return fail(ErrorCode::usage,
                fmt::format("{} sees through surfaces that let light through, {} does not: they show different things",
                            (a->traits.tinted ? a : b)->traits.name, (a->traits.tinted ? b : a)->traits.name));
  if (const auto written = writePicture(options.picture, *a, *b); !written) return tl::unexpected(written.error());
  auto lights = compareDrawings(*a, *b, *view, geometry);
  if (!lights) return tl::unexpected(lights.error());
  auto veils = compareVeilsOf(*a, *b, *view, geometry);
  if (!veils) return tl::unexpected(veils.error());
  const Comparison comparison{a->traits.name, b->traits.name, std::move(*lights), std::move(*veils),
                              std::max(unknownPixels(*a), unknownPixels(*b))};
  return Outcome{options.json ? comparisonJson(comparison, *view) : comparisonText(comparison, *view),
                 comparison.agree() ? 0 : 1};
}

}  // namespace

Run addCompare(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  addSceneOptions(app, options->scene);
  addValue(app, "--technique", "A", "The technique to judge (see umbrage techniques)", options->technique,
           parseTechnique, {.required = true});
  addValue(app, "--against", "B",
           "The technique to compare it with (default: the truth, ray_traced or transparent_rays)", options->against,
           parseTechnique);
  addWord(app, "-o,--output", "OUT.png", "A picture of the differences, in red", options->picture);
  addFlag(app, "--json", "As JSON", options->json);
  addCameraOptions(app, options->view);
  addAmbientOption(app, options->view);
  addLightOptions(app, options->view);
  addGroundOption(app, options->view);
  addSilhouetteOption(app, options->view);
  addTechniqueOptions(app, options->view.techniques);
  addVeilOption(app, options->view);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
