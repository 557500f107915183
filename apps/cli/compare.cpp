#include <algorithm>

#include <fmt/format.h>

#include "agreement.hpp"
#include "choice.hpp"
#include "commands.hpp"
#include "drawing.hpp"
#include "json.hpp"
#include "outputs.hpp"
#include "umbrage/png/png.hpp"
#include "veil_agreement.hpp"

namespace umbrage::cli {
namespace {

// The truth, without and with surfaces that let light through.
constexpr const char* kTruth = "ray_traced";
constexpr const char* kTintedTruth = "transparent_rays";
constexpr const char* kSoftTruth = "soft_rays";

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

  [[nodiscard]] bool agree() const {
    const auto holds = [](const auto& light) { return light.holds(); };
    return std::ranges::all_of(lights, holds) && std::ranges::all_of(veils, holds);
  }
};

// The mask of --against, pale, with every pixel that differs for any light in red.
image::RgbImage differencePicture(const Drawing& a, const Drawing& b) {
  const auto& seen = b.shading.surface.triangle;
  image::RgbImage picture(seen.width(), seen.height(), image::Rgb8{255, 255, 255});
  for (std::size_t light = 0; light < b.shading.masks.size(); ++light) {
    const auto mine = shadow::fileImage(a.shading.masks[light]);
    const auto theirs = shadow::fileImage(b.shading.masks[light]);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      auto& pixel = picture.pixels()[i];
      if (mine.pixels()[i] != theirs.pixels()[i])
        pixel = {220, 0, 0};
      else if (light == 0)
        pixel.r = pixel.g = pixel.b = static_cast<std::uint8_t>(160 + theirs.pixels()[i] / 3);
    }
  }
  return picture;
}

std::string comparisonText(const Comparison& comparison, const View& view) {
  std::string text = fmt::format("{} against {}, {} x {} pixels\n", comparison.technique, comparison.against,
                                 view.camera.width, view.camera.height);
  for (std::size_t i = 0; i < comparison.lights.size(); ++i) {
    const auto& light = comparison.lights[i];
    text +=
        fmt::format("light {:<3} {} of {} pixels differ, {} of them away from every edge   {}\n", i, light.differing,
                    view.camera.width * view.camera.height, light.astray, shortName(view.lights[i].name));
    if (i < comparison.veils.size())
      text += fmt::format("          {} of {} surfaces that let light through, {} of them away from every edge\n",
                          comparison.veils[i].differing, comparison.veils[i].veils, comparison.veils[i].astray);
  }
  return text + (comparison.agree() ? "they agree\n" : "they do not agree\n");
}

std::string comparisonJson(const Comparison& comparison, const View& view) {
  Json json{{"technique", comparison.technique},
            {"against", comparison.against},
            {"size", {view.camera.width, view.camera.height}},
            {"agree", comparison.agree()}};
  json["lights"] = Json::array();
  for (const auto& light : comparison.lights)
    json["lights"].push_back(
        {{"differing", light.differing}, {"far_from_edge", light.astray}, {"covered", light.covered}});
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

const char* truthFor(const Drawing& drawing) {
  return drawing.traits.soft ? kSoftTruth : drawing.traits.tinted ? kTintedTruth : kTruth;
}

Result<shadow::EdgeFinder> edgeFinderFor(const std::shared_ptr<const shadow::Geometry>& geometry,
                                         const std::string& name) {
  auto truth = chooseTechnique(name);
  if (!truth) return tl::unexpected(truth.error());
  if (const auto prepared = truth->technique->prepare(geometry); !prepared) return tl::unexpected(prepared.error());
  return shadow::EdgeFinder(geometry, std::move(truth->technique));
}

// The truth is the reference where it is one of the two, so that a lone wrong pixel is no edge of its own.
Result<std::vector<Agreement>> compareDrawings(const Drawing& a, const Drawing& b, const View& view,
                                               const std::shared_ptr<const shadow::Geometry>& geometry) {
  const auto edges = edgeFinderFor(geometry, truthFor(a));
  if (!edges) return tl::unexpected(edges.error());
  const bool swapped = a.traits.name == truthFor(a);
  const int tolerance = std::max(a.traits.edgeTolerancePx, b.traits.edgeTolerancePx);
  return compareMasks((swapped ? b : a).shading.masks, (swapped ? a : b).shading.masks, {view.camera, view.lights},
                      tolerance, *edges);
}

// The light on what lets light through, where both show any.
Result<std::vector<VeilAgreement>> compareVeilsOf(const Drawing& a, const Drawing& b, const View& view,
                                                  const std::shared_ptr<const shadow::Geometry>& geometry) {
  if (a.shading.veils.empty() && b.shading.veils.empty()) return std::vector<VeilAgreement>();
  const auto truth = chooseTechnique(truthFor(a));
  if (!truth) return tl::unexpected(truth.error());
  if (const auto prepared = truth->technique->prepare(geometry); !prepared) return tl::unexpected(prepared.error());
  const bool swapped = a.traits.name == truthFor(a);
  const shadow::Frame frame{
      .camera = view.camera, .lights = view.lights, .veilLayers = view.veilLayers, .soft = view.soft};
  return compareVeils((swapped ? b : a).shading, (swapped ? a : b).shading, frame,
                      std::max(a.traits.edgeTolerancePx, b.traits.edgeTolerancePx), *truth->technique);
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
  const auto b = draw(options.against.empty() ? truthFor(*a) : options.against, geometry, *view, console);
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
  const Comparison comparison{a->traits.name, b->traits.name, std::move(*lights), std::move(*veils)};
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
  addLightOptions(app, options->view);
  addGroundOption(app, options->view);
  addSilhouetteOption(app, options->view);
  addVeilOption(app, options->view);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
