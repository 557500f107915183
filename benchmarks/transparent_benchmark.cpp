// Frames with coloured transparent casters beside the opaque shadow volumes of the same scene, on the processor and by OpenGL: paired rounds in one run, 1280 x 720.
//   build/release/bin/umbrage_transparent_benchmark [ROUNDS [NAME]]   cases whose name has NAME in it
// Times are medians, in milliseconds; ratios are those of the medians.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "median.hpp"
#include "scenes/staged_scene.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/techniques/cpu/registry.hpp"
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
#include "umbrage/techniques/gl/transparent.hpp"
#include "umbrage/techniques/gl/zpass.hpp"
#endif

namespace umbrage::benchmarks {
namespace {

std::unique_ptr<shadow::Technique> technique(const std::string& name) {
  for (const auto& entry : techniques::cpuTechniques())
    if (entry.traits.name == name) return std::move(*entry.create());
  return nullptr;
}

/// Every triangle's material is `pick(triangle)`, of all meshes that cast.
scene::Scene withMaterials(scene::Scene scene, const std::function<std::uint32_t(std::size_t)>& pick) {
  const auto first = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back({"opaque", Vec3(0.7), 1.0});
  scene.materials.push_back({"red", Vec3(0.9, 0.2, 0.15), 0.4});
  scene.materials.push_back({"green", Vec3(0.3, 0.85, 0.4), 0.3});
  scene.materials.push_back({"blue", Vec3(0.3, 0.5, 0.95), 0.5});
  for (const scene::Instance& instance : scene.instances) {
    if (!instance.casts) continue;
    auto mesh = std::make_shared<mesh::Mesh>(*scene.meshes[instance.mesh]);
    mesh->materials.clear();
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) mesh->materials.push_back(first + pick(t));
    scene.meshes[instance.mesh] = std::move(mesh);
  }
  return scene;
}

struct Case {
  std::string name;
  scene::Scene scene;
  scene::Camera camera;
  scene::Light light;
};

Case staged(std::string name, StagedScene stage, std::size_t shot,
            const std::function<std::uint32_t(std::size_t)>& pick) {
  return {std::move(name), withMaterials(std::move(stage.scene), pick), stage.shots[shot].camera,
          stage.shots[shot].light};
}

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back(staged("knot of one glass, 64,800", groovedKnot(), 0, [](std::size_t) { return 3u; }));
  all.push_back(staged("knot of three glasses, 64,800", groovedKnot(), 0,
                       [](std::size_t t) { return 1u + static_cast<std::uint32_t>(t / 5400 % 3); }));
  all.push_back(staged("knot of one glass, 10,000", groovedKnot(250, 20), 0, [](std::size_t) { return 3u; }));
  const auto everyEighth = [](std::size_t t) {
    return t / 12 % 8 == 0 ? 1u + static_cast<std::uint32_t>(t / 96 % 3) : 0u;
  };
  all.push_back(staged("city, every eighth house of glass, from the air", city(), 0, everyEighth));
  all.push_back(staged("city, every eighth house of glass, in a street", city(), 1, everyEighth));
  return all;
}

/// Milliseconds: the masks, and with the picture.
struct Times {
  double masks, picture;
};

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Times once(shadow::Technique& technique, const Case& c, const shadow::Geometry& geometry, std::optional<int> layers) {
  const auto start = std::chrono::steady_clock::now();
  // The eye moves, hardly, so that nothing of the picture before is kept.
  static int frame = 0;
  scene::Camera camera = c.camera;
  camera.eye += 1e-9 * (++frame % 2) * (camera.target - camera.eye);
  const auto shading = technique.shade({.camera = camera, .lights = {&c.light, 1}, .veilLayers = layers});
  const double masks = since(start);
  if (!shading) return std::puts(shading.error().text().c_str()), Times{};
  const auto picture = shadow::composite(c.scene, geometry.surfaces, c.camera, *shading, {&c.light, 1});
  return {masks, since(start)};
}

void measure(Case c, int rounds) {
  c.camera.width = 1280, c.camera.height = 720;
  const auto geometry = shadow::makeGeometry(c.scene);
  const auto opaque = technique("zpass_cpu"), tinted = technique("transparent_cpu");
  if (!opaque->prepare(geometry) || !tinted->prepare(geometry)) return;
  std::vector<double> masks[3], pictures[3];
  for (int i = -1; i < rounds; ++i) {
    const Times t[3] = {once(*opaque, c, *geometry, {}), once(*tinted, c, *geometry, 0),
                        once(*tinted, c, *geometry, {})};
    for (int k = 0; k < 3 && i >= 0; ++k) masks[k].push_back(t[k].masks), pictures[k].push_back(t[k].picture);
  }
  const auto plain = opaque->shade({.camera = c.camera, .lights = {&c.light, 1}});
  const auto quick = tinted->shade({.camera = c.camera, .lights = {&c.light, 1}, .veilLayers = 0});
  const auto shading = tinted->shade({.camera = c.camera, .lights = {&c.light, 1}});
  fmt::print("{}; {:.2f} veils a pixel\n", c.name, double(shading->veils.veils.size()) / (1280.0 * 720.0));
  for (const auto& [what, times] : {std::pair{"masks", masks}, {"with the picture", pictures}}) {
    const double base = median(times[0]), fast = median(times[1]), full = median(times[2]);
    fmt::print("  {:18} opaque {:6.1f}   without self-shadows {:6.1f} ({:.2f}x)   with {:6.1f} ({:.2f}x)\n", what, base,
               fast, fast / base, full, full / base);
  }
  for (const auto* one : {&plain, &quick, &shading}) {
    for (const auto& phase : (*one)->stats.phases) fmt::print("    {} {:.1f}", phase.name, phase.milliseconds);
    fmt::print("\n");
  }
}

#ifdef UMBRAGE_HAVE_TECHNIQUES_GL

/// Whole frames by OpenGL: masks in main memory, and pictures that stay on the graphics card.
struct GlWay {
  const char* name;
  std::unique_ptr<render::GlTechnique> technique;
  std::optional<int> layers;
  std::vector<double> masks = {}, pictures = {};
};

void frameBy(GlWay& way, const Case& c, render::GpuFrame& target, bool counts) {
  const shadow::Frame frame{.camera = c.camera, .lights = {&c.light, 1}, .veilLayers = way.layers};
  const render::PictureOptions options{.materials = c.scene.materials, .up = scene::upVector(c.scene.up)};
  auto start = std::chrono::steady_clock::now();
  const auto shading = way.technique->shade(frame);
  const double masks = since(start);
  if (!shading) return void(std::puts(shading.error().text().c_str()));
  start = std::chrono::steady_clock::now();
  if (auto done = way.technique->draw(target, frame, options); !done)
    return void(std::puts(done.error().text().c_str()));
  gl::finish();
  if (counts) way.masks.push_back(masks), way.pictures.push_back(since(start));
}

void measureGl(Case c, int rounds) {
  c.camera.width = 1280, c.camera.height = 720;
  auto context = gl::Context::createHeadless();
  if (!context) return void(std::puts(context.error().text().c_str()));
  const gl::CurrentContext current(*context);
  const auto geometry = shadow::makeGeometry(c.scene);
  std::vector<GlWay> ways;
  ways.push_back({"zpass", techniques::makeZPass(*context), {}});
  ways.push_back({"without self-shadows", techniques::makeTransparent(*context), 0});
  ways.push_back({"with", techniques::makeTransparent(*context), {}});
  ways.push_back({"by z-fail, without", techniques::makeTransparentZFail(*context), 0});
  ways.push_back({"by z-fail, with", techniques::makeTransparentZFail(*context), {}});
  auto target = render::GpuFrame::make(1280, 720);
  if (!target) return;
  for (GlWay& way : ways)
    if (!way.technique->prepare(geometry)) return;
  for (int i = -1; i < rounds; ++i)
    for (GlWay& way : ways) frameBy(way, c, *target, i >= 0);
  fmt::print("{}, OpenGL ({})\n", c.name, (*context)->renderer());
  for (GlWay& way : ways) {
    const double masks = median(way.masks), pictures = median(way.pictures);
    fmt::print("  {:22} masks {:6.1f} ({:.2f}x)   pictures {:6.1f} ({:.2f}x)\n", way.name, masks,
               masks / median(ways[0].masks), pictures, pictures / median(ways[0].pictures));
    const auto shading = way.technique->shade({.camera = c.camera, .lights = {&c.light, 1}, .veilLayers = way.layers});
    for (const auto& phase : shading->stats.phases) fmt::print("    {} {:.1f}", phase.name, phase.milliseconds);
    fmt::print("\n");
  }
}

#endif

}  // namespace
}  // namespace umbrage::benchmarks

int main(int count, char** arguments) {
  using namespace umbrage::benchmarks;
  const int rounds = count > 1 ? std::atoi(arguments[1]) : 9;
  for (Case& c : cases())
    if (count < 3 || c.name.find(arguments[2]) != std::string::npos) {
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
      measureGl(c, rounds);
#endif
      measure(std::move(c), rounds);
    }
}
