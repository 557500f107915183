#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/veil_scenes.hpp"
#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/read_back.hpp"
#include "umbrage/image/compare.hpp"
#include "umbrage/shadow/composite.hpp"
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

std::unique_ptr<shadow::Technique> technique(const std::string& name) {
  if (name == "transparent") return makeTransparent(sharedContext());
  if (name == "transparent plain") return makeTransparent(sharedContext(), render::kPlainVolumes);
  if (name == "transparent_zfail") return makeTransparentZFail(sharedContext());
  for (const auto& entry : cpuTechniques())
    if (entry.traits.name == name) return std::move(*entry.create());
  return nullptr;
}

shadow::Shading shade(const std::string& name, const scene::Scene& scene, const scene::Camera& camera,
                      const std::vector<Light>& lights, std::optional<int> veilLayers = {}) {
  const auto made = technique(name);
  EXPECT_TRUE(made->prepare(shadow::makeGeometry(scene)));
  auto shading = made->shade({.camera = camera, .lights = lights, .veilLayers = veilLayers});
  if (!shading) ADD_FAILURE() << shading.error().text();
  return shading ? std::move(*shading) : shadow::Shading{};
}

class TransparentGl : public testing::Test {
 protected:
  void SetUp() override {
    if (sharedContext() == nullptr) GTEST_SKIP() << "no graphics";
  }
};

TEST_F(TransparentGl, PanesTakeTheirShareEach) {
  const auto mine = technique("transparent"), behind = technique("transparent_zfail");
  for (const double t : {0.02, 0.1, 0.5, 0.9, 0.98}) {
    for (const int n : {1, 3, 16, 64}) {
      Builder b;
      const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(1.0), 1.0 - t);
      b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
      for (int i = 0; i < n; ++i) b.quad({0, 0, 1 + 0.05 * i}, {2, 0, 0}, {0, 2, 0}, pane);
      const auto geometry = shadow::makeGeometry(b.scene);
      const Light lamp{scene::PointLight{{0.4, 0.3, 30}}};
      for (const auto* way : {&mine, &behind}) {
        ASSERT_TRUE((*way)->prepare(geometry));
        for (const Vec3& eye :
             {Vec3(-6, -5, 0.7), Vec3(-2, -3, 12), Vec3(0.3, 0.2, 1.52)}) {  // beside, above and among them
          const auto shading = (*way)->shade({.camera = cameraAt(eye, {0.1, 0.05, 0}, 64, 48), .lights = {&lamp, 1}});
          ASSERT_TRUE(shading);
          // The middle of the picture shows the ground below the panes.
          EXPECT_NEAR(shadow::partsOf(shading->masks[0].tint(32, 24)).x, std::pow(t, n), 1e-4)
              << t << " " << n << " " << eye.z;
        }
      }
    }
  }
}

TEST_F(TransparentGl, HundredsOfPanesAddUp) {
  for (const auto& [t, n] : {std::pair{0.995, 400}, {0.999, 900}, {1e-3, 300}, {0.0, 300}}) {
    Builder b;
    const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(1.0, 1.0, t), 0.0);  // blue alone is taken
    b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
    for (int i = 0; i < n; ++i) b.quad({0, 0, 1 + 0.01 * i}, {2, 0, 0}, {0, 2, 0}, pane);
    for (const char* name : {"transparent", "transparent_zfail"}) {
      const auto shading = shade(name, b.scene, cameraAt({-6, -5, 0.7}, {0.1, 0.05, 0}, 32, 24),
                                 {Light{scene::PointLight{{0.4, 0.3, 60}}}}, 0);
      const Vec3 light = shadow::partsOf(shading.masks[0].tint(16, 12));
      EXPECT_NEAR(light.x, 1.0, 1e-4) << name;
      EXPECT_NEAR(light.z, std::pow(t, n), 1e-4) << name << " " << t << " " << n;
    }
  }
}

scene::Scene stack(int panes, double gap) {
  Builder b;
  const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(0.995), 0.0);
  b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
  for (int i = 0; i < panes; ++i) b.quad({0, 0, 1 + gap * i}, {2, 0, 0}, {0, 2, 0}, pane);
  return b.scene;
}

// Sorted by insertion, 362 veils take more rounds than drivers on the processor pass through: what was left in disorder was lit anyhow.
TEST_F(TransparentGl, ClosePanesShadowEachOther) {
  const std::vector<Light> lights{{scene::PointLight{{0.4, 0.3, 60}}}, {scene::PointLight{{5, 3, 6}}}};
  const auto scene = stack(500, 0.002);
  const auto camera = cameraAt({-6, -5, 3.7}, {0.1, 0.05, 1.2}, 45, 30);
  const auto truth = shade("transparent_rays", scene, camera, lights);
  for (const char* name : {"transparent", "transparent_zfail"}) {
    const Compared c = compareAll(shade(name, scene, camera, lights), truth);
    std::printf("%s: %zu of %zu pixels with other surfaces; of %zu surfaces %zu off\n", name, c.otherVeils, c.pixels,
                c.surfaces, c.off);
    EXPECT_LE(c.otherVeils, c.pixels / 50) << name;  // along the rims
    EXPECT_LE(c.off, c.surfaces / 10000) << name;
  }
  const auto before = shade("transparent", scene, camera, lights),
             behind = shade("transparent_zfail", scene, camera, lights);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    EXPECT_EQ(before.masks[i].tint, behind.masks[i].tint);
    EXPECT_EQ(before.masks[i].veils, behind.masks[i].veils);
  }
}

TEST_F(TransparentGl, ThousandsOfVeilsOfAPixelAreSorted) {
  for (const int panes : {3, 5, 33, 255, 400, 2047, 2500}) {
    const auto shading = shade("transparent", stack(panes, 0.002), cameraAt({-6, -5, 9}, {0.1, 0.05, 3}, 8, 6),
                               {Light{scene::PointLight{{5, 3, 6}}}});
    std::size_t most = 0;
    for (std::size_t i = 0; i < shading.surface.triangle.size(); ++i) {
      const auto veils = shading.veils.at(i);
      most = std::max(most, veils.size());
      EXPECT_TRUE(std::ranges::is_sorted(veils, {}, &shadow::Veil::depth)) << panes << " " << i;
    }
    EXPECT_GE(most, static_cast<std::size_t>(panes) / 2);
  }
}

TEST_F(TransparentGl, TheOrderOfCastersChangesNothing) {
  const std::vector<Light> lights{{scene::PointLight{{3, -2, 6}}}};
  auto scene = soup(400, 1.2, 3);
  const auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3});
  for (const char* name : {"transparent", "transparent_zfail"}) {
    const auto first = shade(name, scene, camera, lights);
    std::shuffle(scene.instances.begin(), scene.instances.end(), std::mt19937(5));
    const auto second = shade(name, scene, camera, lights);
    EXPECT_EQ(first.masks[0].tint, second.masks[0].tint) << name;
    EXPECT_EQ(first.masks[0].veils, second.masks[0].veils) << name;
  }
}

TEST_F(TransparentGl, FewerLayersAreTheFirstOfAll) {
  const std::vector<Light> lights{{scene::PointLight{{3, -2, 6}}}};
  const auto scene = soup(300, 1.5, 7);
  const auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3});
  const auto all = shade("transparent", scene, camera, lights);
  for (const int layers : {0, 1, 2, 3}) {
    const auto some = shade("transparent", scene, camera, lights, layers);
    const auto same = shade("transparent_cpu", scene, camera, lights, layers);
    EXPECT_EQ(some.masks[0].tint, all.masks[0].tint) << layers;
    EXPECT_LE(compareAll(some, same).off, 8u) << layers;
    for (std::size_t i = 0; i < all.surface.triangle.size(); ++i)
      for (std::size_t k = 0; k < std::min<std::size_t>(all.veils.at(i).size(), std::size_t(layers)); ++k)
        ASSERT_EQ(some.masks[0].veils[all.veils.first[i] + k], all.masks[0].veils[all.veils.first[i] + k]);
  }
}

std::vector<Light> fourLights() {
  return {{scene::PointLight{{3, -2, 6}}},
          {scene::DirectionalLight{{0.4, 0.3, -1}}},
          {scene::PointLight{{0.1, 0.2, 0.3}}},
          {scene::SpotLight{{-4, 1, 5}, {4, -1, -5}, Angle::degrees(25)}}};
}

// Not a bit may differ: what is summed up before a surface and behind it is the same set of whole numbers.
TEST_F(TransparentGl, ZPassAndZFailAgreeToTheBit) {
  const auto scene = soup(2000, 0.6, 11);
  const auto lights = fourLights();
  for (const Vec3& eye : {Vec3(-7, -6, 4), Vec3(0.05, -0.1, 0.2)}) {
    const auto camera = cameraAt(eye, {0.2, 0.1, -0.3});
    const auto before = shade("transparent", scene, camera, lights),
               behind = shade("transparent_zfail", scene, camera, lights),
               plain = shade("transparent plain", scene, camera, lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      std::size_t other = 0, otherVeils = 0, otherPlain = 0;
      for (std::size_t p = 0; p < before.masks[i].tint.size(); ++p) {
        other += !(before.masks[i].tint.pixels()[p] == behind.masks[i].tint.pixels()[p]);
        otherPlain += !(before.masks[i].tint.pixels()[p] == plain.masks[i].tint.pixels()[p]);
      }
      for (std::size_t k = 0; k < before.masks[i].veils.size(); ++k)
        otherVeils += !(before.masks[i].veils[k] == behind.masks[i].veils[k]);
      std::printf("eye %.1f, light %zu: %zu pixels and %zu veils differ; %zu pixels from plain volumes\n", eye.x, i,
                  other, otherVeils, otherPlain);
      EXPECT_EQ(other, 0u);
      EXPECT_EQ(otherVeils, 0u);
    }
  }
}

// What is drawn on the card is what is painted from the masks, veils over what lies behind them; soft light among them.
TEST_F(TransparentGl, DrawsThePictureThatIsPaintedFromItsMasks) {
  auto scene = soup(600, 1.2, 5);
  for (std::size_t m = 0; m < scene.materials.size(); m += 2) scene.materials[m].emission = {0.1, 0.0, 0.05};
  auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3});
  auto lights = fourLights();
  for (Light& light : lights) light.intensity = 0.4;
  const auto geometry = shadow::makeGeometry(scene);
  for (const auto make : {makeTransparent, makeTransparentZFail, makeSoft}) {
    if (make == makeSoft) lights = {Light{scene::DiscLight{{3, -2, 6}, {-3, 2, -6}, 0.7}}, lights[1]};
    for (const std::size_t count : {lights.size(), std::size_t{0}}) {
      const auto technique = make(sharedContext(), {});
      ASSERT_TRUE(technique->prepare(geometry));
      const gl::CurrentContext current(sharedContext());
      auto frame = render::GpuFrame::make(camera.width, camera.height);
      ASSERT_TRUE(frame);
      const shadow::Frame asked{.camera = camera, .lights = std::span(lights).first(count), .soft = {.samples = 16}};
      ASSERT_TRUE(technique->draw(*frame, asked, {.materials = scene.materials}));
      const auto shading = technique->shade(asked);
      ASSERT_TRUE(shading);
      const auto expected = shadow::composite(scene, geometry->surfaces, camera, *shading, asked.lights);
      const gl::HostScope scope;
      const auto picture = gl::readRgba(scope, frame->pictureTarget(), camera.width, camera.height);
      image::RgbImage drawn(camera.width, camera.height);
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        const auto p = picture.pixels()[i];
        drawn.pixels()[i] = {p.r, p.g, p.b};
      }
      EXPECT_LE(image::compare(drawn, expected).largest, 2) << technique->traits().name << " " << count;
    }
  }
}

// Where veils were is marked in the stencil of the pictures drawn into, which outlives the scene.
TEST_F(TransparentGl, WhatWasDrawnBeforeLeavesNoTrace) {
  auto opaque = soup(200, 1.2, 9);
  for (scene::Material& material : opaque.materials) material.opacity = 1.0;
  const auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3});
  const auto lights = fourLights();
  const auto technique = makeTransparent(sharedContext(), {});
  const gl::CurrentContext current(sharedContext());
  auto used = render::GpuFrame::make(camera.width, camera.height),
       fresh = render::GpuFrame::make(camera.width, camera.height);
  ASSERT_TRUE(used && fresh);
  const auto draw = [&](const scene::Scene& scene, render::GpuFrame& frame) {
    EXPECT_TRUE(technique->prepare(shadow::makeGeometry(scene)));
    EXPECT_TRUE(technique->draw(frame, {.camera = camera, .lights = lights}, {.materials = scene.materials}));
    const gl::HostScope scope;
    return gl::readRgba(scope, frame.pictureTarget(), camera.width, camera.height);
  };
  draw(soup(600, 1.2, 5), *used);
  const auto after = draw(opaque, *used), alone = draw(opaque, *fresh);
  EXPECT_TRUE(std::ranges::equal(after.pixels(), alone.pixels()));
}

TEST_F(TransparentGl, EmptyScenesAndDegenerateTrianglesAreTaken) {
  Builder empty;
  empty.material(Vec3(0.5), 0.5);
  Builder thin;
  const auto glass = thin.material(Vec3(0.5, 1.0, 0.2), 0.4), ground = thin.material(Vec3(0.8), 1.0);
  thin.triangle({0, 0, 1}, {1, 0, 1}, {2, 0, 1}, glass);
  thin.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
  for (const auto* scene : {&empty.scene, &thin.scene})
    for (const char* name : {"transparent", "transparent_zfail"})
      EXPECT_EQ(shade(name, *scene, cameraAt({-2, -3, 5}, {0.1, 0.05, 0}, 32, 24), fourLights()).masks.size(), 4u);
}

// From there the corner has no direction, and the pane's own plane is seen edge-on.
TEST_F(TransparentGl, AnEyeInACornerSeesTheRest) {
  Builder b;
  const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(0.5, 1.0, 0.2), 0.4);
  b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
  b.quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, pane);
  b.quad({0.3, 0.2, 0.5}, {0.4, 0, 0}, {0, 0.4, 0}, ground);
  const std::vector<Light> lights{{scene::PointLight{{0.4, 0.3, 9}}}};
  const auto camera = cameraAt({1, 1, 1}, {0.01, 0.5, -0.3});
  const auto truth = shade("transparent_rays", b.scene, camera, lights);
  for (const char* name : {"transparent", "transparent_zfail"}) {
    const Compared c = compareAll(shade(name, b.scene, camera, lights), truth);
    std::printf("%s: %zu with other surfaces, %zu off\n", name, c.otherVeils, c.off);
    EXPECT_LE(c.off, 2u) << name;
    EXPECT_LE(c.otherVeils, 2u) << name;
  }
}

TEST_F(TransparentGl, SoupsAreAsRaysSeeThem) {
  const auto lights = fourLights();
  for (const auto& [count, size] : {std::pair<std::size_t, double>{300, 1.5}, {2000, 0.6}, {10000, 0.35}}) {
    const auto scene = soup(count, size, 7);
    for (const Vec3& eye : {Vec3(-7, -6, 4), Vec3(0.05, -0.1, 0.2)}) {
      const auto camera = cameraAt(eye, {0.2, 0.1, -0.3});
      const auto truth = shade("transparent_rays", scene, camera, lights);
      const Compared c = compareAll(shade("transparent", scene, camera, lights), truth);
      std::printf("%zu triangles, eye %.1f: %zu pixels, %zu with other surfaces; of %zu surfaces %zu off\n", count,
                  eye.x, c.pixels, c.otherVeils, c.surfaces, c.off);
      // Where surfaces cut each other, which is nearer is rounded to single precision.
      EXPECT_LE(c.otherVeils, c.pixels / 500);
      EXPECT_LE(c.off, c.surfaces / 10000);
    }
  }
}

}  // namespace
}  // namespace umbrage::techniques
