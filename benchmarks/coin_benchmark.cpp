// Frames of a scene of Coin with exact shadows, beside Coin's own SoShadowGroup: one spot light, one model of 10,000 triangles on a floor, in one run.
//   build/release/bin/umbrage_coin_benchmark [WIDTH HEIGHT [brief]]
// Times are the least of many frames, in milliseconds, and end with a finish; those of the shadow engine's own clocks do not. brief: Coin alone and AUTOMATIC, no others.
#include <Inventor/annex/FXViz/nodes/SoShadowGroup.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSpotLight.h>
#include <Inventor/nodes/SoTranslation.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <string_view>
#include <tuple>
#include <vector>

#include "coin/stage.hpp"
#include "scenes/staged_scene.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/gl/pass.hpp"

namespace umbrage::coin::test {
namespace {

constexpr int kTurns = 6, kFrames = 4;

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

void leave(const Scene&, int) {}
void moveLight(const Scene& scene, int i) {
  scene.light->location = scene.light->location.getValue() + SbVec3f(i % 2 == 0 ? 0.01f : -0.01f, 0.0f, 0.0f);
}
void moveObject(const Scene& scene, int i) { scene.place->translation = SbVec3f(0.01f * float(i + 1), 0.0f, 0.0f); }
void touchAll(const Scene& scene, int) {
  for (int k = 0; k < scene.group->getNumChildren(); ++k) scene.group->getChild(k)->touch();
  scene.faces->touch();
  scene.floor->touch();
}

constexpr struct {
  const char* name;
  void (*change)(const Scene&, int);
} kCases[] = {{"nothing moves", leave},
              {"the light moves", moveLight},
              {"the object moves", moveObject},
              {"all is computed anew", touchAll}};
constexpr std::size_t kCaseCount = std::size(kCases);
constexpr std::size_t kAnew = kCaseCount - 1;

/// What else the machine does only adds.
double least(const std::vector<double>& values) { return values.empty() ? 0.0 : *std::ranges::min_element(values); }

/// What a frame of exact shadows is made of, in the order of ShadowReport::phases; Coin's own passes are the last.
constexpr const char* kPhases[] = {"scene", "geometry", "prepare", "shadows", "sets", "stencil", "drawing"};
constexpr std::size_t kPhaseCount = std::size(kPhases);
constexpr std::size_t kReady = 3;              // phases that make things ready: triangles, poses, casters
constexpr std::size_t kOwn = kPhaseCount - 1;  // phases of our own

/// Of all frames of one case.
struct Samples {
  std::vector<double> frames, ready, own;
  std::array<std::vector<double>, kPhaseCount> phases;
};
using AllSamples = std::array<Samples, kCaseCount>;

void addPhases(const ShadowReport& report, Samples& out) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kPhaseCount; ++k) {
    double here = 0.0;
    for (const shadow::PhaseTime& phase : report.phases)
      if (phase.name == kPhases[k]) here = phase.milliseconds;
    out.phases[k].push_back(here);
    sum += here;
    if (k + 1 == kReady) out.ready.push_back(sum);
    if (k + 1 == kOwn) out.own.push_back(sum);
  }
}

// The cases take turns, so that what else the machine does falls on all of them. Every second frame is counted: asking for the report of the one
// before would have emptied the processor's caches, and the first after another case differs from those that follow.
AllSamples sample(Stage& stage, const Scene& scene) {
  AllSamples all;
  const bool exact = scene.group->isOfType(SoExactShadowGroup::getClassTypeId()) != FALSE;
  for (int i = 0; i < 4; ++i) milliseconds(stage, scene.root.get());  // drivers compile shaders, Coin makes caches
  for (int turn = 0; turn < kTurns; ++turn) {
    for (std::size_t c = 0; c < kCaseCount; ++c) {
      for (int i = 0; i < 2 * kFrames; ++i) {
        kCases[c].change(scene, turn * 2 * kFrames + i);
        const double frame = milliseconds(stage, scene.root.get());
        if (i % 2 == 0) continue;
        all[c].frames.push_back(frame);
        if (exact) addPhases(static_cast<const SoExactShadowGroup*>(scene.group)->report(), all[c]);
      }
    }
  }
  return all;
}

std::array<double, kCaseCount> frameTimes(const AllSamples& samples) {
  std::array<double, kCaseCount> times{};
  for (std::size_t c = 0; c < kCaseCount; ++c) times[c] = least(samples[c].frames);
  return times;
}

void printFrames(const char* name, const std::array<double, kCaseCount>& times) {
  std::puts(name);
  for (std::size_t c = 0; c < kCaseCount; ++c) std::printf("  %-22s %8.1f\n", kCases[c].name, times[c]);
}

/// One way to say what a case costs.
struct Reading {
  const char* name;
  std::array<double, kCaseCount> times;
};

// Whole frames hold two passes of Coin, which no shadow engine can save; what is ours is told as a difference, and by our own clocks.
void printReadings(const AllSamples& samples, const std::array<double, kCaseCount>& coin) {
  Reading readings[] = {{"whole frames", frameTimes(samples)},
                        {"frames less those of Coin alone", {}},
                        {"frames less \"nothing moves\"", {}},
                        {"shadow engine, by its clocks", {}},
                        {"of it, made ready", {}},
                        {"of it, shadows", {}}};
  for (std::size_t c = 0; c < kCaseCount; ++c) {
    readings[1].times[c] = readings[0].times[c] - coin[c];
    readings[2].times[c] = readings[0].times[c] - readings[0].times[0];
    readings[3].times[c] = least(samples[c].own);
    readings[4].times[c] = least(samples[c].ready);
    readings[5].times[c] = least(samples[c].phases[kReady]);
  }
  std::printf("  %-32s %9s %9s %9s %9s   all anew : light, object\n", "", "nothing", "light", "object", "all anew");
  for (const Reading& r : readings) {
    std::printf("  %-32s", r.name);
    for (const double time : r.times) std::printf(" %9.2f", time);
    std::printf("   %6.1f %6.1f\n", r.times[kAnew] / r.times[1], r.times[kAnew] / r.times[2]);
  }
  for (std::size_t c = 0; c < kCaseCount; ++c) {
    std::printf("  %-22s", kCases[c].name);
    for (std::size_t k = 0; k < kPhaseCount; ++k) std::printf("  %s %.2f", kPhases[k], least(samples[c].phases[k]));
    std::printf("\n");
  }
}

void compareExact(Stage& stage, Parts (*parts)(), int method, const std::array<double, kCaseCount>& coin) {
  auto* group = new SoExactShadowGroup;
  group->method = method;
  const Scene scene = sceneIn(group, parts());
  milliseconds(stage, scene.root.get());
  if (group->lastError()) std::printf("%s\n", group->lastError()->text().c_str());
  std::printf("exact, by %s, %zu passes\n", group->report().method.c_str(), group->report().passes);
  printReadings(sample(stage, scene), coin);
}

void compareAll(Stage& stage, Parts (*parts)(), bool briefly) {
  const auto coin = frameTimes(sample(stage, sceneIn(new SoSeparator, parts())));
  printFrames("Coin without shadows", coin);
  compareExact(stage, parts, SoExactShadowGroup::AUTOMATIC, coin);
  if (briefly) return;
  compareExact(stage, parts, SoExactShadowGroup::RAY_TRACED, coin);
  compareExact(stage, parts, SoExactShadowGroup::Z_PASS, coin);
  for (const auto& [name, quality, precision] : {std::tuple{"SoShadowGroup as it comes", 0.5f, 0.5f},
                                                 std::tuple{"SoShadowGroup, quality 1, precision 1", 1.0f, 1.0f}}) {
    auto* group = new SoShadowGroup;
    group->quality = quality;
    group->precision = precision;
    printFrames(name, frameTimes(sample(stage, sceneIn(group, parts()))));
  }
}

}  // namespace
}  // namespace umbrage::coin::test

int main(int count, char** arguments) {
  using namespace umbrage::coin::test;
  const int width = count > 2 ? std::atoi(arguments[1]) : 1280, height = count > 2 ? std::atoi(arguments[2]) : 720;
  const bool briefly = count > 3 && std::string_view(arguments[3]) == "brief";
  const auto stage = Stage::make(width, height);
  if (!stage) {
    std::puts("no OpenGL here");
    return 4;
  }
  std::printf("%s, %d x %d\n", stage->context()->renderer().c_str(), width, height);
  std::puts("\n== a torus on a small floor");
  compareAll(*stage, torusParts, briefly);
  std::puts("\n== a knot on wide ground");
  compareAll(*stage, knotParts, briefly);
}
