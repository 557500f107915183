#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/veil_scenes.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/shadow/veil_layers.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::techniques {
namespace {

using namespace support;
using scene::Light;

std::unique_ptr<shadow::Technique> technique(const std::string& name) {
  for (const auto& entry : cpuTechniques())
    if (entry.traits.name == name) return std::move(*entry.create());
  return nullptr;
}

shadow::Shading shade(const std::string& name, const scene::Scene& scene, const scene::Camera& camera,
                      const std::vector<Light>& lights, std::optional<int> veilLayers = {}) {
  const auto made = technique(name);
  EXPECT_TRUE(made->prepare(shadow::makeGeometry(scene)));
  auto shading = made->shade({.camera = camera, .lights = lights, .veilLayers = veilLayers});
  EXPECT_TRUE(shading);
  return std::move(*shading);
}

TEST(Transparent, PanesTakeTheirShareEach) {
  for (const double t : {0.02, 0.1, 0.5, 0.9, 0.98}) {
    for (const int n : {1, 2, 3, 7, 16, 64}) {
      Builder b;
      const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(1.0), 1.0 - t);
      b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
      for (int i = 0; i < n; ++i) b.quad({0, 0, 1 + 0.05 * i}, {2, 0, 0}, {0, 2, 0}, pane);
      for (const Vec3& eye :
           {Vec3(-6, -5, 0.7), Vec3(-2, -3, 12), Vec3(0.3, 0.2, 1.52)}) {  // beside, above and among them
        const auto camera = cameraAt(eye, {0.1, 0.05, 0}, 64, 48);
        for (const char* name : {"transparent_cpu", "transparent_rays"}) {
          const auto shading = shade(name, b.scene, camera, {Light{scene::PointLight{{0.4, 0.3, 30}}}});
          // The middle of the picture shows the ground below the panes.
          EXPECT_NEAR(shadow::partsOf(shading.masks[0].tint(32, 24)).x, std::pow(t, n), 1e-4)
              << name << " " << t << " " << n << " " << eye.z;
        }
      }
    }
  }
}

TEST(Transparent, HundredsOfPanesAddUp) {
  for (const auto& [t, n] : {std::pair{0.995, 400}, {0.999, 900}, {1e-3, 300}, {0.0, 300}}) {
    Builder b;
    const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(1.0, 1.0, t), 0.0);  // blue alone is taken
    b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
    for (int i = 0; i < n; ++i) b.quad({0, 0, 1 + 0.01 * i}, {2, 0, 0}, {0, 2, 0}, pane);
    const auto shading = shade("transparent_cpu", b.scene, cameraAt({-6, -5, 0.7}, {0.1, 0.05, 0}, 32, 24),
                               {Light{scene::PointLight{{0.4, 0.3, 60}}}});
    const Vec3 light = shadow::partsOf(shading.masks[0].tint(16, 12));
    EXPECT_NEAR(light.x, 1.0, 1e-4);
    EXPECT_NEAR(light.z, std::pow(t, n), 1e-4) << t << " " << n;
  }
}

// Glass of one pure colour takes nearly all of the others; that there is some beside makes no other's share coarser.
TEST(Transparent, PureColoursMakeNothingCoarser) {
  for (const auto& [t, n] : {std::pair{0.976, 41}, {0.98, 64}, {0.999, 900}}) {
    Builder b;
    const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(1.0), 1.0 - t),
               red = b.material(Vec3(1.0, 0.0, 0.0), 0.3);
    b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
    for (int i = 0; i < n; ++i) b.quad({0, 0, 1 + 0.01 * i}, {2, 0, 0}, {0, 2, 0}, pane);
    b.quad({2.5, 2.5, 1}, {0.2, 0, 0}, {0, 0.2, 0}, red);
    const auto geometry = shadow::makeGeometry(b.scene);
    const shadow::FilterSum one = geometry->filters.of(2);  // after the ground's two
    const Vec3f left = geometry->filters.transmitted({n * one[0], n * one[1], n * one[2]});
    // Half of the finest step each.
    EXPECT_NEAR(left.x, std::pow(t, n), n * 0x1p-25) << t << " " << n;
  }
}

TEST(Transparent, TheOrderOfCastersChangesNothing) {
  const std::vector<Light> lights{{scene::PointLight{{3, -2, 6}}}};
  auto scene = soup(400, 1.2, 3);
  const auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3});
  const auto first = shade("transparent_cpu", scene, camera, lights);
  std::shuffle(scene.instances.begin(), scene.instances.end(), std::mt19937(5));
  const auto second = shade("transparent_cpu", scene, camera, lights);
  EXPECT_EQ(first.masks[0].tint, second.masks[0].tint);
  EXPECT_EQ(first.masks[0].veils, second.masks[0].veils);
}

TEST(Transparent, OpaqueScenesAreThoseOfTheOpaqueTechniques) {
  auto scene = soup(2000, 0.6, 9);
  for (scene::Material& material : scene.materials) material.opacity = 1.0;
  const std::vector<Light> lights{{scene::PointLight{{3, -2, 6}}}};
  const auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3});
  const auto opaque = shade("zpass_cpu", scene, camera, lights),
             tinted = shade("transparent_cpu", scene, camera, lights);
  EXPECT_TRUE(tinted.veils.empty());
  EXPECT_EQ(opaque.masks[0].light, tinted.masks[0].light);
  EXPECT_EQ(opaque.surface.triangle, tinted.surface.triangle);
}

TEST(Transparent, FewerLayersAreTheFirstOfAll) {
  const std::vector<Light> lights{{scene::PointLight{{3, -2, 6}}}};
  const auto scene = soup(300, 1.5, 7);
  const auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3});
  const auto all = shade("transparent_cpu", scene, camera, lights);
  for (const int layers : {0, 1, 2}) {
    const auto some = shade("transparent_cpu", scene, camera, lights, layers);
    EXPECT_EQ(some.masks[0].tint, all.masks[0].tint) << layers;
    for (std::size_t i = 0; i < all.surface.triangle.size(); ++i)
      for (std::size_t k = 0; k < std::min<std::size_t>(all.veils.at(i).size(), std::size_t(layers)); ++k)
        ASSERT_EQ(some.masks[0].veils[all.veils.first[i] + k], all.masks[0].veils[all.veils.first[i] + k]);
  }
}

TEST(Transparent, LayersThatMatterAreFewerAndChangeNothingThatIsSeen) {
  Builder b;
  const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(0.5), 0.5);
  b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
  for (int i = 0; i < 20; ++i) b.quad({0.05 * i, 0, 1 + 0.05 * i}, {1, 0, 0}, {0, 1, 0}, pane);
  const std::vector<Light> lights{{scene::PointLight{{0.4, 0.3, 30}}}};
  const auto camera = cameraAt({-1, -2, 9}, {0.4, 0.05, 0.5});
  const auto all = shade("transparent_cpu", b.scene, camera, lights);
  const auto matter = shade("transparent_cpu", b.scene, camera, lights, shadow::kVeilLayersThatMatter);
  const auto rays = shade("transparent_rays", b.scene, camera, lights, shadow::kVeilLayersThatMatter);
  // A quarter comes through each: of the fifth less than 1/255 is seen, not of the fourth.
  const shadow::Filters filters = shadow::makeGeometry(b.scene)->filters;
  EXPECT_EQ(shadow::litVeilLayers(shadow::kVeilLayersThatMatter, all.veils, filters), 4u);
  EXPECT_EQ(shadow::litVeilLayers(7, all.veils, filters), 7u);
  EXPECT_GT(shadow::litVeilLayers({}, all.veils, filters), 1000u);
  EXPECT_EQ(shadow::litVeilLayers(shadow::kVeilLayersThatMatter, {}, filters), 0u);
  EXPECT_EQ(matter.masks[0].tint, all.masks[0].tint);
  EXPECT_EQ(compareAll(matter, rays).off, 0u);
  std::size_t others = 0;
  for (std::size_t i = 0; i < all.surface.triangle.size(); ++i)
    for (std::size_t k = 0; k < all.veils.at(i).size(); ++k) {
      const bool same = matter.masks[0].veils[all.veils.first[i] + k] == all.masks[0].veils[all.veils.first[i] + k];
      EXPECT_TRUE(same || k >= 4);
      others += same ? 0 : 1;
    }
  EXPECT_GT(others, 100u);
  const auto geometry = shadow::makeGeometry(b.scene);
  const auto one = shadow::composite(b.scene, geometry->surfaces, camera, all, lights),
             two = shadow::composite(b.scene, geometry->surfaces, camera, matter, lights);
  int most = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    most = std::max(most, std::abs(int(one.pixels()[i].g) - int(two.pixels()[i].g)));
  EXPECT_LE(most, 3) << "codes are of the sRGB curve, which is steep where it is dark";
}

TEST(Transparent, TheGreyMaskIsTheLuminanceOfTheTint) {
  const std::vector<Light> lights{{scene::PointLight{{3, -2, 6}}}, {scene::DirectionalLight{{0.4, 0.3, -1}}}};
  const auto camera = cameraAt({-7, -6, 4}, {0.2, 0.1, -0.3});
  for (const char* name : {"transparent_cpu", "transparent_rays"}) {
    const auto shading = shade(name, soup(300, 1.5, 7), camera, lights);
    for (const shadow::LightMask& mask : shading.masks)
      for (std::size_t i = 0; i < mask.light.size(); ++i)
        ASSERT_EQ(mask.light.pixels()[i], shadow::luminanceCode(mask.tint.pixels()[i])) << name;
  }
}

TEST(Transparent, VeilsThatCastNothingAreSeenThrough) {
  Builder b;
  const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(1.0, 0.2, 0.2), 0.5);
  b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
  b.quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, pane);
  for (scene::Instance& instance : b.scene.instances) instance.casts = false;
  const std::vector<Light> lights{{scene::PointLight{{0.4, 0.3, 9}}}};
  const auto camera = cameraAt({-2, -3, 5}, {0.1, 0.05, 0});
  const auto mine = shade("transparent_cpu", b.scene, camera, lights),
             truth = shade("transparent_rays", b.scene, camera, lights);
  EXPECT_EQ(mine.surface.triangle, truth.surface.triangle);
  EXPECT_GT(mine.veils.veils.size(), 100u);
  EXPECT_EQ(mine.veils.veils.size(), truth.veils.veils.size());
}

// From there the corner has no direction.
TEST(Transparent, AnEyeInACornerSeesTheRest) {
  Builder b;
  const auto ground = b.material(Vec3(0.8), 1.0), pane = b.material(Vec3(0.5, 1.0, 0.2), 0.4);
  b.quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, ground);
  b.quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, pane);
  b.quad({0.3, 0.2, 0.5}, {0.4, 0, 0}, {0, 0.4, 0}, ground);
  const std::vector<Light> lights{{scene::PointLight{{0.4, 0.3, 9}}}};
  const auto camera = cameraAt({1, 1, 1}, {0.01, 0.5, -0.3});
  const auto truth = shade("transparent_rays", b.scene, camera, lights);
  EXPECT_EQ(compareAll(shade("transparent_cpu", b.scene, camera, lights), truth).off, 0u);
  for (scene::Material& material : b.scene.materials) material.opacity = 1.0;
  const auto opaque = shade("zpass_cpu", b.scene, camera, lights), rays = shade("ray_traced", b.scene, camera, lights);
  EXPECT_LT(shadow::compare(opaque.masks[0], rays.masks[0], shadow::edgePixels(rays.masks[0])).farFromEdge, 3u);
}

TEST(Transparent, SoupsAreAsRaysSeeThem) {
  const std::vector<Light> lights{{scene::PointLight{{3, -2, 6}}},
                                  {scene::DirectionalLight{{0.4, 0.3, -1}}},
                                  {scene::PointLight{{0.1, 0.2, 0.3}}},
                                  {scene::SpotLight{{-4, 1, 5}, {4, -1, -5}, Angle::degrees(25)}}};
  for (const auto& [count, size] : {std::pair<std::size_t, double>{300, 1.5}, {2000, 0.6}, {10000, 0.35}}) {
    const auto scene = soup(count, size, 7);
    for (const Vec3& eye : {Vec3(-7, -6, 4), Vec3(0.05, -0.1, 0.2)}) {
      const auto camera = cameraAt(eye, {0.2, 0.1, -0.3});
      const auto mine = shade("transparent_cpu", scene, camera, lights),
                 truth = shade("transparent_rays", scene, camera, lights);
      const Compared c = compareAll(mine, truth);
      std::printf("%zu triangles, eye %.1f: %zu pixels, %zu with other surfaces; of %zu surfaces %zu off\n", count,
                  eye.x, c.pixels, c.otherVeils, c.surfaces, c.off);
      EXPECT_LE(c.otherVeils, c.pixels / 1000);
      EXPECT_LE(c.off, c.surfaces / 10000);
    }
  }
}

}  // namespace
}  // namespace umbrage::techniques
