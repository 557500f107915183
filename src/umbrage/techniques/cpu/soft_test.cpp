#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/yard.hpp"
#include "umbrage/shadow/light_samples.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::techniques {
namespace {

using namespace support;
using scene::Light;

std::unique_ptr<shadow::Technique> technique(std::string_view name) {
  for (const auto& entry : cpuTechniques())
    if (entry.traits.name == name) return std::move(*entry.create());
  return nullptr;
}

shadow::Shading shade(std::string_view name, const std::shared_ptr<const shadow::Geometry>& geometry,
                      const scene::Camera& camera, const Light& light, shadow::SoftSampling sampling) {
  const auto made = technique(name);
  EXPECT_TRUE(made->prepare(geometry));
  auto shading = made->shade({.camera = camera, .lights = {&light, 1}, .soft = std::move(sampling)});
  EXPECT_TRUE(shading);
  return std::move(*shading);
}

TEST(Soft, SixtyFourSamplesAreNearTheTruth) {
  const auto geometry = yard();
  const auto camera = fromTheCorner(160, 120);
  for (const Light& light : areaLights()) {
    const auto truth = shade("soft_rays", geometry, camera, light, {.samples = 4096});
    const auto mine = shade("soft_cpu", geometry, camera, light, {.samples = 64});
    const Errors e = errors(mine.masks[0], truth.masks[0]);
    const auto& stats = *mine.stats.lights[0].soft;
    std::printf("error %.4f over all pixels, %.4f in the penumbra; estimated %.4f; umbra %zu, penumbra %zu\n", e.all,
                e.penumbra, stats.error, stats.umbra, stats.penumbra);
    EXPECT_LE(e.all, 0.01);
    EXPECT_GE(stats.error, 0.5 * e.all);
    EXPECT_EQ(stats.samples, 64u);
    EXPECT_GT(stats.penumbra, 100u);
  }
}

// A half-plane over the ground, its edge parallel to y: what a point of the ground sees of the disc is a segment of a circle.
TEST(Soft, PenumbraOfAHalfPlaneFollowsItsClosedForm) {
  constexpr double kHeight = 10.0, kEdge = 4.0, kRadius = 1.0;
  const auto geometry = shadow::makeGeometry(
      shapes::scene({shapes::quad({0, -500, kEdge}, {900, -500, kEdge}, {900, 500, kEdge}, {0, 500, kEdge}),
                     shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})}));
  scene::Camera camera;
  camera.eye = {-0.3, 0.1, 3.5}, camera.target = {-0.3, 0.1, 0}, camera.up = {0, 1, 0};
  camera.width = 200, camera.height = 20, camera.fovY = Angle::degrees(3);
  const Light light{scene::DiscLight{{0, 0, kHeight}, {0, 0, -1}, kRadius}};
  const auto shading = shade("soft_cpu", geometry, camera, light, {.samples = 4096});
  const scene::PixelRays rays = scene::pixelRays(camera);
  double worst = 0.0;
  std::size_t looked = 0;
  for (int x = 0; x < camera.width; ++x) {
    if (shading.surface.triangle(x, 10) == shadow::kNoTriangle) continue;
    const Vec3 ray = rays.through(x + 0.5, 10.5), point = camera.eye + double(shading.surface.depth(x, 10)) * ray;
    ASSERT_NEAR(point.z, 0.0, 1e-4);
    // The edge as seen from the point, carried on to the light's plane; all beyond it is hidden.
    const double border = std::clamp((-point.x * (kHeight - kEdge) / kEdge) / kRadius, -1.0, 1.0);
    const double seen = 1.0 - (std::acos(border) - border * std::sqrt(1.0 - border * border)) / std::numbers::pi;
    worst = std::max(worst, std::abs(shading.masks[0].light(x, 10) / 255.0 - seen));
    looked += seen > 0.0 && seen < 1.0;
  }
  std::printf("worst %.4f of %zu pixels in the penumbra\n", worst, looked);
  EXPECT_GT(looked, 50u);
  EXPECT_LE(worst, 0.005);
}

TEST(Soft, LightsWithoutExtentStayHard) {
  const auto geometry = yard();
  const auto camera = fromTheCorner(160, 120);
  const Light lamp{scene::PointLight{{4, -3, 8}}};
  EXPECT_EQ(shade("soft_cpu", geometry, camera, lamp, {}).masks[0].light,
            shade("hybrid_cpu", geometry, camera, lamp, {}).masks[0].light);
}

TEST(Soft, StopsWhenTheErrorIsSmallEnoughOrTheUserSaysSo) {
  const auto geometry = yard();
  const auto camera = fromTheCorner(80, 60);
  const Light light = areaLights()[0];
  const auto rough = shade("soft_cpu", geometry, camera, light, {.samples = 4096, .enough = 0.02});
  EXPECT_LT(rough.stats.lights[0].soft->samples, 4096u);
  EXPECT_LE(rough.stats.lights[0].soft->error, 0.02);
  std::size_t told = 0;
  const auto stopped =
      shade("soft_cpu", geometry, camera, light, {.samples = 4096, .progress = [&](const shadow::SoftProgress& p) {
                                                    ++told;
                                                    return p.samples < 48;
                                                  }});
  EXPECT_EQ(stopped.stats.lights[0].soft->samples, 48u);
  EXPECT_EQ(told, 3u);
}

/// Boxes all over the ground; `low`: so high that a ball of light fits in between.
std::shared_ptr<const shadow::Geometry> manyBoxes() {
  std::vector<mesh::Mesh> meshes{shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})};
  unsigned state = 11;
  const auto unit = [&] { return double((state = state * 1664525u + 1013904223u) >> 8) / double(1u << 24); };
  for (int i = 0; i < 24; ++i) {
    const Vec3 at(12 * unit() - 6, 12 * unit() - 6, 0), size(0.4 + unit(), 0.4 + unit(), 0.5 + 2 * unit());
    if (std::abs(at.x) < 1.5 && std::abs(at.y) < 1.5) continue;  // that is where the balls are
    meshes.push_back(shapes::box(at, at + size));
  }
  return shadow::makeGeometry(shapes::scene(std::move(meshes)));
}

// Large balls over, among and beside boxes; much of the picture lies in their penumbras.
TEST(Soft, LargeBallsAreNearTheTruthToo) {
  const auto geometry = manyBoxes();
  const auto camera = fromTheCorner(120, 90);
  for (const scene::SphereLight& ball :
       {scene::SphereLight{{0.3, -0.2, 4}, 0.7}, {{0.2, 0.3, 2}, 0.7}, {{0, 0, 1}, 0.7}, {{9, 1, 3}, 0.9}}) {
    const Light light{ball};
    const auto truth = shade("soft_rays", geometry, camera, light, {.samples = 1024});
    const auto mine = shade("soft_cpu", geometry, camera, light, {.samples = 64});
    const Errors e = errors(mine.masks[0], truth.masks[0]);
    std::printf("ball at %.1f %.1f %.1f: error %.4f over all pixels, %.4f in the penumbra of %zu\n", ball.centre.x,
                ball.centre.y, ball.centre.z, e.all, e.penumbra, mine.stats.lights[0].soft->penumbra);
    EXPECT_LE(e.all, 0.01);
  }
}

// What a half-plane before a disc hides depends on the points' places along one direction alone: how far they are from those of a disc
// there (Cramer-von Mises), over all directions.
double unevenness(const std::vector<Vec3>& points) {
  const auto part = [](double t) {
    t = std::clamp(t, -1.0, 1.0);
    return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
  };
  const auto n = double(points.size());
  constexpr int kDirections = 300;
  double sum = 0.0;
  for (int d = 0; d < kDirections; ++d) {
    const double z = 1.0 - (2.0 * d + 1.0) / kDirections, turn = d * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const Vec3 along(std::sqrt(1.0 - z * z) * Vec2(std::cos(turn), std::sin(turn)), z);
    std::vector<double> parts;
    for (const Vec3& p : points) parts.push_back(part(glm::dot(p, along)));
    std::sort(parts.begin(), parts.end());
    sum += 1.0 / (12.0 * n * n);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double off = parts[i] - (2.0 * double(i) + 1.0) / (2.0 * n);
      sum += off * off / n;
    }
  }
  return std::sqrt(sum / kDirections);
}

// Without the optimised points: 0.061, 0.037, 0.0218, 0.0143, 0.0083 and 0.0053; points by chance: 0.083 for 64.
TEST(LightSamples, ABallIsEvenSeenFromEverywhere) {
  const scene::SphereLight ball{{1, 2, 3}, 2.0};
  const auto points = [&](std::size_t first, std::size_t count) {
    std::vector<Vec3> out;
    for (const auto& sample : shadow::lightSamples(Light{ball}, first, count)) {
      EXPECT_TRUE(sample.ball);
      out.push_back((std::get<scene::PointLight>(sample.light.shape).position - ball.centre) / ball.radius);
      EXPECT_LE(glm::length(out.back()), 1.0);
    }
    return out;
  };
  for (const auto& [count, most] : {std::pair<std::size_t, double>{16, 0.048},
                                    {32, 0.029},
                                    {64, 0.0170},
                                    {128, 0.0104},
                                    {256, 0.0065},
                                    {512, 0.0053},
                                    {4096, 0.0015}})
    EXPECT_LE(unevenness(points(0, count)), most) << count;
  for (const std::size_t first : {16u, 96u, 208u}) EXPECT_LE(unevenness(points(first, 16)), 0.052) << first;
  for (const std::size_t first : {64u, 128u, 192u}) EXPECT_LE(unevenness(points(first, 64)), 0.0185) << first;
}

TEST(LightSamples, FillTheLightEvenlyAtEveryPowerOfTwo) {
  const Light disc{scene::DiscLight{{1, 2, 3}, {0, 0, -1}, 2.0}};
  for (const std::size_t n : {16u, 64u, 256u}) {
    const auto samples = shadow::lightSamples(disc, 0, n);
    std::size_t inner = 0, left = 0;
    for (const auto& sample : samples) {
      const Vec3 p = std::get<scene::SpotLight>(sample.light.shape).position - Vec3(1, 2, 3);
      ASSERT_LE(glm::length(p), 2.0);
      inner += glm::length(p) < std::sqrt(2.0);
      left += p.x < 0.0;
    }
    EXPECT_NEAR(double(inner), double(n) / 2, 1 + double(n) / 16);
    EXPECT_NEAR(double(left), double(n) / 2, 1 + double(n) / 16);
  }
}

}  // namespace
}  // namespace umbrage::techniques
