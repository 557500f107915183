#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "commands.hpp"
#include "drawing.hpp"
#include "graphics.hpp"
#include "outputs.hpp"
#include "stats.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/optics/tracer.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/shadow/composite.hpp"

namespace umbrage::cli {
namespace {

struct RenderOptions {
  SceneOptions scene;
  ViewOptions view;
  std::string technique = "auto";
  std::string picture, mask, stats;  ///< paths; empty: not asked for
  std::vector<std::string> show;     ///< what is drawn over the picture
  int reflections = 0, refractions = 0;
  std::optional<double> ior;  ///< of all that lets light through
};

/// Every file that is to be written.
std::vector<std::string> files(const RenderOptions& options, std::size_t lights) {
  std::vector<std::string> paths;
  if (!options.mask.empty()) paths = maskFiles(options.mask, lights);
  for (const auto& path : {options.picture, options.stats})
    if (!path.empty()) paths.push_back(path);
  return paths;
}

/// Whether the picture follows light that mirrors and clear solids turn.
bool isTurned(const RenderOptions& options) { return options.reflections > 0 || options.refractions > 0; }

Result<void> checkFiles(const RenderOptions& options) {
  if (options.picture.empty() && options.mask.empty() && options.stats.empty())
    return fail(ErrorCode::usage, "nothing to write: give -o OUT.png, --mask MASK.png or --stats STATS.json");
  if (options.view.hideTerminator && !options.view.smooth)
    return fail(ErrorCode::usage, "--hide-terminator is about smooth shading: give --smooth CREASE_DEG");
  constexpr std::array kByRays{"ray_traced", "transparent_rays", "soft_rays"};
  if (isTurned(options) && std::ranges::find(kByRays, options.technique) == kByRays.end())
    return fail(ErrorCode::usage,
                "--reflections and --refractions are of pictures by rays: give --technique ray_traced");
  if (options.ior && options.refractions == 0)
    return fail(ErrorCode::usage, "--ior is about light that is bent: give --refractions N");
  if (!options.show.empty() && options.picture.empty())
    return fail(ErrorCode::usage, "--show draws on the picture: give -o OUT.png");
  for (const auto& [option, path] : {std::pair("-o", options.picture), std::pair("--mask", options.mask)})
    if (!path.empty())
      if (const auto png = checkExtension(option, path, {".png"}); !png) return png;
  return checkOutputs(files(options, 1), options.scene.file);
}

std::vector<Output> outputs(const RenderOptions& options, const image::RgbImage& picture, const Stats& stats) {
  std::vector<Output> list;
  if (!options.picture.empty())
    list.push_back({options.picture, [&picture](const std::string& path) { return png::write(path, picture); }});
  const auto& masks = stats.drawing.shading.masks;
  const auto files = options.mask.empty() ? std::vector<std::string>() : maskFiles(options.mask, masks.size());
  for (std::size_t i = 0; i < files.size(); ++i)
    list.push_back({files[i], [&mask = masks[i]](const std::string& path) {
                      return mask.tint.empty() ? png::write(path, shadow::fileImage(mask))
                                               : png::write(path, shadow::tintedFileImage(mask));
                    }});
  if (!options.stats.empty())
    list.push_back({options.stats, [&stats](const std::string& path) { return writeFile(path, statsJson(stats)); }});
  return list;
}

/// The picture of one drawing.
Result<image::RgbImage> paint(const RenderOptions& options, const View& view,
                              const std::shared_ptr<const shadow::Geometry>& geometry, const Drawing& drawing) {
  shadow::SmoothNormals smooth;
  if (options.view.smooth) smooth = shadow::smoothNormals(geometry->surfaces, *options.view.smooth);
  const shadow::CompositeOptions look{.ambient = options.view.ambient,
                                      .smooth = options.view.smooth ? &smooth : nullptr,
                                      .hideTerminator = options.view.hideTerminator};
  auto picture = isTurned(options) ? optics::paint(view.scene, geometry, view.camera, view.lights,
                                                   {.reflections = options.reflections,
                                                    .refractions = options.refractions,
                                                    .lightSamples = view.soft.samples,
                                                    .look = look})
                                   : shadow::composite(view.scene, geometry->surfaces, view.camera, drawing.shading,
                                                       view.lights, look);
  if (!picture || options.show.empty()) return picture;
  return drawOver(*picture, options.show, *geometry, {view.camera, view.lights});
}

/// The picture asked for; empty when none is. Masks and statistics stay those of one sample a pixel.
Result<image::RgbImage> makePicture(const RenderOptions& options, const View& view,
                                    const std::shared_ptr<const shadow::Geometry>& geometry, const Drawing& drawing,
                                    const Console& console) {
  if (options.picture.empty()) return image::RgbImage();
  if (options.view.antialias == 1) return paint(options, view, geometry, drawing);
  View large = view;
  large.detailed = false;
  large.camera.width *= options.view.antialias;
  large.camera.height *= options.view.antialias;
  const auto fine = draw(options.technique, geometry, large, console);
  if (!fine) return tl::unexpected(fine.error());
  const auto picture = paint(options, large, geometry, *fine);
  if (!picture) return picture;
  return shadow::averaged(*picture, options.view.antialias);
}

Result<int> parseDepth(std::string_view word) {
  const auto number = parseNumber(word, 0, 32);
  if (!number || *number != double(static_cast<int>(*number)))
    return fail(ErrorCode::usage, "must be a whole number from 0 to 32");
  return static_cast<int>(*number);
}

Result<Outcome> run(const RenderOptions& options, const Console& console) {
  if (const auto open = checkFiles(options); !open) return tl::unexpected(open.error());
  Stopwatch watch;
  auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  const double loadMs = watch.lap();
  auto view = makeView(std::move(*scene), options.view);
  if (!view) return tl::unexpected(view.error());
  view->detailed = !options.stats.empty();
  if (options.ior)
    for (scene::Material& material : view->scene.materials)
      if (scene::transmittance(material) != Vec3(0.0)) material.ior = *options.ior;
  // Several lights have a mask each, whose names are known only now.
  if (const auto open = checkOutputs(files(options, view->lights.size()), options.scene.file); !open)
    return tl::unexpected(open.error());
  const auto geometry = shadow::makeGeometry(view->scene);
  const double geometryMs = watch.lap();
  const auto drawing = draw(options.technique, geometry, *view, console);
  if (!drawing) return tl::unexpected(drawing.error());
  watch.lap();
  const auto picture = [&] {
    const Stage stage(console, isTurned(options) ? "following reflections and refractions" : "painting");
    return makePicture(options, *view, geometry, *drawing, console);
  }();
  if (!picture) return tl::unexpected(picture.error());
  const Stats stats{*view,
                    *geometry,
                    *drawing,
                    {{"load", loadMs},
                     {"geometry", geometryMs},
                     {"start", drawing->createMs},
                     {"prepare", drawing->prepareMs},
                     {"shade", drawing->shadeMs},
                     {"picture", watch.lap()}}};
  console.detail(statsText(stats));
  if (const auto written = writeOutputs(outputs(options, *picture, stats)); !written)
    return tl::unexpected(written.error());
  return Outcome{};
}

}  // namespace

Run addRender(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  addSceneOptions(app, options->scene);
  addWord(app, "-o,--output", "OUT.png", "The picture", options->picture);
  addWord(app, "--mask", "MASK.png",
          "The light mask: 255 lit, 0 not, 128 no surface, in colours behind what lets light through; with several "
          "lights MASK-0.png, ...",
          options->mask);
  addWord(app, "--stats", "STATS.json", "What was done, why, and how long it took", options->stats);
  addValue(app, "--technique", "NAME|auto", "How shadows are computed (see umbrage techniques; default auto)",
           options->technique, parseTechnique);
  addValue(app, "--show", "WHAT", "Draws volumes, silhouette or both (with a comma) over the picture; needs graphics",
           options->show, [](const std::string& word) {
             return parseWords(word, {"volumes", "silhouette"});
           });
  addAntialiasOption(app, options->view);
  addCameraOptions(app, options->view);
  addAmbientOption(app, options->view);
  addLightOptions(app, options->view);
  addGroundOption(app, options->view);
  addSilhouetteOption(app, options->view);
  addTechniqueOptions(app, options->view.techniques);
  addVeilOption(app, options->view);
  addValue(app, "--smooth", "CREASE_DEG",
           "Smooth shading across edges of at most so many degrees, for example 30 (default: flat)",
           options->view.smooth, [](std::string_view word) { return parseDegrees(word, 0.0, 89.0); });
  addFlag(app, "--hide-terminator",
          "With --smooth: the border of a curved surface's own shadow does not show its facets; no mask changes",
          options->view.hideTerminator);
  addValue(app, "--reflections", "DEPTH",
           "Of pictures by rays: follows light over so many mirrors, 0 to 32 (default 0)", options->reflections,
           parseDepth);
  addValue(app, "--refractions", "DEPTH",
           "Of pictures by rays: light is bent at so many surfaces of clear solids, 0 to 32 (default 0: it goes "
           "straight on)",
           options->refractions, parseDepth);
  addValue(app, "--ior", "N",
           "Index of refraction of all that lets light through, 1 to 10, for example 1.5 (default: the file's own)",
           options->ior, [](std::string_view word) { return parseNumber(word, 1.0, 10.0); });
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
