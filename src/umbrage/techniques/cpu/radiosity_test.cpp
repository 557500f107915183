#include <gtest/gtest.h>

#include <cmath>

#include "support/shapes.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::techniques {
namespace {

using scene::Light;

shadow::LightMask maskBy(std::string_view name, const std::shared_ptr<const shadow::Geometry>& geometry,
                         const Light& light, std::size_t samples) {
  scene::Camera camera;
  camera.eye = {-4.1, -7.3, 6.2}, camera.target = {1, 1, 0.5}, camera.up = {0, 0, 1};
  camera.width = 160, camera.height = 120;
  for (const auto& entry : cpuTechniques()) {
    if (entry.traits.name != name) continue;
    const auto made = std::move(*entry.create());
    EXPECT_TRUE(made->prepare(geometry));
    auto shading = made->shade({.camera = camera, .lights = {&light, 1}, .soft = {.samples = samples}});
    EXPECT_TRUE(shading);
    return std::move(shading->masks.front());
  }
  ADD_FAILURE() << name;
  return {};
}

double rootMeanSquare(const shadow::LightMask& mask, const shadow::LightMask& truth) {
  double sum = 0.0;
  std::size_t covered = 0;
  for (std::size_t i = 0; i < truth.light.size(); ++i) {
    EXPECT_EQ(mask.covered.pixels()[i], truth.covered.pixels()[i]);
    if (truth.covered.pixels()[i] == 0) continue;
    const double d = (int(mask.light.pixels()[i]) - int(truth.light.pixels()[i])) / 255.0;
    sum += d * d, ++covered;
  }
  return std::sqrt(sum / double(covered));
}

// It is approximate, and this is by how much.
TEST(RadiosityMask, IsNearTheTruth) {
  const auto geometry = shadow::makeGeometry(shapes::scene(
      {shapes::box({0, 0, 0}, {2, 2, 3}), shapes::sphere({4, 1, 1}, 1, 32, 16), shapes::box({-3, 1, 1}, {-2, 3, 1.2}),
       shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})}));
  struct Row {
    const char* name;
    Light light;
    const char* truth;
    double most;
  };
  for (const Row& row : {Row{"point", {scene::PointLight{{4, -3, 8}}}, "ray_traced", 0.03},
                         Row{"disc", {scene::DiscLight{{4, -3, 8}, {-4, 3, -8}, 0.8}}, "soft_rays", 0.01},
                         Row{"ball", {scene::SphereLight{{4, -3, 8}, 0.8}}, "soft_rays", 0.01}}) {
    const auto truth = maskBy(row.truth, geometry, row.light, 256);
    const double error = rootMeanSquare(maskBy("radiosity", geometry, row.light, 64), truth);
    std::printf("%s: off by %.4f of the light (root of the mean square)\n", row.name, error);
    EXPECT_LT(error, row.most) << row.name;
  }
}

// From the side that a light does not reach, and where the whole plane is lit, nothing is approximate.
TEST(RadiosityMask, IsExactWhereNothingChanges) {
  const auto geometry =
      shadow::makeGeometry(shapes::scene({shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})}));
  for (const double z : {5.0, -5.0}) {
    const auto mask = maskBy("radiosity", geometry, {scene::PointLight{{1, 2, z}}}, 1);
    for (std::size_t i = 0; i < mask.light.size(); ++i) {
      if (mask.covered.pixels()[i] == 0) continue;
      ASSERT_EQ(mask.light.pixels()[i], z > 0.0 ? 255 : 0);
    }
  }
}

TEST(RadiosityMask, OfNothing) {
  scene::Scene empty;
  empty.materials.push_back({"grey", Vec3(0.8)});
  const auto mask = maskBy("radiosity", shadow::makeGeometry(empty), {scene::PointLight{}}, 1);
  for (const std::uint8_t covered : mask.covered.pixels()) ASSERT_EQ(covered, 0);
}

}  // namespace
}  // namespace umbrage::techniques
