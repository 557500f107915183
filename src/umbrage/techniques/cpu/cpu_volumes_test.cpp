#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::techniques {
namespace {

std::unique_ptr<shadow::Technique> make(std::string_view name) {
  for (const auto& entry : cpuTechniques())
    if (entry.traits.name == name) return std::move(*entry.create());
  return nullptr;
}

shadow::Shading shade(shadow::Technique& technique, const scene::Camera& camera, std::span<const scene::Light> lights) {
  auto shading = technique.shade({.camera = camera, .lights = lights});
  EXPECT_TRUE(shading.has_value());
  return std::move(*shading);
}

std::shared_ptr<const shadow::Geometry> yard() {
  return shadow::makeGeometry(shapes::scene({shapes::box({0, 0, 0}, {2, 2, 3}), shapes::sphere({4, 1, 1}, 1, 16, 8),
                                             shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})}));
}
scene::Camera fromTheCorner(int width, int height) {
  scene::Camera camera;
  camera.eye = {-4.1, -7.3, 6.2}, camera.target = {1, 1, 0.5};
  camera.width = width, camera.height = height;
  return camera;
}
std::vector<scene::Light> threeLights() {
  return {{scene::PointLight{{3, -4, 6}}},
          {scene::DirectionalLight{{0.4, 0.3, -0.7}}},
          {scene::SpotLight{{-2, 5, 6}, {0.5, -0.6, -0.9}, Angle::degrees(25)}}};
}

std::size_t differing(const shadow::Shading& a, const shadow::Shading& b) {
  std::size_t count = 0;
  for (std::size_t l = 0; l < a.masks.size(); ++l)
    for (std::size_t i = 0; i < a.masks[l].light.size(); ++i)
      count += a.masks[l].light.pixels()[i] != b.masks[l].light.pixels()[i] ||
               a.masks[l].covered.pixels()[i] != b.masks[l].covered.pixels()[i];
  return count;
}

// Blocks, tiles and bands that stick out of the picture, down to one pixel, and more tiles than a word has bits.
TEST(CpuVolumes, EqualRayTracedMasksAtAnySize) {
  const auto geometry = yard();
  const auto lights = threeLights();
  for (const auto& name : {"zpass_cpu", "hybrid_cpu"}) {
    auto truth = make("ray_traced"), technique = make(name);
    ASSERT_TRUE(truth->prepare(geometry) && technique->prepare(geometry));
    for (const auto& [width, height] :
         {std::pair{1, 1}, {7, 3}, {8, 8}, {65, 17}, {201, 129}, {5001, 9}, {3, 700}, {640, 360}}) {
      const scene::Camera camera = fromTheCorner(width, height);
      const auto a = shade(*truth, camera, lights), b = shade(*technique, camera, lights);
      for (std::size_t l = 0; l < lights.size(); ++l) {
        const auto difference = shadow::compare(b.masks[l], a.masks[l], shadow::edgePixels(a.masks[l]));
        EXPECT_EQ(difference.farFromEdge, 0u) << name << ' ' << width << 'x' << height;
        EXPECT_LE(difference.differing, 1u) << name << ' ' << width << 'x' << height;
      }
    }
  }
}

TEST(CpuVolumes, WorkForSceneAfterScene) {
  auto technique = make("zpass_cpu");
  const scene::Camera camera = fromTheCorner(64, 48);
  const auto lights = threeLights();
  ASSERT_TRUE(technique->prepare(yard()));
  const auto first = shade(*technique, camera, lights);
  ASSERT_TRUE(technique->prepare(shadow::makeGeometry(scene::Scene{})));
  const auto empty = shade(*technique, camera, lights);
  EXPECT_TRUE(std::ranges::all_of(empty.masks[0].covered.pixels(), [](auto c) { return c == 0; }));
  ASSERT_TRUE(technique->prepare(yard()));
  EXPECT_EQ(differing(first, shade(*technique, camera, lights)), 0u);
}

TEST(CpuVolumes, TellWhatWasDoneForEachLight) {
  auto technique = make("zpass_cpu");
  ASSERT_TRUE(technique->prepare(yard()));
  const auto lights = threeLights();
  auto shading = technique->shade({.camera = fromTheCorner(64, 48), .lights = lights, .detailed = true});
  ASSERT_TRUE(shading);
  ASSERT_EQ(shading->stats.lights.size(), 3u);
  for (const shadow::LightStats& light : shading->stats.lights) {
    EXPECT_EQ(light.method, "zpass_cpu");
    EXPECT_GT(light.silhouetteEdges, 0u);
    EXPECT_GT(light.volumeTriangles, 0u);
    EXPECT_EQ(light.choices.size(), 3u);
  }
}

std::shared_ptr<const shadow::Geometry> soup(int triangles) {
  return shadow::makeGeometry(shapes::scene(
      {shapes::soup(3, triangles, [](shapes::Random& r) { return Vec3(r.in(-3, 3), r.in(-3, 3), r.in(0, 3)); })}));
}

// What the camera sees is kept for other lights, whoever wants it told; but not for another camera or another geometry.
TEST(CpuTechniques, KeepWhatTheCameraSeesAndNoMore) {
  const auto lights = threeLights();
  const scene::Camera near = fromTheCorner(64, 48), wide = fromTheCorner(65, 48);
  for (const auto& name : {"zpass_cpu", "hybrid_cpu", "ray_traced"}) {
    auto kept = make(name);
    for (const auto& geometry : {yard(), soup(500), yard()}) {
      ASSERT_TRUE(kept->prepare(geometry));
      const scene::Camera* last = nullptr;
      for (const scene::Camera* camera : {&near, &near, &wide, &near}) {
        for (std::size_t l = 0; l < lights.size(); ++l) {
          const std::span<const scene::Light> one(&lights[l], 1);
          auto fresh = make(name);
          ASSERT_TRUE(fresh->prepare(geometry));
          const auto expected = fresh->shade({.camera = *camera, .lights = one});
          const auto found = kept->shade({.camera = *camera, .lights = one, .surfaceWanted = l != 1});
          ASSERT_TRUE(expected && found);
          EXPECT_EQ(differing(*expected, *found), 0u) << name;
          EXPECT_TRUE(l == 1 || found->surface.triangle == expected->surface.triangle) << name;
          EXPECT_EQ(found->stats.surfaceKept, last == camera) << name;
          last = camera;
        }
      }
    }
  }
}

// So many triangles for so few pixels that rays see them, once their tree has paid for itself.
TEST(HybridCpu, KeepsWhatRaysSeeToo) {
  const auto lights = threeLights();
  const scene::Camera near = fromTheCorner(64, 48), wide = fromTheCorner(65, 48), tall = fromTheCorner(64, 49);
  auto technique = make("hybrid_cpu"), truth = make("ray_traced");
  const auto many = soup(20000);
  ASSERT_TRUE(technique->prepare(many) && truth->prepare(many));
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(technique->shade({.camera = near, .lights = lights}));
  for (const scene::Camera* camera : {&wide, &tall, &wide}) {
    for (std::size_t l = 0; l < lights.size(); ++l) {
      const std::span<const scene::Light> one(&lights[l], 1);
      const auto found = technique->shade({.camera = *camera, .lights = one, .surfaceWanted = l != 1});
      ASSERT_TRUE(found);
      EXPECT_NE(found->stats.lights[0].reason.find("so are the surfaces"), std::string::npos);
      EXPECT_EQ(found->stats.surfaceKept, l > 0);
      EXPECT_EQ(differing(shade(*truth, *camera, one), *found), 0u);
    }
  }
}

// A soup is all silhouette. The tree is not built before rays would have paid for it.
TEST(HybridCpu, TracesRaysWhereTheSidesAreTooManyAndCountsElsewhere) {
  const auto lights = std::vector<scene::Light>{{scene::DirectionalLight{{0.4, 0.3, -0.7}}}};
  auto technique = make("hybrid_cpu");
  ASSERT_TRUE(technique->prepare(yard()));
  EXPECT_EQ(shade(*technique, fromTheCorner(320, 180), lights).stats.lights.front().method, "zpass_cpu");

  const auto soup = shadow::makeGeometry(shapes::scene(
      {shapes::soup(3, 20000, [](shapes::Random& r) { return Vec3(r.in(-3, 3), r.in(-3, 3), r.in(0, 3)); })}));
  ASSERT_TRUE(technique->prepare(soup));
  EXPECT_EQ(shade(*technique, fromTheCorner(320, 180), lights).stats.lights.front().method, "ray_traced");
}

}  // namespace
}  // namespace umbrage::techniques
