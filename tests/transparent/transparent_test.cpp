#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/veil_scenes.hpp"
#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/read_back.hpp"
#include "umbrage/image/compare.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/techniques/cpu/registry.hpp"
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
    for (const int n : {1, 2, 3, 7, 16, 64}) {
      Builder b;
      const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(1.0), 1.0 - t);
      b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
      for (int i = 0; i < n; ++i) b.quad({0, 0, 1 + 0.05 * i}, {2, 0, 0}, {0, 2, 0}, pane);
      const auto geometry = shadow::makeGeometry(b.scene);
      const Light lamp{scene::PointLight{{0.4, 0.3, 30}}};
      for (const auto* way : {&mine, &behind}) {
        ASSERT_TRUE((*way)->prepare(geometry));
        for (const Vec3& eye : {Vec3(-6, -5, 0.7), Vec3(-2, -3, 12), Vec3(0.3, 0.2, 1.52)}) {  // beside, above and among them
          const auto shading = (*way)->shade({.camera = cameraAt(eye, {0.1, 0.05, 0}, 64, 48), .lights = {&lamp, 1}});
          ASSERT_TRUE(shading);
          // The middle of the picture shows the ground below the panes.
          EXPECT_NEAR(shadow::partsOf(shading->masks[0].tint(32, 24)).x, std::pow(t, n), 1e-4) << t << " " << n << " " << eye.z;
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
      const auto shading =
          shade(name, b.scene, cameraAt({-6, -5, 0.7}, {0.1, 0.05, 0}, 32, 24), {Light{scene::PointLight{{0.4, 0.3, 60}}}}, 0);
      const Vec3 light = shadow::partsOf(shading.masks[0].tint(16, 12));
      EXPECT_NEAR(light.x, 1.0, 1e-4) << name;
      EXPECT_NEAR(light.z, std::pow(t, n), 1e-4) << name << " " << t << " " << n;
    }
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
    const auto before = shade("transparent", scene, camera, lights), behind = shade("transparent_zfail", scene, camera, lights),
               plain = shade("transparent plain", scene, camera, lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      std::size_t other = 0, otherVeils = 0, otherPlain = 0;
      for (std::size_t p = 0; p < before.masks[i].tint.size(); ++p) {
        other += !(before.masks[i].tint.pixels()[p] == behind.masks[i].tint.pixels()[p]);
        otherPlain += !(before.masks[i].tint.pixels()[p] == plain.masks[i].tint.pixels()[p]);
      }
      for (std::size_t k = 0; k < before.masks[i].veils.size(); ++k)
        otherVeils += !(before.masks[i].veils[k] == behind.masks[i].veils[k]);
      std::printf("eye %.1f, light %zu: %zu pixels and %zu veils differ; %zu pixels from plain volumes\n", eye.x, i, other,
                  otherVeils, otherPlain);
      EXPECT_EQ(other, 0u);
      EXPECT_EQ(otherVeils, 0u);
    }
  }
}

TEST_F(TransparentGl, SoupsAreAsRaysSeeThem) {
  const auto lights = fourLights();
  for (const auto& [count, size] : {std::pair<std::size_t, double>{300, 1.5}, {2000, 0.6}, {10000, 0.35}}) {
    const auto scene = soup(count, size, 7);
    for (const Vec3& eye : {Vec3(-7, -6, 4), Vec3(0.05, -0.1, 0.2)}) {
      const auto camera = cameraAt(eye, {0.2, 0.1, -0.3});
      const auto truth = shade("transparent_rays", scene, camera, lights);
      for (const char* name : {"transparent", "transparent_zfail"}) {
        const Compared c = compareAll(shade(name, scene, camera, lights), truth);
        std::printf("%s, %zu triangles, eye %.1f: %zu pixels, %zu with other surfaces; of %zu surfaces %zu off\n", name, count,
                    eye.x, c.pixels, c.otherVeils, c.surfaces, c.off);
        EXPECT_LE(c.otherVeils, c.pixels / 100);
        EXPECT_LE(c.off, c.surfaces / 100);
      }
    }
  }
}

}  // namespace
}  // namespace umbrage::techniques
