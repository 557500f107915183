#include "umbrage/radiosity/solve.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "commands.hpp"
#include "json.hpp"
#include "outputs.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/io/write_coloured.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/radiosity/picture.hpp"
#include "umbrage/shadow/composite.hpp"

namespace umbrage::cli {
namespace {

constexpr Manner kLight{.group = "Light between surfaces"};

struct RadiosityOptions {
  SceneOptions scene;
  ViewOptions view;
  radiosity::Options solve;
  std::optional<double> exposure;
  std::vector<std::string> outputs;
  std::string stats;
};

/// What a run has computed, and how long it took.
struct Lit {
  const View& view;
  radiosity::Solution solution;
  double exposure = 1.0;
  double loadMs = 0.0, solveMs = 0.0;
};

std::vector<std::string> files(const RadiosityOptions& options) {
  std::vector<std::string> paths = options.outputs;
  if (!options.stats.empty()) paths.push_back(options.stats);
  return paths;
}

Result<void> checkFiles(const RadiosityOptions& options) {
  for (const std::string& path : options.outputs)
    if (auto known = checkExtension("-o", path, {".png", ".glb", ".ply"}); !known) return known;
  if (files(options).empty()) return fail(ErrorCode::usage, "nothing to write: give -o OUT.png, OUT.glb or OUT.ply");
  return checkOutputs(files(options), options.scene.file);
}

// A sun that nobody asked for is no part of a scene that shines by itself.
void leaveOutTheDefaultSun(const RadiosityOptions& options, View& view) {
  const bool shines =
      std::ranges::any_of(view.scene.materials, [](const scene::Material& m) { return m.emission != Vec3(0.0); });
  if (!options.view.lights.empty() || !view.scene.lights.empty() || !shines) return;
  view.lights.clear();
  view.lightReason = "no light given: what shines by itself";
}

Json balanceJson(const radiosity::Balance& balance) {
  return {{"emitted", toJson(balance.emitted)},
          {"absorbed", toJson(balance.absorbed)},
          {"escaped", toJson(balance.escaped)},
          {"unshot", toJson(balance.unshot)},
          {"relative_error", balance.error()}};
}

std::string statsJson(const Lit& lit) {
  const radiosity::SolveStats& stats = lit.solution.stats;
  const Json json{{"umbrage", UMBRAGE_VERSION},
                  {"scene", lit.view.scene.source},
                  {"lights", lit.view.lights.size()},
                  {"light_reason", lit.view.lightReason},
                  {"triangles", lit.solution.surfaces->triangles.size()},
                  {"patches", stats.patches},
                  {"elements", stats.elements},
                  {"vertices", stats.vertices},
                  {"shots", stats.shots},
                  {"form_factors", stats.factors},
                  {"refinements", stats.refinements},
                  {"converged", stats.converged},
                  {"unshot_part", stats.unshotPart},
                  {"energy", balanceJson(lit.solution.balance)},
                  {"exposure", lit.exposure},
                  {"phases_ms", {{"load", lit.loadMs}, {"solve", lit.solveMs}}}};
  return jsonText(json);
}

std::string energyTable(const Lit& lit) {
  const radiosity::SolveStats& stats = lit.solution.stats;
  const radiosity::Balance& b = lit.solution.balance;
  std::string text = fmt::format("{} patches shot {} times at {} vertices of {} elements\n", stats.patches, stats.shots,
                                 stats.vertices, stats.elements);
  for (const auto& [name, light] : {std::pair("emitted", b.emitted), std::pair("absorbed", b.absorbed),
                                    std::pair("escaped", b.escaped), std::pair("unshot", b.unshot)})
    text += fmt::format("{:<9} {:12.4f} {:12.4f} {:12.4f}\n", name, light.x, light.y, light.z);
  return text + fmt::format("error     {:.4f} % of what was emitted\n", 100.0 * b.error());
}

/// What a vertex looks like: its exitance as bright as a picture shows it.
io::ColouredMesh colouredMesh(const Lit& lit) {
  radiosity::LitMesh mesh = radiosity::litMesh(lit.view.scene, lit.solution);
  io::ColouredMesh out{std::move(mesh.positions), std::move(mesh.triangles), {}, std::move(mesh.exitance)};
  out.colours.reserve(out.exitance.size());
  for (const Vec3f& light : out.exitance)
    out.colours.push_back(glm::clamp(static_cast<float>(lit.exposure) * light, 0.0f, 1.0f));
  return out;
}

Result<void> writePicture(const RadiosityOptions& options, const Lit& lit, const std::string& path) {
  scene::Camera camera = lit.view.camera;
  camera.width *= options.view.antialias, camera.height *= options.view.antialias;
  const auto picture = radiosity::paint(lit.view.scene, lit.solution, camera, {.exposure = lit.exposure});
  if (!picture) return tl::unexpected(picture.error());
  return png::write(path, options.view.antialias == 1 ? *picture : shadow::averaged(*picture, options.view.antialias));
}

std::vector<Output> outputs(const RadiosityOptions& options, const Lit& lit) {
  std::vector<Output> list;
  for (const std::string& path : options.outputs)
    list.push_back({path, [&options, &lit](const std::string& to) {
                      return hasExtension(to, ".png") ? writePicture(options, lit, to)
                                                      : io::writeColoured(colouredMesh(lit), lit.view.scene, to);
                    }});
  if (!options.stats.empty())
    list.push_back({options.stats, [&lit](const std::string& to) { return writeFile(to, statsJson(lit)); }});
  return list;
}

Result<Outcome> run(const RadiosityOptions& options, const Console& console) {
  if (const auto open = checkFiles(options); !open) return tl::unexpected(open.error());
  Stopwatch watch;
  auto scene = loadScene(options.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  auto view = makeView(std::move(*scene), options.view);
  if (!view) return tl::unexpected(view.error());
  leaveOutTheDefaultSun(options, *view);
  const double loadMs = watch.lap();
  radiosity::Options solve = options.solve;
  solve.lightSamples = view->soft.samples;
  auto solution = radiosity::solve(view->scene, view->lights, solve, console.progress());
  if (!solution) return fail(solution.error().code, solution.error().message, options.scene.file);
  if (options.view.smooth) solution = radiosity::smoothed(std::move(*solution), *options.view.smooth);
  const double exposure = options.exposure.value_or(radiosity::exposureOf(view->scene, *solution));
  const Lit lit{*view, std::move(*solution), exposure, loadMs, watch.lap()};
  if (const auto written = writeOutputs(outputs(options, lit)); !written) return tl::unexpected(written.error());
  return Outcome{energyTable(lit)};
}

Result<std::size_t> parseCount(std::string_view word) {
  const auto number = parseNumber(word, 1, 1e9);
  if (!number || *number != double(static_cast<std::size_t>(*number)))
    return fail(ErrorCode::usage, "must be a whole number from 1 to 1000000000");
  return static_cast<std::size_t>(*number);
}

auto numberIn(double low, double high) {
  return [low, high](const std::string& word) { return parseNumber(word, low, high); };
}

}  // namespace

Run addRadiosity(CLI::App& app) {
  const auto options = std::make_shared<RadiosityOptions>();
  addSceneOptions(app, options->scene);
  addValues(app, "-o,--output", "OUT",
            "A picture (.png), or the elements with their light as colours of vertices (.glb, .ply); repeatable",
            options->outputs, parseWord);
  addWord(app, "--stats", "STATS.json", "What was done, where the light has gone, and how long it took",
          options->stats);
  addValue(app, "--patch", "SIZE",
           "Edges of what gives off light, in the scene's unit (default: a fifth of its radius)", options->solve.patch,
           numberIn(1e-9, 1e9), kLight);
  addValue(app, "--element", "SIZE", "Edges of what receives it are cut no shorter (default: a sixteenth of --patch)",
           options->solve.element, numberIn(1e-9, 1e9), kLight);
  addValue(app, "--error", "E",
           "Elements are cut where light differs by more than this part of its mean; 0: never (default 0.1)",
           options->solve.error, numberIn(0, 100), kLight);
  addValue(app, "--unshot", "E", "Ends when so little of all light still waits to be given off (default 0.001)",
           options->solve.unshot, numberIn(1e-9, 1), kLight);
  addValue(app, "--shots", "N", "Or after so many patches have given off light: a first picture of a large scene",
           options->solve.mostShots, parseCount, kLight);
  addValue(app, "--exposure", "X", "What light is multiplied by, 1 being white (default: nearly all fits)",
           options->exposure, numberIn(1e-9, 1e9), kLight);
  addAntialiasOption(app, options->view);
  addCameraOptions(app, options->view);
  addLightOptions(app, options->view);
  addGroundOption(app, options->view);
  addValue(app, "--smooth", "CREASE_DEG",
           "Smooth light across edges of at most so many degrees, for example 30 (default: flat)", options->view.smooth,
           [](std::string_view word) { return parseDegrees(word, 0.0, 89.0); });
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli
