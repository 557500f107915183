#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.hpp"
#include "umbrage/shadow/edge_finder.hpp"
#include "umbrage/techniques/cpu/detail/shadow_lists.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::techniques {
namespace {

constexpr std::array kBoth{"scanline", "scanline_projected"};

std::unique_ptr<shadow::Technique> make(std::string_view name) {
  for (const auto& entry : cpuTechniques())
    if (entry.traits.name == name) return std::move(*entry.create());
  return nullptr;
}

std::vector<scene::Light> threeLights() {
  return {{scene::PointLight{{3, -4, 6}}},
          {scene::DirectionalLight{{0.4, 0.3, -0.7}}},
          {scene::SpotLight{{-2, 5, 6}, {0.5, -0.6, -0.9}, Angle::degrees(25)}}};
}
scene::Camera cameraAt(const Vec3& eye, const Vec3& target, int width, int height) {
  scene::Camera camera;
  camera.eye = eye, camera.target = target;
  camera.width = width, camera.height = height;
  return camera;
}
shapes::Mesh ground() { return shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}); }

// Pixels that differ from ray tracing away from every edge of its mask, of both techniques and all lights.
void expectTruth(const scene::Scene& scene, const scene::Camera& camera, const std::vector<scene::Light>& lights,
                 std::size_t most, const std::string& what) {
  const auto geometry = shadow::makeGeometry(scene);
  auto truth = make("ray_traced");
  ASSERT_TRUE(truth->prepare(geometry));
  const auto expected = truth->shade({.camera = camera, .lights = lights});
  ASSERT_TRUE(expected);
  for (const auto& name : kBoth) {
    auto technique = make(name);
    ASSERT_TRUE(technique->prepare(geometry));
    const auto shading = technique->shade({.camera = camera, .lights = lights});
    ASSERT_TRUE(shading);
    for (std::size_t l = 0; l < lights.size(); ++l) {
      const shadow::LightMask& mask = expected->masks[l];
      const auto difference = shadow::compare(shading->masks[l], mask, shadow::edgePixels(mask));
      EXPECT_EQ(difference.farFromEdge, 0u) << name << ", " << what << ", light " << l;
      EXPECT_LE(difference.differing, most) << name << ", " << what << ", light " << l;
    }
  }
}

TEST(Scanline, EqualsRayTracedMasksAtAnySize) {
  const scene::Scene yard =
      shapes::scene({shapes::box({0, 0, 0}, {2, 2, 3}), shapes::sphere({4, 1, 1}, 1, 16, 8), ground()});
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {65, 17}, {201, 129}, {2001, 9}, {3, 300}, {640, 360}})
    expectTruth(yard, cameraAt({-4.1, -7.3, 6.2}, {1, 1, 0.5}, width, height), threeLights(), 1,
                std::to_string(width) + "x" + std::to_string(height));
}

// A box without a lid and a sheet: silhouettes of weights 2 and 1, and the eye in every shadow.
TEST(Scanline, CountsOpenModelsWithTheEyeAnywhere) {
  shapes::Mesh open = shapes::box({-1, -1, 0.5}, {1, 1, 2});
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  const scene::Scene scene =
      shapes::scene({open, shapes::quad({-2, -2, 3}, {0.3, -2, 3.1}, {0.4, 0.5, 3.3}, {-2, 0.5, 3.2}), ground()});
  for (const Vec3& eye : {Vec3(-4.1, -7.3, 6.2), Vec3(0.1, 0.2, 1.1), Vec3(0.3, 0.4, 0.2), Vec3(-1.1, -0.7, 2.6)})
    expectTruth(scene, cameraAt(eye, {2.1, 3.2, 0.1}, 161, 91), threeLights(), 4, "eye " + std::to_string(eye.x));
}

// Boxes through each other and through the ground.
TEST(Scanline, CutsPenetratingSolids) {
  const scene::Scene scene =
      shapes::scene({shapes::box({-1, -1, -0.5}, {1, 1, 2}), shapes::box({-2, -0.3, 0.4}, {2, 0.5, 1.1}),
                     shapes::sphere({0.3, 0.2, 1.6}, 1.1, 24, 12), ground()});
  expectTruth(scene, cameraAt({-4.1, -5.3, 4.2}, {0, 0, 0.5}, 320, 200), threeLights(), 6, "penetrating");
}

// On the plane of a side, on the side itself, in the plane of a face and in a corner; there the eye counts as moved by an infinitely small step.
TEST(Scanline, IsRightForEyesOnSides) {
  const scene::Scene scene = shapes::scene({shapes::box({-1, -1, 0.5}, {1, 1, 2}), ground()});
  const std::vector<scene::Light> lights{{scene::DirectionalLight{{1, 0, -1}}}, {scene::PointLight{{-3, 1, 4}}}};
  for (const Vec3& eye : {Vec3(2, 1, 0.25), Vec3(1.5, 1, 0.5), Vec3(3, -4, 0.5), Vec3(2, 2, 2), Vec3(2.5, 0.25, 0.5)})
    expectTruth(scene, cameraAt(eye, {0.2, 0.1, 0.3}, 121, 81), lights, 2, "eye " + std::to_string(eye.x));
}

// 2,000 km, where single precision would know an eighth of a metre.
TEST(Scanline, IsRightFarFromTheOrigin) {
  const Vec3 far(1e6, -2e6, 0);
  const scene::Scene scene = shapes::scene(
      {shapes::box(far + Vec3(-1, -1, 0), far + Vec3(1, 1, 3)),
       shapes::quad(far + Vec3(-90, -90, 0), far + Vec3(90, -90, 0), far + Vec3(90, 90, 0), far + Vec3(-90, 90, 0))});
  const std::vector<scene::Light> lights{{scene::DirectionalLight{{0.4, 0.3, -0.7}}},
                                         {scene::PointLight{far + Vec3(3, -4, 6)}}};
  expectTruth(scene, cameraAt(far + Vec3(-6, -9, 4), far, 200, 120), lights, 3, "far");
}

TEST(Scanline, WorksForSceneAfterScene) {
  const auto lights = threeLights();
  const scene::Camera camera = cameraAt({-4.1, -7.3, 6.2}, {1, 1, 0.5}, 64, 48);
  const auto yard = shadow::makeGeometry(shapes::scene({shapes::box({0, 0, 0}, {2, 2, 3}), ground()}));
  for (const auto& name : kBoth) {
    auto technique = make(name);
    ASSERT_TRUE(technique->prepare(yard));
    const auto first = technique->shade({.camera = camera, .lights = lights});
    ASSERT_TRUE(technique->prepare(shadow::makeGeometry(scene::Scene{})));
    const auto empty = technique->shade({.camera = camera, .lights = lights});
    ASSERT_TRUE(first && empty);
    EXPECT_TRUE(std::ranges::all_of(empty->masks[0].covered.pixels(), [](auto c) { return c == 0; }));
    ASSERT_TRUE(technique->prepare(yard));
    const auto again = technique->shade({.camera = camera, .lights = lights});
    ASSERT_TRUE(again);
    for (std::size_t l = 0; l < lights.size(); ++l) EXPECT_EQ(again->masks[l].light, first->masks[l].light);
    EXPECT_EQ(again->stats.lights[0].method, name);
  }
}

// Every pixel of soups: our own rasteriser counts the same sides block by block, with the same exact signs.
TEST(Scanline, CountsWhatZPassCpuCountsInSoups) {
  const auto lights = threeLights();
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto soup = shadow::makeGeometry(shapes::scene(
        {shapes::soup(seed, 60, [](shapes::Random& r) { return Vec3(r.in(-3, 3), r.in(-3, 3), r.in(0, 3)); }),
         ground()}));
    const scene::Camera camera = cameraAt({-4.1, 0.3 * double(seed), 2.2}, {1, 1, 0.5}, 160, 100);
    auto scanline = make("scanline"), blocks = make("zpass_cpu");
    ASSERT_TRUE(scanline->prepare(soup) && blocks->prepare(soup));
    const auto a = scanline->shade({.camera = camera, .lights = lights}),
               b = blocks->shade({.camera = camera, .lights = lights});
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->surface.triangle, b->surface.triangle) << seed;
    for (std::size_t l = 0; l < lights.size(); ++l) EXPECT_EQ(a->masks[l].light, b->masks[l].light) << seed << ' ' << l;
  }
}

TEST(ShadowLists, OfNothingAreEmptyEverywhere) {
  const auto geometry = shadow::makeGeometry(scene::withGround(scene::Scene{}, 0.0));
  for (const Vec4& light : {Vec4(0, 0, 1, 0), Vec4(1, 2, 3, 1)}) {
    const detail::ShadowLists lists(geometry->casters, shadow::findSilhouette(geometry->casters, light));
    EXPECT_EQ(lists.size(), 0u);
    for (const Vec3& point : {Vec3(0), Vec3(0, 0, -5), Vec3(1e30, 0, 0), Vec3(-3, 1e-30, 2)}) {
      const auto cell = lists.cellOf(point);
      ASSERT_TRUE(cell);
      EXPECT_TRUE(lists.of(*cell).empty());
    }
  }
}

// Every triangle is listed in the cells of all its points, for both kinds of lights.
TEST(ShadowLists, HoldEveryTriangleWhereTheLightSeesIt) {
  shapes::Random random(4);
  const auto geometry = shadow::makeGeometry(shapes::scene(
      {shapes::soup(8, 200, [](shapes::Random& r) { return Vec3(r.in(-3, 3), r.in(-3, 3), r.in(0, 3)); })}));
  const shadow::CasterSet& casters = geometry->casters;
  for (const Vec4& light : {Vec4(0.3, 0.4, 1.0, 0.0), Vec4(0.1, 0.2, 1.5, 1.0), Vec4(9, 2, 5, 1)}) {
    const shadow::Silhouette counted = shadow::findSilhouette(casters, light);
    const detail::ShadowLists lists(casters, counted);
    for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
      if (counted.side[t] == 0) continue;
      for (int i = 0; i < 20; ++i) {
        const double u = random.in(0, 1), v = random.in(0, 1) * (1 - u);
        const Vec3 p = (1 - u - v) * casters.corner(t, 0) + u * casters.corner(t, 1) + v * casters.corner(t, 2);
        // Anywhere behind it as the light sees it.
        const Vec3 behind = p + random.in(0, 5) * (p * light.w - Vec3(light));
        const auto cell = lists.cellOf(behind);
        ASSERT_TRUE(cell);
        const auto list = lists.of(*cell);
        EXPECT_NE(std::find(list.begin(), list.end(), t), list.end());
      }
    }
  }
}

}  // namespace
}  // namespace umbrage::techniques
