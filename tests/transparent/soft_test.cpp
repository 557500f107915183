#include <gtest/gtest.h>

#include <cstdio>

#include "support/veil_scenes.hpp"
#include "support/yard.hpp"
#include "umbrage/techniques/cpu/registry.hpp"
#include "umbrage/techniques/gl/soft.hpp"
#include "umbrage/techniques/gl/transparent.hpp"

namespace umbrage::techniques {
namespace {

using namespace support;
using scene::Light;

std::shared_ptr<gl::Context> sharedContext() {
  static const auto context = gl::Context::createHeadless();
  return context ? *context : nullptr;
}

std::unique_ptr<shadow::Technique> technique(std::string_view name) {
  if (name == "soft") return makeSoft(sharedContext());
  if (name == "transparent") return makeTransparent(sharedContext());
  for (const auto& entry : cpuTechniques())
    if (entry.traits.name == name) return std::move(*entry.create());
  return nullptr;
}

shadow::Shading shade(std::string_view name, const std::shared_ptr<const shadow::Geometry>& geometry,
                      const scene::Camera& camera, const Light& light, shadow::SoftSampling sampling) {
  const auto made = technique(name);
  EXPECT_TRUE(made->prepare(geometry));
  auto shading = made->shade({.camera = camera, .lights = {&light, 1}, .soft = std::move(sampling)});
  if (!shading) ADD_FAILURE() << shading.error().text();
  return shading ? std::move(*shading) : shadow::Shading{};
}

class SoftGl : public testing::Test {
 protected:
  void SetUp() override {
    if (sharedContext() == nullptr) GTEST_SKIP() << "no graphics";
  }
};

// The same points of the light, so only pixels upon the edge of a sample's shadow may differ, by that sample.
TEST_F(SoftGl, IsTheMeanThatRaysHave) {
  const auto geometry = yard();
  const auto camera = fromTheCorner(160, 120);
  for (const Light& light : areaLights()) {
    const auto mine = shade("soft", geometry, camera, light, {.samples = 64});
    const auto rays = shade("soft_rays", geometry, camera, light, {.samples = 64});
    std::size_t equal = 0, far = 0;
    for (std::size_t i = 0; i < rays.masks[0].light.size(); ++i) {
      const int apart = std::abs(int(mine.masks[0].light.pixels()[i]) - int(rays.masks[0].light.pixels()[i]));
      equal += apart == 0;
      far += apart > 3 * 255 / 64;
    }
    const std::size_t pixels = rays.masks[0].light.size();
    const auto &soft = *mine.stats.lights[0].soft, &truth = *rays.stats.lights[0].soft;
    std::printf(
        "%zu of %zu pixels equal, %zu more than three samples apart; estimated error %.5f and %.5f; umbra %zu and %zu, "
        "penumbra %zu and %zu\n",
        equal, pixels, far, soft.error, truth.error, soft.umbra, truth.umbra, soft.penumbra, truth.penumbra);
    EXPECT_GE(equal, pixels - pixels / 100);
    EXPECT_LE(far, pixels / 2000);
    EXPECT_NEAR(soft.error, truth.error, 0.02 * truth.error);
    EXPECT_EQ(soft.samples, 64u);
  }
}

TEST_F(SoftGl, SixtyFourSamplesAreNearTheTruth) {
  const auto geometry = yard();
  const auto camera = fromTheCorner(80, 60);
  for (const Light& light : areaLights()) {
    const auto truth = shade("soft_rays", geometry, camera, light, {.samples = 4096});
    const auto mine = shade("soft", geometry, camera, light, {.samples = 64});
    const Errors e = errors(mine.masks[0], truth.masks[0]);
    std::printf("error %.4f over all pixels, %.4f in the penumbra\n", e.all, e.penumbra);
    EXPECT_LE(e.all, 0.01);
  }
}

TEST_F(SoftGl, ColoursAreAsRaysHaveThem) {
  const auto geometry = shadow::makeGeometry(soup(300, 1.5, 7));
  const auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3}, 80, 60);
  const Light ball{scene::SphereLight{{3, -2, 6}, 0.7}};
  const auto mine = shade("soft", geometry, camera, ball, {.samples = 48});
  const auto rays = shade("soft_rays", geometry, camera, ball, {.samples = 48});
  const Compared c = compareAll(mine, rays);
  std::printf("%zu with other surfaces; of %zu surfaces %zu off\n", c.otherVeils, c.surfaces, c.off);
  EXPECT_LE(c.otherVeils, 5u);
  EXPECT_LE(c.off, c.surfaces / 200);
}

TEST_F(SoftGl, LightsWithoutExtentStayHard) {
  const auto geometry = yard();
  const auto camera = fromTheCorner(160, 120);
  const Light lamp{scene::PointLight{{4, -3, 8}}};
  EXPECT_EQ(shade("soft", geometry, camera, lamp, {}).masks[0].light,
            shade("transparent", geometry, camera, lamp, {}).masks[0].light);
}

TEST_F(SoftGl, StopsWhenTheErrorIsSmallEnoughOrTheUserSaysSo) {
  const auto geometry = yard();
  const auto camera = fromTheCorner(80, 60);
  const Light light = areaLights()[0];
  const auto rough = shade("soft", geometry, camera, light, {.samples = 4096, .enough = 0.02});
  EXPECT_LT(rough.stats.lights[0].soft->samples, 4096u);
  EXPECT_LE(rough.stats.lights[0].soft->error, 0.02);
  std::size_t told = 0;
  const auto stopped =
      shade("soft", geometry, camera, light,
            {.samples = 4096, .progress = [&](const shadow::SoftProgress& p) { return ++told, p.samples < 48; }});
  EXPECT_EQ(stopped.stats.lights[0].soft->samples, 48u);
  EXPECT_EQ(told, 3u);
}

}  // namespace
}  // namespace umbrage::techniques
