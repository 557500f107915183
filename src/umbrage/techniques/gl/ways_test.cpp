// The ways to find silhouettes and to extrude them, which must change no shadow: each against brute force.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/asking.hpp"
#include "support/village.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/render/depth_bounds.hpp"
#include "umbrage/techniques/gl/registry.hpp"
#include "umbrage/techniques/gl/zfail.hpp"
#include "umbrage/techniques/gl/zpass.hpp"

namespace umbrage::techniques {
namespace {

using namespace support;

struct Way {
  const char* name;
  std::size_t technique;  ///< in the registry
  Asking::Ask ask;
};

Asking::Ask byGpu(shadow::VolumeFill fill = shadow::VolumeFill::reduced) {
  return [fill](shadow::Frame& frame) {
    frame.silhouettes = shadow::FinderKind::gpu;
    frame.fill = fill;
  };
}

Asking::Ask extrudedBy(shadow::Extrusion extrusion, shadow::FinderKind finder = shadow::FinderKind::automatic) {
  return [=](shadow::Frame& frame) {
    frame.extrusion = extrusion;
    frame.silhouettes = finder;
  };
}

enum Registered : std::size_t { zFail, zPass, zMixed, zPlus, brute };

std::vector<Way> ways() {
  using enum shadow::FinderKind;
  using shadow::Extrusion;
  return {{"zfail_gpu", zFail, byGpu()},
          {"zpass_gpu", zPass, byGpu()},
          {"zp_plus_gpu", zPlus, byGpu()},
          {"zpass_gpu_plain", zPass, byGpu(shadow::VolumeFill::plain)},
          {"zfail_by_processor", zFail, extrudedBy(Extrusion::processor)},
          {"brute_by_processor", brute, extrudedBy(Extrusion::processor)},
          {"brute_by_geometry_shader", brute, extrudedBy(Extrusion::geometryShader)},
          {"zpass_by_processor", zPass, extrudedBy(Extrusion::processor)},
          {"zpass_by_geometry_shader", zPass, extrudedBy(Extrusion::geometryShader)},
          {"zfail_gpu_by_geometry_shader", zFail, extrudedBy(Extrusion::geometryShader, gpu)},
          {"zpass_gpu_by_processor", zPass, extrudedBy(Extrusion::processor, gpu)}};
}

class Ways : public ::testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    auto technique = openGlTechniques()[GetParam().technique].create();
    if (!technique) GTEST_SKIP() << "no graphics: " << technique.error().text();
    technique_ = std::make_unique<Asking>(std::move(*technique), GetParam().ask);
  }
  // Pixels far from every edge that differ from the truth.
  std::size_t wrong(const Truth& truth, const scene::Camera& camera, const scene::Light& light) {
    const auto shading = technique_->shade({camera, std::span(&light, 1)});
    EXPECT_TRUE(shading);
    if (!shading) return 1;
    reason_ = shading->stats.lights[0].reason;
    const auto expected = truth.mask(camera, light);
    return shadow::compare(shading->masks[0], expected, truth.edges(camera, expected), 1).farFromEdge;
  }
  std::unique_ptr<shadow::Technique> technique_;
  std::string reason_;
};

TEST_P(Ways, AgreeWithBruteForceForEveryEyeAndLight) {
  const auto geometry = shadow::makeGeometry(village());
  ASSERT_TRUE(technique_->prepare(geometry));
  const Truth truth{geometry->surfaces};
  for (const Eye& eye : eyes())
    for (const Light3& light : lights())
      EXPECT_EQ(wrong(truth, eye.camera, light.light), 0u) << eye.name << ", " << light.name << ": " << reason_;
}

TEST_P(Ways, AgreeWithBruteForceForEyesAtTheSidesOfVolumes) {
  const auto geometry = shadow::makeGeometry(village());
  ASSERT_TRUE(technique_->prepare(geometry));
  const Truth truth{geometry->surfaces};
  for (const Light3& light : {lights()[0], lights()[2]}) {
    const auto silhouette = shadow::findSilhouette(geometry->casters, scene::homogeneous(light.light, Vec3(0.0)));
    for (std::size_t i = 0; i < silhouette.edges.size(); i += 7)
      for (const double distance : {0.0, -1e-6, 1e-4}) {
        const Vec3 a = geometry->casters.position(silhouette.edges[i].a),
                   b = geometry->casters.position(silhouette.edges[i].b), middle = glm::mix(a, b, 0.37);
        const Vec3 away = glm::normalize(middle * silhouette.light.w - Vec3(silhouette.light));
        const Vec3 normal = glm::normalize(glm::cross(b - a, away));
        scene::Camera camera = cameraFrom(middle + 0.31 * away + distance * normal, {-0.4, 1.7, 0.6});
        if (camera.eye.z < 0.05) continue;
        camera.width = 40;
        camera.height = 23;
        EXPECT_EQ(wrong(truth, camera, light.light), 0u) << light.name << ", " << i << ", " << distance << reason_;
      }
  }
}

// 256 sheets between the light and the ground are more than 8 bits count.
TEST_P(Ways, CountMoreLayersThanTheStencilHolds) {
  auto sheet = std::make_shared<mesh::Mesh>();
  sheet->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
  scene::Scene stack;
  stack.materials = {{}};
  stack.meshes = {sheet};
  for (int i = 0; i < 256; ++i) {
    Mat4 raised(1.0);
    raised[3][2] = 1.0 + 0.01 * i;
    stack.instances.push_back({"sheet", 0, raised});
  }
  ASSERT_TRUE(technique_->prepare(shadow::makeGeometry(scene::withGround(stack, 0.0))));
  const scene::Light sun{scene::DirectionalLight{{0.001, 0.002, -1.0}}};
  scene::Camera camera = cameraFrom({9, 1, 0.8}, {0, 0, 0});
  camera.fovY = Angle::degrees(20);
  camera.width = camera.height = 33;
  const auto shading = technique_->shade({camera, std::span(&sun, 1)});
  ASSERT_TRUE(shading);
  EXPECT_EQ(shading->masks[0].light(16, 16), 0);
}

// On llvmpipe all ways to extrude draw the same triangles from the same corners: not a pixel differs.
TEST(Extrusions, GiveTheSameMasksBitByBit) {
  const auto context = gl::Context::createHeadless();
  if (!context || !(*context)->isSoftware()) GTEST_SKIP() << "known of software renderers only";
  const auto geometry = shadow::makeGeometry(village());
  for (const std::size_t technique : {zFail, zPass, zPlus, brute}) {
    auto made = openGlTechniques()[technique].create();
    if (!made) GTEST_SKIP() << "no graphics: " << made.error().text();
    ASSERT_TRUE((*made)->prepare(geometry));
    for (const Eye& eye : eyes())
      for (const Light3& light : lights())
        for (const auto fill : {shadow::VolumeFill::reduced, shadow::VolumeFill::plain}) {
          shadow::Frame frame{.camera = eye.camera, .lights = std::span(&light.light, 1), .fill = fill};
          const auto expected = (*made)->shade(frame);
          ASSERT_TRUE(expected);
          for (const auto extrusion : {shadow::Extrusion::processor, shadow::Extrusion::geometryShader}) {
            frame.extrusion = extrusion;
            const auto shading = (*made)->shade(frame);
            ASSERT_TRUE(shading);
            EXPECT_EQ(shading->masks[0].light, expected->masks[0].light) << eye.name << ", " << light.name;
            if (expected->stats.lights[0].endlessCasters == 0) {
              EXPECT_EQ(shading->stats.lights[0].volumeTriangles, expected->stats.lights[0].volumeTriangles);
            }
          }
        }
  }
}

std::size_t countOf(const shadow::LightStats& stats, shadow::CasterChoice choice) {
  return static_cast<std::size_t>(std::count(stats.choices.begin(), stats.choices.end(), choice));
}

// The choice of every caster, which must sum up to what is counted anyway, and the cost of filling.
TEST_P(Ways, TellTheChoiceOfEveryCasterWhenAsked) {
  const auto geometry = shadow::makeGeometry(village());
  ASSERT_TRUE(technique_->prepare(geometry));
  using Choice = shadow::CasterChoice;
  for (const Eye& eye : eyes())
    for (const Light3& light : lights()) {
      shadow::Frame frame{.camera = eye.camera, .lights = std::span(&light.light, 1)};
      const auto without = technique_->shade(frame);
      frame.detailed = true;
      const auto with = technique_->shade(frame);
      ASSERT_TRUE(without && with);
      EXPECT_EQ(with->masks[0].light, without->masks[0].light);
      EXPECT_TRUE(without->stats.lights[0].choices.empty());
      EXPECT_FALSE(without->stats.lights[0].volumeFragments);
      const shadow::LightStats& stats = with->stats.lights[0];
      ASSERT_EQ(stats.choices.size(), geometry->casters.componentCount);
      const std::size_t all = stats.choices.size(), leftOut = stats.castersHidden + stats.castersBehind;
      const bool byZFail = GetParam().technique == zFail || GetParam().technique == brute;
      EXPECT_EQ(countOf(stats, Choice::hidden), stats.castersHidden);
      EXPECT_EQ(countOf(stats, Choice::noReceiver), stats.castersBehind);
      EXPECT_EQ(countOf(stats, Choice::zFail), byZFail ? all - leftOut : 0);
      EXPECT_EQ(countOf(stats, Choice::zFailTouched) + countOf(stats, Choice::zFailBetween), stats.castersByZFail);
      EXPECT_EQ(countOf(stats, Choice::zPass), byZFail ? 0 : all - leftOut - stats.castersByZFail);
      ASSERT_TRUE(stats.volumeFragments);
      if (stats.volumeTriangles == 0) {
        EXPECT_EQ(*stats.volumeFragments, 0u);
      }
    }
}

// Seen straight from above under a sun overhead, the cap of a sheet covers its pixels, and its sides, which run towards the point at infinity in the picture's middle, cover
// them once more.
TEST(VolumeFragments, AreTwiceThePixelsOfASheetUnderTheSun) {
  scene::Scene s;
  s.materials = {{}};
  auto sheet = std::make_shared<mesh::Mesh>();
  sheet->positions = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
  s.meshes = {sheet};
  s.instances.push_back({"sheet", 0});
  const auto geometry = shadow::makeGeometry(scene::withGround(s, 0.0));
  auto technique = openGlTechniques()[zFail].create();
  if (!technique) GTEST_SKIP() << "no graphics: " << technique.error().text();
  ASSERT_TRUE((*technique)->prepare(geometry));
  const scene::Light sun{scene::DirectionalLight{{0.0, 0.0, -1.0}}};
  scene::Camera camera = cameraFrom({0, 0, 1000}, {0, 0, 0});
  camera.up = {0, 1, 0};
  camera.fovY = Angle::radians(0.004);
  camera.width = camera.height = 100;
  const auto shading =
      (*technique)
          ->shade(
              {.camera = camera, .lights = std::span(&sun, 1), .fill = shadow::VolumeFill::plain, .detailed = true});
  ASSERT_TRUE(shading);
  std::size_t pixels = 0;
  for (const std::uint32_t t : shading->surface.triangle.pixels())
    pixels += t != shadow::kNoTriangle && geometry->surfaces.casts[t] != 0;
  EXPECT_GT(pixels, 2000u);
  EXPECT_EQ(*shading->stats.lights[0].volumeFragments, 2 * pixels);
}

// What a driver with depth bounds would leave out: wherever the depth lies outside of them, z-fail and z-pass from 0 end with no shadow. The bounds
// are asked of no driver here, the masks are what all others draw.
TEST(DepthBounds, LeaveOutNoShadow) {
  scene::Scene s = village();
  s.instances.push_back(box({40, 50, 0}, {2, 2, 2}));
  s.instances.back().casts = false;
  const auto geometry = shadow::makeGeometry(s);
  const Vec3& origin = geometry->surfaces.origin;
  auto technique = openGlTechniques()[zFail].create();
  if (!technique) GTEST_SKIP() << "no graphics: " << technique.error().text();
  ASSERT_TRUE((*technique)->prepare(geometry));
  std::size_t outside = 0, dark = 0;
  for (const Eye& eye : eyes())
    for (const Light3& light : lights()) {
      const auto shading = (*technique)->shade({eye.camera, std::span(&light.light, 1)});
      ASSERT_TRUE(shading);
      const render::View view = render::viewOf(eye.camera, geometry->surfaces.bounds.radius());
      const Vec4 lamp = scene::homogeneous(light.light, origin);
      Box3 counted = geometry->surfaces.bounds;
      counted.add(view.eye - origin);
      const auto distances = render::volumeDistances(view, geometry->casters.bounds, counted, lamp, origin);
      const auto facing = shadow::visibleSideFacesLight(geometry->surfaces, Vec4(view.eye - origin, 1.0), lamp);
      for (std::size_t i = 0; i < shading->surface.depth.size(); ++i) {
        const std::uint32_t seen = shading->surface.triangle.pixels()[i];
        const float distance = shading->surface.depth.pixels()[i];
        if (seen == shadow::kNoTriangle || facing[seen] == 0) continue;
        if (distance >= distances.nearest && distance <= distances.farthest) {
          dark += shading->masks[0].light.pixels()[i] == 0;
          continue;
        }
        ++outside;
        if (std::holds_alternative<scene::SpotLight>(light.light.shape)) continue;  // dark outside its cone
        ASSERT_EQ(shading->masks[0].light.pixels()[i], 255) << eye.name << ", " << light.name << " at " << distance;
      }
    }
  EXPECT_GT(outside, 1000u);
  EXPECT_GT(dark, 1000u);
}

// Where both faces cannot be counted at once, by the driver's word or by choice.
TEST(TwoSidedStencil, IsNotMissedWhereItIsMissing) {
  const auto geometry = shadow::makeGeometry(village());
  const auto without = [](gl::Quirks& quirks) { quirks.twoSidedStencil = false; };
  const auto plain = gl::Context::createHeadless();
  const auto poor = gl::Context::createHeadless({.adjust = without});
  if (!plain || !poor) GTEST_SKIP() << "no graphics";
  EXPECT_TRUE((*plain)->quirks().twoSidedStencil);
  for (const auto make : {makeZFail, makeZPass}) {
    const auto both = make(*plain, {}), faceByFace = make(*poor, {});
    ASSERT_TRUE(both->prepare(geometry) && faceByFace->prepare(geometry));
    for (const Eye& eye : eyes())
      for (const Light3& light : lights()) {
        const shadow::Frame frame{eye.camera, std::span(&light.light, 1)};
        const auto a = both->shade(frame), b = faceByFace->shade(frame);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a->masks[0].light, b->masks[0].light) << eye.name << ", " << light.name;
      }
  }
}

// As many edges as there are, whoever counts them.
TEST_P(Ways, TellWhatTheyDid) {
  const auto geometry = shadow::makeGeometry(village());
  ASSERT_TRUE(technique_->prepare(geometry));
  const scene::Light sun = lights()[0].light;
  shadow::Frame frame{eyes()[0].camera, std::span(&sun, 1)};
  const auto shading = technique_->shade(frame);
  ASSERT_TRUE(shading);
  const shadow::LightStats& stats = shading->stats.lights[0];
  GetParam().ask(frame);
  const bool wantsSilhouette = GetParam().technique != brute;
  if (frame.silhouettes != shadow::FinderKind::automatic && wantsSilhouette) {
    EXPECT_EQ(stats.finder, shadow::name(frame.silhouettes));
  }
  EXPECT_FALSE(stats.reason.empty());
  EXPECT_GT(stats.volumeTriangles, 0u);
  const std::size_t all =
      shadow::findSilhouette(geometry->casters, scene::homogeneous(sun, geometry->surfaces.origin)).edges.size();
  EXPECT_EQ(stats.silhouetteEdges <= all, wantsSilhouette);
  EXPECT_GT(stats.silhouetteEdges, 0u);
}

TEST_P(Ways, SurviveScenesWithoutCasters) {
  scene::Scene nothing;
  nothing.materials = {{}};
  ASSERT_TRUE(technique_->prepare(shadow::makeGeometry(nothing)));
  const scene::Light sun = lights()[0].light;
  EXPECT_TRUE(technique_->shade({eyes()[0].camera, std::span(&sun, 1)}));
}

INSTANTIATE_TEST_SUITE_P(Gl, Ways, ::testing::ValuesIn(ways()), [](const auto& which) { return which.param.name; });

// A rasteriser on the processor would find silhouettes slower than the processor itself does.
TEST(AutomaticFinder, IsNotTheGraphicsCardWhereThereIsNone) {
  const auto context = gl::Context::createHeadless();
  if (!context || !(*context)->isSoftware()) GTEST_SKIP() << "only for software renderers";
  auto technique = openGlTechniques()[zPass].create();
  ASSERT_TRUE(technique && (*technique)->prepare(shadow::makeGeometry(village())));
  const scene::Light sun = lights()[0].light;
  const auto shading = (*technique)->shade({eyes()[0].camera, std::span(&sun, 1)});
  ASSERT_TRUE(shading);
  EXPECT_NE(shading->stats.lights[0].finder, "gpu");
}

}  // namespace
}  // namespace umbrage::techniques
