// Frames of a scene of Coin with exact shadows, beside Coin's own SoShadowGroup: one light, one model of 10,000 triangles on a floor, in one run.
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
#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/gl/pass.hpp"

namespace umbrage::coin::test {
namespace {

constexpr int kFrames = 15;

/// A torus with ripples: 100 x 50 quads, 10,000 triangles.
SoSeparator* model() {
  constexpr int kAround = 100, kAcross = 50;
  auto* points = new SoCoordinate3;
  auto* faces = new SoIndexedFaceSet;
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
  points->point.setValues(0, int(at.size()), at.data());
  faces->coordIndex.setValues(0, int(corners.size()), corners.data());
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;
  hints->creaseAngle = 3.0f;
  auto* node = new SoSeparator;
  for (SoNode* child : std::initializer_list<SoNode*>{hints, points, faces}) node->addChild(child);
  return node;
}

/// The scene in a group; what is moved can be reached.
struct Scene {
  Ref<> root;
  SoSeparator* group;
  SoSpotLight* light;
  SoTranslation* place;
  SoNode *faces, *floor;
};

Scene sceneIn(SoSeparator* group) {
  auto* camera = new SoPerspectiveCamera;
  camera->position = SbVec3f(0, 6, 9);
  camera->pointAt(SbVec3f(0, 0.3f, 0));
  camera->nearDistance = 1.0f;
  camera->farDistance = 40.0f;
  auto* light = new SoSpotLight;
  light->location = SbVec3f(3, 8, 2);
  light->direction = SbVec3f(-0.35f, -1.0f, -0.25f);
  light->cutOffAngle = 0.7f;
  auto* place = new SoTranslation;
  auto* object = new SoSeparator;
  SoSeparator* shape = model();
  object->addChild(place);
  object->addChild(shape);
  auto floor = sceneOf(
      "Separator { Complexity { value 0.5 } Material { diffuseColor 0.7 0.7 0.6 } Coordinate3 { point [ -6 -0.2 -6, -6 "
      "-0.2 6, 6 "
      "-0.2 6, 6 -0.2 -6 ] } IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] } }");
  group->addChild(light);
  group->addChild(object);
  group->addChild(floor.get());
  auto* root = new SoSeparator;
  Ref<> held = hold(root);
  root->addChild(camera);
  root->addChild(group);
  return {std::move(held), group, light, place, shape->getChild(2), floor->getChild(3)};
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

void moveLight(const Scene& scene, int i) { scene.light->location = SbVec3f(3.0f + 0.01f * float(i + 1), 8.0f, 2.0f); }
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

void compareAll(Stage& stage) {
  std::puts("Coin without shadows");
  rows(stage, sceneIn(new SoSeparator));
  for (const auto& [name, quality, precision] : {std::tuple{"SoShadowGroup as it comes", 0.5f, 0.5f},
                                                 std::tuple{"SoShadowGroup, quality 1, precision 1", 1.0f, 1.0f}}) {
    auto* group = new SoShadowGroup;
    group->quality = quality;
    group->precision = precision;
    std::puts(name);
    rows(stage, sceneIn(group));
  }
  for (const auto method :
       {SoExactShadowGroup::AUTOMATIC, SoExactShadowGroup::RAY_TRACED, SoExactShadowGroup::Z_PASS}) {
    auto* group = new SoExactShadowGroup;
    group->method = method;
    const Scene scene = sceneIn(group);
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
  compareAll(*stage);
}
