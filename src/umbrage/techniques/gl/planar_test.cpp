// Shadows on planes: exact there, unknown elsewhere, and soft by the mean of points of a light.
#include "umbrage/techniques/gl/planar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/village.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/gl/read_back.hpp"
#include "umbrage/image/compare.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/shadow/light_samples.hpp"
#include "umbrage/shadow/unshadowed.hpp"

namespace umbrage::techniques {
namespace {

using namespace support;

class Planar : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gl::Context::createHeadless();
    if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
    context_ = *context;
  }
  [[nodiscard]] std::unique_ptr<render::GlTechnique> prepared(const std::shared_ptr<const shadow::Geometry>& geometry,
                                                              const shadow::PlaneSearch& planes = {}) const {
    auto technique = makePlanar(context_, planes);
    EXPECT_TRUE(technique->prepare(geometry));
    return technique;
  }
  std::shared_ptr<gl::Context> context_;
};

// Pixels that planar answers for and that differ from the truth far from every edge.
std::size_t wrong(const shadow::Shading& shading, const Truth& truth, const scene::Camera& camera,
                  const scene::Light& light) {
  const auto expected = truth.mask(camera, light);
  const auto mine = shadow::whereKnown(shading.masks[0], shading.unshadowed, expected);
  return shadow::compare(mine, expected, truth.edges(camera, expected), 1).farFromEdge;
}

std::size_t count(const image::GreyImage& pixels, std::uint8_t value) {
  return static_cast<std::size_t>(std::ranges::count(pixels.pixels(), value));
}

TEST_F(Planar, AgreesWithBruteForceOnItsPlanesForEveryEyeAndLight) {
  const auto geometry = shadow::makeGeometry(village());
  // With all planes the whole picture is exact; with three, these.
  for (const std::size_t most : {std::size_t{127}, std::size_t{3}}) {
    const auto technique = prepared(geometry, {.most = most, .leastShare = 0.0});
    const Truth truth{geometry->surfaces};
    for (const Eye& eye : eyes())
      for (const Light3& light : lights()) {
        const auto shading = technique->shade({eye.camera, std::span(&light.light, 1)});
        ASSERT_TRUE(shading);
        EXPECT_EQ(wrong(*shading, truth, eye.camera, light.light), 0u) << eye.name << ", " << light.name;
        if (most == 127) {
          EXPECT_LT(count(shading->unshadowed, 1), 100u);  // where triangles end beside a pixel's centre
        }
      }
  }
}

TEST_F(Planar, TellsWhereItKnowsNoShadowsAndLightsWhatFacesTheLightThere) {
  const auto geometry = shadow::makeGeometry(village());
  const auto technique = prepared(geometry, {.given = {{{0, 0, 0}, {0, 0, 1}}}});
  const scene::Camera camera = eyes()[0].camera;
  const scene::Light sun = lights()[0].light;
  const auto shading = technique->shade({camera, std::span(&sun, 1)});
  ASSERT_TRUE(shading);
  EXPECT_EQ(shading->stats.lights[0].planes, 1u);
  EXPECT_EQ(shading->stats.lights[0].method, "planar");
  const auto facing =
      shadow::visibleSideFacesLight(geometry->surfaces, Vec4(camera.eye, 1.0), scene::homogeneous(sun, Vec3(0.0)));
  std::size_t unknown = 0, atBorders = 0;
  for (std::size_t i = 0; i < shading->unshadowed.size(); ++i) {
    const std::uint32_t seen = shading->surface.triangle.pixels()[i];
    const bool onGround = seen != shadow::kNoTriangle && geometry->surfaces.normal(seen).x == 0.0 &&
                          geometry->surfaces.normal(seen).y == 0.0 && geometry->surfaces.corner(seen, 0).z == 0.0;
    if (seen != shadow::kNoTriangle && !onGround) {
      EXPECT_EQ(shading->unshadowed.pixels()[i], 1);
    } else {
      atBorders += shading->unshadowed.pixels()[i];
      continue;
    }
    ++unknown;
    EXPECT_EQ(shading->masks[0].light.pixels()[i], facing[seen] != 0 ? 255 : 0);
  }
  EXPECT_GT(unknown, 100u);
  EXPECT_LT(atBorders, 20u);
}

// The pictures that make planar shadows wrong: casters behind the light, casters below the plane, casters that cross both.
TEST_F(Planar, CastersBeyondTheLightOrBelowThePlaneCastNoFalseShadow) {
  scene::Scene s;
  s.materials = {{}};
  s.meshes = {boxMesh()};
  // Above the lamp, around its height, below the ground, and through the ground.
  s.instances = {box({-1, -1, 6}, {2, 2, 1}), box({3, 0, 2}, {1, 1, 4}), box({-3, 2, -2}, {1, 1, 1}),
                 box({0, 3, -1}, {1, 1, 2})};
  const auto geometry = shadow::makeGeometry(scene::withGround(s, 0.0));
  const auto technique = prepared(geometry, {.most = 1});
  const Truth truth{geometry->surfaces};
  const scene::Light lamp{scene::PointLight{{0.3, 0.2, 4}}};
  for (const Vec3& eye : {Vec3(9, -11, 3), Vec3(-5, -7, 12), Vec3(2, 9, -4)}) {
    const scene::Camera camera = cameraFrom(eye, {0.5, 1, 0});
    const auto shading = technique->shade({camera, std::span(&lamp, 1)});
    ASSERT_TRUE(shading);
    EXPECT_EQ(wrong(*shading, truth, camera, lamp), 0u) << eye.x;
  }
}

// Where two shadows lie on each other the picture is as dark as in one: nothing but ambient light.
TEST_F(Planar, DrawsThePictureThatTheProcessorComposes) {
  scene::Scene s = village();
  s.materials[0].emission = {0.2, 0.0, 0.1};
  const auto geometry = shadow::makeGeometry(s);
  const auto technique = prepared(geometry);
  const scene::Camera camera = eyes()[0].camera;
  std::vector<scene::Light> several;
  for (const Light3& l : lights()) {
    several.push_back(l.light);
    several.back().colour = Vec3(0.2 + 0.1 * double(several.size()), 0.3, 0.5 - 0.05 * double(several.size()));
    several.back().intensity = 0.6;
  }
  several.push_back({scene::DiscLight{{4, -3, 8}, {-4, 3, -8}, 0.8}, Vec3(0.2), 1.0});
  several.push_back({scene::SphereLight{{-4, -3, 8}, 0.5}, Vec3(0.2), 1.0});
  const shadow::Frame frame{.camera = camera, .lights = several, .soft = {.samples = 16}};
  const auto shading = technique->shade(frame);
  ASSERT_TRUE(shading);
  const auto expected = shadow::composite(s, geometry->surfaces, camera, shading->surface, several, shading->masks);
  const gl::CurrentContext current(context_);
  auto target = render::GpuFrame::make(kWidth, kHeight);
  ASSERT_TRUE(target);
  ASSERT_TRUE(technique->draw(*target, frame, {.materials = s.materials}));
  const gl::HostScope scope;
  const auto picture = gl::readRgba(scope, target->pictureTarget(), kWidth, kHeight);
  image::RgbImage drawn(kWidth, kHeight);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto p = picture.pixels()[i];
    drawn.pixels()[i] = {p.r, p.g, p.b};
  }
  EXPECT_LE(image::compare(drawn, expected).largest, 2);
}

// A square sheet above the ground under a lamp above its middle: its shadow is a square, as wide as similar triangles say.
TEST_F(Planar, ShadowOfASquareIsASquare) {
  auto sheet = std::make_shared<mesh::Mesh>();
  sheet->positions = {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};
  sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
  scene::Scene s;
  s.materials = {{}};
  s.meshes = {sheet};
  s.instances = {{"sheet", 0}};
  const auto geometry = shadow::makeGeometry(scene::withGround(s, 0.0));
  const auto technique = prepared(geometry);
  const scene::Light lamp{scene::PointLight{{0, 0, 6}}};
  const scene::Camera camera = cameraFrom({4, -5, 1.9}, {0, 0, 0});
  const auto shading = technique->shade({camera, std::span(&lamp, 1)});
  ASSERT_TRUE(shading);
  const auto rays = scene::pixelRays(camera);
  std::size_t dark = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::uint32_t seen = shading->surface.triangle(x, y);
      if (seen == shadow::kNoTriangle || geometry->surfaces.corner(seen, 0).z != 0.0) continue;
      const Vec3 ray = rays.through(x + 0.5, y + 0.5), p = camera.eye - ray * (camera.eye.z / ray.z);
      const double out = std::max(std::abs(p.x), std::abs(p.y)) - 1.5;
      if (std::abs(out) < 1e-5) continue;
      EXPECT_EQ(shading->masks[0].light(x, y), out < 0.0 ? 0 : 255) << x << " " << y;
      dark += out < 0.0;
    }
  EXPECT_GT(dark, 100u);
}

// Far from the origin, and in millimetres.
TEST_F(Planar, AgreesWithBruteForceFarFromTheOriginAndInMillimetres) {
  for (const double scale : {1.0, 1000.0}) {
    scene::Scene s = village();
    const Vec3 shift = scale == 1.0 ? Vec3(85000, 446000, 30) : Vec3(0.0);
    for (scene::Instance& i : s.instances) {
      const Vec3 at(i.toWorld[3]);
      i.toWorld = Mat4(Mat3(i.toWorld) * scale);
      i.toWorld[3] = Vec4(scale * at + shift, 1.0);
    }
    const auto geometry = shadow::makeGeometry(s);
    const auto technique = prepared(geometry);
    const scene::Camera camera = cameraFrom(scale * Vec3(9, -11, 7) + shift, scale * Vec3(0, 1, 1) + shift);
    const scene::Light lamp{scene::PointLight{scale * Vec3(3.7, -1.2, 6.0) + shift}};
    const auto shading = technique->shade({camera, std::span(&lamp, 1)});
    ASSERT_TRUE(shading);
    EXPECT_EQ(wrong(*shading, Truth{geometry->surfaces}, camera, lamp), 0u) << scale;
  }
}

// What a point of the ground sees of a disc behind a half-plane is a segment of a circle.
TEST_F(Planar, PenumbraOfAHalfPlaneFollowsItsClosedForm) {
  constexpr double kLightHeight = 10.0, kEdge = 4.0, kRadius = 1.0;
  auto half = std::make_shared<mesh::Mesh>(), ground = std::make_shared<mesh::Mesh>();
  half->positions = {{0, -500, kEdge}, {900, -500, kEdge}, {900, 500, kEdge}, {0, 500, kEdge}};
  ground->positions = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}};
  half->triangles = ground->triangles = {{0, 1, 2}, {0, 2, 3}};
  scene::Scene s;
  s.materials = {{}};
  s.meshes = {half, ground};
  s.instances = {{"half", 0}, {"ground", 1}};
  const auto technique = prepared(shadow::makeGeometry(s), {.leastShare = 0.0});
  scene::Camera camera;
  camera.eye = {-0.3, 0.1, 3.5}, camera.target = {-0.3, 0.1, 0}, camera.up = {0, 1, 0};
  camera.width = 200, camera.height = 20, camera.fovY = Angle::degrees(3);
  for (const bool ball : {false, true}) {
    const scene::Light light = ball ? scene::Light{scene::SphereLight{{0, 0, kLightHeight}, kRadius}}
                                    : scene::Light{scene::DiscLight{{0, 0, kLightHeight}, {0, 0, -1}, kRadius}};
    const auto shading = technique->shade({.camera = camera, .lights = {&light, 1}, .soft = {.samples = 1024}});
    ASSERT_TRUE(shading);
    const auto rays = scene::pixelRays(camera);
    double worst = 0.0;
    std::size_t penumbra = 0;
    for (int x = 0; x < camera.width; ++x) {
      const Vec3 ray = rays.through(x + 0.5, 10.5), p = camera.eye - ray * (camera.eye.z / ray.z);
      const double border = std::clamp((-p.x * (kLightHeight - kEdge) / kEdge) / kRadius, -1.0, 1.0);
      const double seen = 1.0 - (std::acos(border) - border * std::sqrt(1.0 - border * border)) / std::numbers::pi;
      worst = std::max(worst, std::abs(shading->masks[0].light(x, 10) / 255.0 - seen));
      penumbra += seen > 0.0 && seen < 1.0;
    }
    EXPECT_GT(penumbra, 50u);
    EXPECT_LE(worst, ball ? 0.03 : 0.01);
    ASSERT_TRUE(shading->stats.lights[0].soft);
    EXPECT_EQ(shading->stats.lights[0].soft->samples, 1024u);
    EXPECT_GT(shading->stats.lights[0].soft->penumbra, 100u);
    EXPECT_LT(shading->stats.lights[0].soft->error, 0.02);
    std::printf("%s: worst %.4f\n", ball ? "ball" : "disc", worst);
  }
}

// A wall seen from its front, in whose plane a disc lies: points of the light behind the wall do not reach it, those before it do.
TEST_F(Planar, PointsBehindASurfaceDoNotReachIt) {
  auto wall = std::make_shared<mesh::Mesh>();
  wall->positions = {{0, -9, 0}, {0, 9, 0}, {0, 9, 9}, {0, -9, 9}};
  wall->triangles = {{0, 1, 2}, {0, 2, 3}};
  scene::Scene s;
  s.materials = {{}};
  s.meshes = {wall};
  s.instances = {{"wall", 0}};
  const auto technique = prepared(shadow::makeGeometry(s));
  const scene::Light light{scene::DiscLight{{0.3, 0, 20}, {0, 0, -1}, 1.0}};
  const auto shading =
      technique->shade({.camera = cameraFrom({8, 1, 5}, {0, 0, 5}), .lights = {&light, 1}, .soft = {.samples = 64}});
  ASSERT_TRUE(shading);
  int before = 0;
  for (const auto& sample : shadow::lightSamples(light, 0, 64))
    before += std::get<scene::SpotLight>(sample.light.shape).position.x > 0.0;
  EXPECT_GT(before, 32);
  EXPECT_LT(before, 60);
  EXPECT_EQ(shading->masks[0].light(kWidth / 2, kHeight / 2), std::lround(255.0 * before / 64.0));
}

TEST_F(Planar, StopsWhenTheErrorIsSmallEnoughOrTheUserSaysSo) {
  const auto technique = prepared(shadow::makeGeometry(village()));
  const scene::Light light{scene::DiscLight{{4, -3, 8}, {-4, 3, -8}, 0.8}};
  shadow::Frame frame{.camera = eyes()[0].camera, .lights = {&light, 1}, .soft = {.samples = 512, .enough = 0.02}};
  const auto rough = technique->shade(frame);
  ASSERT_TRUE(rough);
  EXPECT_LT(rough->stats.lights[0].soft->samples, 512u);
  EXPECT_LE(rough->stats.lights[0].soft->error, 0.02);
  frame.soft = {.samples = 512, .progress = [](const shadow::SoftProgress& p) { return p.samples < 48; }};
  const auto stopped = technique->shade(frame);
  ASSERT_TRUE(stopped);
  EXPECT_EQ(stopped->stats.lights[0].soft->samples, 48u);
}

TEST_F(Planar, SurvivesEmptyScenesAndOddSizes) {
  scene::Scene nothing;
  nothing.materials = {{}};
  const auto technique = prepared(shadow::makeGeometry(nothing));
  scene::Camera camera = eyes()[0].camera;
  camera.width = camera.height = 1;
  const scene::Light sun = lights()[0].light;
  const auto shading = technique->shade({camera, std::span(&sun, 1)});
  ASSERT_TRUE(shading);
  EXPECT_EQ(shading->masks[0].covered(0, 0), 0);
  camera.width = 1 << 20;
  const auto tooWide = technique->shade({camera, std::span(&sun, 1)});
  ASSERT_FALSE(tooWide);
  EXPECT_EQ(tooWide.error().code, ErrorCode::device);
}

}  // namespace
}  // namespace umbrage::techniques
