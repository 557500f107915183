// Frames of a scene of Coin with exact shadows, beside Coin's own SoShadowGroup: one spot light, one model of 10,000 triangles on a floor, in one run.
//   build/release/bin/umbrage_coin_benchmark [WIDTH HEIGHT]
// Times are medians, in milliseconds, and end with a finish.
#include <Inventor/annex/FXViz/nodes/SoShadowGroup.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSpotLight.h>
#include <Inventor/nodes/SoTranslation.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <numbers>
#include <string_view>
#include <tuple>
#include <vector>

#include "coin/stage.hpp"
#include "median.hpp"
#include "scenes/staged_scene.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/gl/pass.hpp"

namespace umbrage::coin::test {
namespace {

constexpr int kFrames = 15;

SoSeparator* shapeOf(const std::vector<SbVec3f>& points, const std::vector<std::int32_t>& corners) {
  auto* coordinates = new SoCoordinate3;
  coordinates->point.setValues(0, int(points.size()), points.data());
  auto* faces = new SoIndexedFaceSet;
  faces->coordIndex.setValues(0, int(corners.size()), corners.data());
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;
  hints->creaseAngle = 3.0f;
  auto* place = new SoTranslation;
  auto* node = new SoSeparator;
  for (SoNode* child : std::initializer_list<SoNode*>{place, hints, coordinates, faces}) node->addChild(child);
  return node;
}

SoSeparator* shapeOf(const mesh::Mesh& mesh) {
  std::vector<SbVec3f> points;
  std::vector<std::int32_t> corners;
  for (const Vec3& p : mesh.positions) points.emplace_back(float(p.x), float(p.y), float(p.z));
  for (const auto& t : mesh.triangles) corners.insert(corners.end(), {int(t[0]), int(t[1]), int(t[2]), -1});
  return shapeOf(points, corners);
}

/// A torus with ripples: 100 x 50 quads, 10,000 triangles.
SoSeparator* torus() {
  constexpr int kAround = 100, kAcross = 50;
  std::vector<SbVec3f> at;
  std::vector<std::int32_t> corners;
  for (int i = 0; i < kAround; ++i) {
    for (int k = 0; k < kAcross; ++k) {
      const double u = 2 * std::numbers::pi * i / kAround, v = 2 * std::numbers::pi * k / kAcross;
      const double r = 1.6 + (0.6 + 0.06 * std::sin(9 * u)) * std::cos(v);
      at.emplace_back(float(r * std::cos(u)), float(0.9 + 0.6 * std::sin(v)), float(r * std::sin(u)));
      const int next = (i + 1) % kAround, beside = (k + 1) % kAcross;
      const std::int32_t a = i * kAcross + k, b = next * kAcross + k, c = next * kAcross + beside,
                         d = i * kAcross + beside;
      corners.insert(corners.end(), {a, d, b, -1, d, c, b, -1});
    }
  }
  return shapeOf(at, corners);
}

/// What a scene is made of.
struct Parts {
  SoPerspectiveCamera* camera;
  SoSpotLight* light;
  SoSeparator *object, *floor;
};

/// A floor that takes up two fifths of the picture.
Parts torusParts() {
  auto* camera = new SoPerspectiveCamera;
  camera->position = SbVec3f(0, 6, 9);
  camera->pointAt(SbVec3f(0, 0.3f, 0));
  camera->nearDistance = 1.0f;
  camera->farDistance = 40.0f;
  auto* light = new SoSpotLight;
  light->location = SbVec3f(3, 8, 2);
  light->direction = SbVec3f(-0.35f, -1.0f, -0.25f);
  light->cutOffAngle = 0.7f;
  const std::vector<SbVec3f> corners{{-6, -0.2f, -6}, {-6, -0.2f, 6}, {6, -0.2f, 6}, {6, -0.2f, -6}};
  return {camera, light, torus(), shapeOf(corners, {0, 1, 2, 3, -1})};
}

SbVec3f single(const Vec3& v) { return {float(v.x), float(v.y), float(v.z)}; }

/// The grooved knot of the other benchmarks in 10,000 triangles, on ground that fills the picture.
Parts knotParts() {
  const benchmarks::StagedScene stage = benchmarks::groovedKnot(250, 20);
  const scene::Camera& view = stage.shots[0].camera;
  auto* camera = new SoPerspectiveCamera;
  camera->position = single(view.eye);
  camera->pointAt(single(view.target), SbVec3f(0, 0, 1));
  camera->heightAngle = float(view.fovY.radians());
  camera->nearDistance = 1.0f;
  camera->farDistance = 5000.0f;
  auto* light = new SoSpotLight;
  light->location = single(std::get<scene::PointLight>(stage.shots[0].light.shape).position);
  light->direction = single(view.target) - light->location.getValue();
  light->cutOffAngle = 0.9f;
  return {camera, light, shapeOf(*stage.scene.meshes[0]), shapeOf(*stage.scene.meshes[1])};
}

/// A scene in a group; what is moved can be reached.
struct Scene {
  Ref<> root;
  SoSeparator* group;
  SoSpotLight* light;
  SoTranslation* place;
  SoNode *faces, *floor;
};

Scene sceneIn(SoSeparator* group, const Parts& parts) {
  for (SoNode* child : std::initializer_list<SoNode*>{parts.light, parts.object, parts.floor}) group->addChild(child);
  auto* root = new SoSeparator;
  Ref<> held = hold(root);
  root->addChild(parts.camera);
  root->addChild(group);
  return {std::move(held),
          group,
          parts.light,
          static_cast<SoTranslation*>(parts.object->getChild(0)),
          parts.object->getChild(3),
          parts.floor->getChild(3)};
}

double milliseconds(Stage& stage, SoNode* root) {
  const auto start = std::chrono::steady_clock::now();
  stage.clear();
  stage.apply(root);
  gl::finish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

constexpr const char* kPhases[] = {"scene", "geometry", "prepare", "shadows", "drawing"};

/// Medians of a frame and, for exact shadows, of its phases. What goes before shadows are computed is what changes ask for.
struct Times {
  double frame = 0.0, update = 0.0;
  std::vector<double> phases;
};

double phaseOf(const ShadowReport& report, std::string_view name) {
  for (const shadow::PhaseTime& phase : report.phases)
    if (phase.name == name) return phase.milliseconds;
  return 0.0;
}

Times measure(Stage& stage, const Scene& scene, const std::function<void(const Scene&, int)>& change) {
  std::vector<double> frames, updates;
  std::vector<double> phases[std::size(kPhases)];
  const bool exact = scene.group->isOfType(SoExactShadowGroup::getClassTypeId()) != FALSE;
  for (int i = 0; i < kFrames; ++i) {
    change(scene, i);
    frames.push_back(milliseconds(stage, scene.root.get()));
    if (!exact) continue;
    const ShadowReport& report = static_cast<const SoExactShadowGroup*>(scene.group)->report();
    for (std::size_t k = 0; k < std::size(kPhases); ++k) phases[k].push_back(phaseOf(report, kPhases[k]));
    updates.push_back(phases[0].back() + phases[1].back() + phases[2].back());
  }
  Times times{benchmarks::median(frames), benchmarks::median(updates), {}};
  for (const auto& phase : phases)
    if (exact) times.phases.push_back(benchmarks::median(phase));
  return times;
}

void moveLight(const Scene& scene, int i) {
  scene.light->location = scene.light->location.getValue() + SbVec3f(i % 2 == 0 ? 0.01f : -0.01f, 0.0f, 0.0f);
}
void moveObject(const Scene& scene, int i) { scene.place->translation = SbVec3f(0.01f * float(i + 1), 0.0f, 0.0f); }
void leave(const Scene&, int) {}
void touchAll(const Scene& scene, int) {
  for (int k = 0; k < scene.group->getNumChildren(); ++k) scene.group->getChild(k)->touch();
  scene.faces->touch();
  scene.floor->touch();
}

void row(const char* name, const Times& times) {
  std::printf("  %-34s %8.1f", name, times.frame);
  if (times.update > 0.0) std::printf("   before shadows %6.2f :", times.update);
  for (std::size_t k = 0; k < times.phases.size(); ++k) std::printf("  %s %.2f", kPhases[k], times.phases[k]);
  std::printf("\n");
}

void rows(Stage& stage, const Scene& scene) {
  for (int i = 0; i < 4; ++i) milliseconds(stage, scene.root.get());  // drivers compile shaders, Coin makes caches
  row("nothing moves", measure(stage, scene, leave));
  row("the light moves", measure(stage, scene, moveLight));
  row("the object moves", measure(stage, scene, moveObject));
  row("all is computed anew", measure(stage, scene, touchAll));
}

void compareAll(Stage& stage, Parts (*parts)()) {
  std::puts("Coin without shadows");
  rows(stage, sceneIn(new SoSeparator, parts()));
  for (const auto& [name, quality, precision] : {std::tuple{"SoShadowGroup as it comes", 0.5f, 0.5f},
                                                 std::tuple{"SoShadowGroup, quality 1, precision 1", 1.0f, 1.0f}}) {
    auto* group = new SoShadowGroup;
    group->quality = quality;
    group->precision = precision;
    std::puts(name);
    rows(stage, sceneIn(group, parts()));
  }
  for (const auto method :
       {SoExactShadowGroup::AUTOMATIC, SoExactShadowGroup::RAY_TRACED, SoExactShadowGroup::Z_PASS}) {
    auto* group = new SoExactShadowGroup;
    group->method = method;
    const Scene scene = sceneIn(group, parts());
    milliseconds(stage, scene.root.get());
    if (group->lastError()) std::printf("%s\n", group->lastError()->text().c_str());
    std::printf("exact, by %s, %zu passes\n", group->report().method.c_str(), group->report().passes);
    rows(stage, scene);
  }
}

}  // namespace
}  // namespace umbrage::coin::test

int main(int count, char** arguments) {
  using namespace umbrage::coin::test;
  const int width = count > 2 ? std::atoi(arguments[1]) : 1280, height = count > 2 ? std::atoi(arguments[2]) : 720;
  const auto stage = Stage::make(width, height);
  if (!stage) {
    std::puts("no OpenGL here");
    return 4;
  }
  std::printf("%s, %d x %d\n", stage->context()->renderer().c_str(), width, height);
  std::puts("\n== a torus on a small floor");
  compareAll(*stage, torusParts);
  std::puts("\n== a knot on wide ground");
  compareAll(*stage, knotParts);
}
