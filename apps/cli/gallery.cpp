#include "umbrage/report/gallery.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "commands.hpp"
#include "graphics.hpp"
#include "json.hpp"
#include "judging.hpp"
#include "output_folder.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/shadow/composite.hpp"

namespace umbrage::cli {
namespace {

constexpr const char* kPage = "index.html";
constexpr const char* kFigures = "gallery.json";
constexpr const char* kMark = "content=\"umbrage gallery\"";
constexpr double kMemory = 2.0 * 1024 * 1024 * 1024;
constexpr double kBytesPerPixel = 9.0;  // of a picture, a mask and a difference

struct GalleryOptions {
  SceneOptions scene;
  ViewOptions view;
  std::string folder;
  std::vector<std::string> techniques;  ///< empty: all
  int frames = 5;
};

/// What is to be written of one technique.
struct Shown {
  report::GalleryEntry entry;
  image::RgbImage picture, mask, difference;
};

Result<int> parseFrames(std::string_view word) {
  const auto number = parseNumber(word, 1, 1000);
  if (!number) return tl::unexpected(number.error());
  if (*number != std::floor(*number)) return fail(ErrorCode::usage, "must be a whole number, for example 5");
  return static_cast<int>(*number);
}

Result<std::string> parseName(const std::string& word) {
  if (word == "auto") return fail(ErrorCode::usage, "name a technique (see umbrage techniques)");
  return parseTechnique(word);
}

image::RgbImage coloured(const image::GreyImage& grey) {
  image::RgbImage out(grey.width(), grey.height());
  for (std::size_t i = 0; i < out.size(); ++i) out.pixels()[i] = {grey.pixels()[i], grey.pixels()[i], grey.pixels()[i]};
  return out;
}

/// Of the first light.
image::RgbImage maskPicture(const Drawing& drawing) {
  if (drawing.shading.masks.empty()) return {};
  const auto& mask = drawing.shading.masks.front();
  return mask.tint.empty() ? coloured(shadow::fileImage(mask)) : shadow::tintedFileImage(mask);
}

std::vector<std::string> words(const shadow::Traits& traits) {
  std::vector<std::string> list{traits.needsGraphics ? "OpenGL" : "processor"};
  if (traits.soft) list.emplace_back("soft shadows");
  if (traits.tinted) list.emplace_back("coloured glass");
  if (traits.approximate) list.emplace_back("approximate");
  if (traits.needsClosed) list.emplace_back("closed casters only");
  return list;
}

report::GalleryError summed(const std::string& truth, const std::vector<Agreement>& lights) {
  report::GalleryError error{.truth = truth};
  double squares = 0.0;
  for (const auto& light : lights) {
    error.differing += light.differing;
    error.astray += light.astray;
    error.covered += light.covered;
    squares += light.rms * light.rms * double(light.covered);
  }
  error.rms = error.covered == 0 ? 0.0 : std::sqrt(squares / double(error.covered));
  return error;
}

/// The techniques of one scene and view, each judged by its truth.
class Hall {
 public:
  Hall(const GalleryOptions& options, const View& view, const Console& console)
      : options_(options),
        view_(view),
        console_(console),
        geometry_(shadow::makeGeometry(view.scene)),
        opaque_(withoutVeils(geometry_)) {}

  [[nodiscard]] const shadow::Geometry& geometry() const { return *geometry_; }

  /// A technique that cannot run here, or not on this scene, has its reason instead of pictures.
  Result<Shown> show(const shadow::Traits& traits) {
    Shown shown;
    shown.entry = {.name = traits.name, .summary = traits.summary, .traits = words(traits)};
    const auto drawing = drawn(traits.name, traits.tinted);
    if (!drawing) {
      shown.entry.obstacle = drawing.error().text();
      return shown;
    }
    if (const auto judged = judge(traits, **drawing, shown); !judged) return tl::unexpected(judged.error());
    describe(**drawing, shown);
    return shown;
  }

 private:
  using Drawn = std::shared_ptr<const Drawing>;

  using GeometryPtr = std::shared_ptr<const shadow::Geometry>;
  /// To techniques that are not tinted every surface is opaque, so it must be to their truth.
  static GeometryPtr withoutVeils(const GeometryPtr& geometry) {
    if (geometry->filters.empty()) return geometry;
    return std::make_shared<const shadow::Geometry>(shadow::Geometry{geometry->surfaces, geometry->casters});
  }
  [[nodiscard]] const GeometryPtr& geometryFor(bool tinted) const { return tinted ? geometry_ : opaque_; }

  /// Truths are kept, for all that are judged by them.
  Result<Drawn> drawn(const std::string& name, bool tinted) {
    const std::pair key(name, tinted);
    if (const auto kept = truths_.find(key); kept != truths_.end()) return kept->second;
    auto drawing = draw(name, geometryFor(tinted), view_, console_, {static_cast<std::size_t>(options_.frames), true});
    if (!drawing) return tl::unexpected(drawing.error());
    auto made = std::make_shared<const Drawing>(std::move(*drawing));
    if (name == truthFor(made->traits, view_)) truths_.emplace(key, made);
    return made;
  }

  Result<void> judge(const shadow::Traits& traits, const Drawing& drawing, Shown& shown) {
    if (traits.name == truthFor(traits, view_) || view_.lights.empty()) return {};
    const auto truth = drawn(truthFor(traits, view_), traits.tinted);
    if (!truth) return tl::unexpected(truth.error());
    const auto lights = compareDrawings(drawing, **truth, view_, geometryFor(traits.tinted));
    if (!lights) return tl::unexpected(lights.error());
    shown.entry.error = summed((*truth)->traits.name, *lights);
    shown.entry.error->unknown = unknownPixels(drawing);
    shown.difference = differencePicture(drawing, **truth);
    shown.entry.difference = traits.name + "-difference.png";
    return {};
  }

  void describe(const Drawing& drawing, Shown& shown) const {
    shown.picture = shadow::composite(view_.scene, geometry_->surfaces, view_.camera, drawing.shading, view_.lights,
                                      {.ambient = options_.view.ambient});
    shown.mask = maskPicture(drawing);
    shown.entry.picture = drawing.traits.name + ".png";
    if (!shown.mask.empty()) shown.entry.mask = drawing.traits.name + "-mask.png";
    shown.entry.prepareMs = drawing.createMs + drawing.prepareMs;
    shown.entry.frameMs = drawing.shadeMs;
    shown.entry.frames = drawing.frames;
  }

  const GalleryOptions& options_;
  const View& view_;
  const Console& console_;
  GeometryPtr geometry_, opaque_;
  std::map<std::pair<std::string, bool>, Drawn> truths_;  ///< by name, and whether veils let light through
};

std::string lightsText(const View& view) {
  std::string text;
  for (const auto& light : view.lights) text += (text.empty() ? "" : ", ") + shortName(light.name);
  return text.empty() ? "none" : fmt::format("{} ({})", text, view.lightReason);
}

report::Gallery pageOf(const GalleryOptions& options, const View& view, const shadow::Geometry& geometry,
                       const std::vector<Shown>& shown, const Console& console) {
  const auto& casters = geometry.casters;
  const auto& camera = view.camera;
  const Graphics graphics = findGraphics();
  report::Gallery gallery;
  gallery.title = fmt::format("Shadows of {}", options.scene.file);
  gallery.facts = {
      {"scene",
       fmt::format("{} triangles; {} of them cast, in {} connected parts, {}", geometry.surfaces.triangles.size(),
                   casters.triangles.size(), casters.componentCount, mesh::name(casters.report.topology))},
      {"lights", lightsText(view)},
      {"camera",
       fmt::format("from {:.6g}, {:.6g}, {:.6g} to {:.6g}, {:.6g}, {:.6g}, {:.4g} degrees high; {} x {} pixels",
                   camera.eye.x, camera.eye.y, camera.eye.z, camera.target.x, camera.target.y, camera.target.z,
                   camera.fovY.degrees(), camera.width, camera.height)},
      {"graphics", graphics.renderer.empty() ? "none: " + graphics.reason : graphics.renderer},
      {"made by", "umbrage " UMBRAGE_VERSION}};
  gallery.command = console.commandLine();
  for (const auto& one : shown) gallery.entries.push_back(one.entry);
  return gallery;
}

Json entryJson(const report::GalleryEntry& entry) {
  Json json{{"name", entry.name}, {"summary", entry.summary}, {"traits", entry.traits}};
  json["obstacle"] = entry.obstacle.empty() ? Json(nullptr) : Json(entry.obstacle);
  if (!entry.obstacle.empty()) return json;
  json["error"] = nullptr;
  if (entry.error)
    json["error"] = {{"truth", entry.error->truth},          {"differing", entry.error->differing},
                     {"far_from_edge", entry.error->astray}, {"covered", entry.error->covered},
                     {"not_judged", entry.error->unknown},   {"rms", entry.error->rms}};
  json["prepare_ms"] = entry.prepareMs;
  json["frame_ms"] = entry.frameMs;
  json["frames"] = entry.frames;
  json["files"] = Json::object();
  for (const auto& [what, file] :
       {std::pair("picture", entry.picture), {"mask", entry.mask}, {"difference", entry.difference}})
    if (!file.empty()) json["files"][what] = file;
  return json;
}

std::string galleryJson(const report::Gallery& gallery) {
  Json json{{"umbrage", UMBRAGE_VERSION}, {"title", gallery.title}, {"command", gallery.command}};
  json["facts"] = Json::object();
  for (const auto& [what, value] : gallery.facts) json["facts"][what] = value;
  json["techniques"] = Json::array();
  for (const auto& entry : gallery.entries) json["techniques"].push_back(entryJson(entry));
  return jsonText(json);
}

std::vector<FolderFile> files(const std::vector<Shown>& shown, const report::Gallery& gallery) {
  std::vector<FolderFile> list;
  const auto add = [&](const std::string& name, const image::RgbImage& picture) {
    if (!name.empty())
      list.push_back({name, [&picture](const std::string& path) { return png::write(path, picture); }});
  };
  for (const auto& one : shown) {
    add(one.entry.picture, one.picture);
    add(one.entry.mask, one.mask);
    add(one.entry.difference, one.difference);
  }
  list.push_back({kFigures, [&gallery](const std::string& path) { return writeFile(path, galleryJson(gallery)); }});
  list.push_back(
      {kPage, [&gallery](const std::string& path) { return writeFile(path, report::galleryPage(gallery)); }});
  return list;
}

/// Those that were asked for, and the truths that they are judged by.
std::vector<shadow::Traits> asked(const GalleryOptions& options, const View& view) {
  const auto entries = allTechniques();
  const auto wanted = [&](const std::string& name) {
    return options.techniques.empty() || std::ranges::find(options.techniques, name) != options.techniques.end();
  };
  std::set<std::string> names;
  for (const auto& entry : entries)
    if (wanted(entry.traits.name)) names.insert({entry.traits.name, truthFor(entry.traits, view)});
  std::vector<shadow::Traits> list;
  for (const auto& entry : entries)
    if (names.contains(entry.traits.name)) list.push_back(entry.traits);
  return list;
}

Result<void> checkMemory(const Size& size, std::size_t techniques) {
  const double bytes = double(size.width) * double(size.height) * double(techniques) * kBytesPerPixel;
  if (bytes <= kMemory) return {};
  return fail(
      ErrorCode::usage,
      fmt::format(
          "--size: {} x {} pixels of {} techniques need {:.1f} GiB; choose a smaller --size or name fewer techniques",
          size.width, size.height, techniques, bytes / (1024.0 * 1024.0 * 1024.0)));
}

/// Whether a gallery, of this build or another, has files of such a name.
bool isOurs(const std::string& name) {
  if (name == kPage || name == kFigures) return true;
  constexpr std::string_view kPicture = ".png";
  if (!name.ends_with(kPicture)) return false;
  std::string_view technique(name.data(), name.size() - kPicture.size());
  for (const std::string_view kind : {"-mask", "-difference"})
    if (technique.ends_with(kind)) technique.remove_suffix(kind.size());
  return std::ranges::any_of(allTechniques(), [&](const auto& entry) { return entry.traits.name == technique; });
}

std::string summary(const GalleryOptions& options, const std::vector<Shown>& shown) {
  const auto obstructed = static_cast<std::size_t>(
      std::ranges::count_if(shown, [](const Shown& one) { return !one.entry.obstacle.empty(); }));
  std::string text = printable(fmt::format("{}/{}\n", options.folder, kPage));
  text += fmt::format("{} techniques shown", shown.size() - obstructed);
  if (obstructed != 0) text += fmt::format(", {} not (the page says why)", obstructed);
  return text + "\n";
}

Result<Outcome> run(const GalleryOptions& options, const Console& console) {
  if (const auto open = checkFolder(options.folder, {kPage, kMark, isOurs}); !open) return tl::unexpected(open.error());
  auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  const auto view = makeView(std::move(*scene), options.view);
  if (!view) return tl::unexpected(view.error());
  const auto techniques = asked(options, *view);
  if (const auto fits = checkMemory(options.view.size, techniques.size()); !fits) return tl::unexpected(fits.error());
  Hall hall(options, *view, console);
  std::vector<Shown> shown;
  for (const auto& traits : techniques) {
    auto one = hall.show(traits);
    if (!one) return tl::unexpected(one.error());
    shown.push_back(std::move(*one));
  }
  const auto gallery = pageOf(options, *view, hall.geometry(), shown, console);
  if (const auto written = writeFolder(options.folder, files(shown, gallery)); !written)
    return tl::unexpected(written.error());
  return Outcome{summary(options, shown), 0};
}

}  // namespace

Run addGallery(CLI::App& app) {
  const auto options = std::make_shared<GalleryOptions>();
  addSceneOptions(app, options->scene);
  addWord(app, "-o,--output", "DIR", "The folder of the page and its pictures; an earlier gallery there is replaced",
          options->folder, {.required = true});
  addValues(app, "--technique", "NAME", "Only this technique, and others named so (default: all)", options->techniques,
            parseName);
  addValue(app, "--frames", "N", "How many frames of each technique are timed at most, 1 to 1000 (default 5)",
           options->frames, parseFrames);
  addCameraOptions(app, options->view);
  addLightOptions(app, options->view);
  addGroundOption(app, options->view);
  addSilhouetteOption(app, options->view);
  addTechniqueOptions(app, options->view.techniques);
  addVeilOption(app, options->view);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
