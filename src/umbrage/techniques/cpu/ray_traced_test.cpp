#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "support/oracle.hpp"
#include "support/shapes.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::techniques {
namespace {

using scene::Camera;
using scene::Light;

Light point(const Vec3& p) { return {scene::PointLight{p}, Vec3(1.0), 1.0, ""}; }
Light sun(const Vec3& travels) { return {scene::DirectionalLight{travels}, Vec3(1.0), 1.0, ""}; }
Light spot(const Vec3& p, const Vec3& d, Angle cutoff) { return {scene::SpotLight{p, d, cutoff}, Vec3(1.0), 1.0, ""}; }

struct Shot {
  std::shared_ptr<const shadow::Geometry> geometry;
  shadow::Shading shading;
};

Shot shoot(const scene::Scene& s, const Camera& camera, const std::vector<Light>& lights) {
  auto technique = cpuTechniques().front().create();
  EXPECT_TRUE(technique.has_value());
  Shot shot{shadow::makeGeometry(s), {}};
  EXPECT_TRUE((*technique)->prepare(shot.geometry).has_value());
  auto shading = (*technique)->shade({camera, lights});
  EXPECT_TRUE(shading.has_value());
  shot.shading = std::move(*shading);
  return shot;
}

struct Agreement {
  std::size_t clear = 0, lit = 0, wrong = 0;
};

// Every pixel that the oracle is sure of.
Agreement compareWithOracle(const Shot& shot, const Camera& camera, const std::vector<Light>& lights) {
  const oracle::Oracle truth(shot.geometry->surfaces);
  Agreement a;
  for (std::size_t l = 0; l < lights.size(); ++l) {
    const auto& mask = shot.shading.masks[l];
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const oracle::Pixel pixel = truth.look(camera, lights[l], x + 0.5, y + 0.5);
        if (!pixel.clear) continue;
        ++a.clear;
        a.lit += pixel.lit;
        const bool right = (mask.covered(x, y) != 0) == pixel.covered && (mask.light(x, y) == 255) == pixel.lit;
        if (right || oracle::onEdge(truth, camera, lights[l], x, y, pixel)) continue;
        ++a.wrong;
        ADD_FAILURE() << "light " << l << ", pixel " << x << ' ' << y << ": triangle " << pixel.triangle << ", traced "
                      << shot.shading.surface.triangle(x, y) << ", depth " << shot.shading.surface.depth(x, y)
                      << (pixel.lit ? ", lit" : ", dark") << (pixel.covered ? "" : ", uncovered");
      }
    }
  }
  return a;
}

Camera looking(const Vec3& eye, const Vec3& target, int width = 96, int height = 64) {
  Camera c;
  c.eye = eye, c.target = target, c.width = width, c.height = height;
  return c;
}

TEST(RayTraced, IsTheFirstTechniqueAndRunsEverywhere) {
  const auto entries = cpuTechniques();
  ASSERT_FALSE(entries.empty());
  EXPECT_EQ(entries.front().traits.name, "ray_traced");
  EXPECT_FALSE(entries.front().traits.needsGraphics);
}

TEST(RayTraced, SeesNothingInAnEmptyScene) {
  const Shot shot = shoot(shapes::scene({}), looking({0, -5, 2}, {0, 0, 0}), {point({1, 2, 3}), sun({0, 0, -1})});
  for (const auto& mask : shot.shading.masks) {
    for (const auto v : mask.covered.pixels()) EXPECT_EQ(v, 0);
    for (const auto v : mask.light.pixels()) EXPECT_EQ(v, 0);
  }
}

TEST(RayTraced, LightsAGroundWithoutCasters) {
  const auto s = scene::withGround(shapes::scene({}), 0.0);
  const Shot shot = shoot(s, looking({0, 0, 1}, {0, 0.001, 0}, 16, 16), {sun({0.1, 0, -1})});
  EXPECT_EQ(shot.shading.masks[0].light(8, 8), 255);
}

RC_GTEST_PROP(RayTraced, AgreesWithBruteForceOnLatticeSoups, ()) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(1, 1u << 30);
  shapes::Random random(seed);
  auto s = scene::withGround(shapes::scene({shapes::soup(seed, *rc::gen::inRange(1, 24),
                                                         [](shapes::Random& r) { return r.latticePoint(-3, 3); })}),
                             -3.0);
  const Vec3 eye = random.latticePoint(-5, 5), target = random.latticePoint(-2, 2);
  const Vec3 way = random.latticePoint(-3, 3);
  std::vector<Light> lights{point(random.latticePoint(-5, 5)), point(random.point({Vec3(-4), Vec3(4)})),
                            sun(way == Vec3(0.0) ? Vec3(0, 0, -1) : way),
                            spot(random.latticePoint(-4, 4), {1, 0, -2}, Angle::degrees(30))};
  const Camera camera = looking(eye, target == eye ? eye + Vec3(1, 0, 0) : target, 32, 24);
  const Agreement a = compareWithOracle(shoot(s, camera, lights), camera, lights);
  RC_ASSERT(a.wrong == 0u);
}

TEST(RayTraced, AgreesWithBruteForceOnCurvedSelfShadowingMeshes) {
  const auto s = scene::withGround(
      shapes::scene({shapes::knot({0, 0, 2}, 1.5, 0.3, 120, 16), shapes::sphere({3, 0, 1}, 0.8, 24, 16)}));
  const std::vector<Light> lights{point({2, -4, 6}), sun({-1, 0.5, -0.3}), point({0, 0, 2})};
  const Camera camera = looking({6, -7, 4}, {1, 0, 1});
  const Agreement a = compareWithOracle(shoot(s, camera, lights), camera, lights);
  EXPECT_GT(a.lit, 4000u);
  EXPECT_GT(a.clear - a.lit, 4000u);
  EXPECT_EQ(a.wrong, 0u);
}

TEST(RayTraced, IsAsRightFarFromTheOriginAndAtAnySize) {
  const auto meshes = [] {
    return std::vector{shapes::knot({0, 0, 2}, 1.5, 0.3, 80, 12), shapes::box({2, -1, 0}, {3, 1, 1.5})};
  };
  for (const double size : {1e-3, 1.0, 1e6}) {
    for (const Vec3& shift : {Vec3(0.0), Vec3(85000, 446000, 12)}) {
      const auto place = [&](const Vec3& p) { return size * (p + shift); };
      Mat4 toWorld(size);
      toWorld[3] = Vec4(size * shift, 1.0);
      const auto s = scene::withGround(shapes::scene(meshes(), toWorld));
      const std::vector<Light> lights{point(place({2, -4, 6})), sun({-1, 0.5, -0.3}), point(place({2.5, 0, 1.6}))};
      const Camera camera = looking(place({6, -7, 4}), place({1, 0, 1}), 72, 48);
      const Agreement a = compareWithOracle(shoot(s, camera, lights), camera, lights);
      EXPECT_GT(a.clear, 3000u);
      EXPECT_EQ(a.wrong, 0u) << "size " << size << ", shift " << shift.x;
    }
  }
}

TEST(RayTraced, KnowsOnWhichSideOfASurfaceALightVeryNearItIs) {
  for (const double height : {1e-3, 1e-6, 1e-8, 1e-10}) {
    const auto s = shapes::scene({shapes::quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}),
                                  shapes::box({-4, -4, -3}, {4, 4, -2}), shapes::box({1, 1, 0.5}, {1.5, 1.5, 1})});
    const std::vector<Light> lights{point({0.3, 0.3, height}), point({0.3, 0.3, -height})};
    const Camera above = looking({0, 0, 9}, {0.01, 0, 0}), beside = looking({6, 0, -1}, {0, 0, -2});
    for (const Camera& camera : {above, beside}) {
      const Agreement a = compareWithOracle(shoot(s, camera, lights), camera, lights);
      EXPECT_GT(a.clear, 6000u);
      EXPECT_EQ(a.wrong, 0u) << height;
    }
  }
}

TEST(RayTraced, DoesNotShadowCoplanarOrCoincidentSurfaces) {
  // Twice the same quad in both windings, a larger one in the same plane with other corners, and tilted copies of all.
  const auto layer = [](double k) { return shapes::quad({-k, -k, 0}, {k, -1.3 * k, 0}, {1.1 * k, k, 0}, {-k, k, 0}); };
  const Mat4 tilt = Mat4(Vec4(0.8, 0.6, 0, 0), Vec4(-0.36, 0.48, 0.8, 0), Vec4(0.48, -0.64, 0.6, 0), Vec4(17, 5, 3, 1));
  auto s = shapes::scene({layer(1), layer(1), layer(1.7), layer(0.37)}, tilt);
  const Vec3 centre = transformPoint(tilt, Vec3(0.0));
  for (const double elevation : {80.0, 10.0, 1.0, 0.1}) {
    const Angle e = Angle::degrees(elevation);
    const Light light = sun(-transformVector(tilt, Vec3(cos(e), 0, sin(e))));
    const Camera camera = looking(centre + transformVector(tilt, Vec3(1, 1, 6)), centre);
    const Shot shot = shoot(s, camera, {light});
    std::size_t covered = 0, dark = 0;
    for (std::size_t i = 0; i < shot.shading.masks[0].light.size(); ++i) {
      covered += shot.shading.masks[0].covered.pixels()[i];
      dark += shot.shading.masks[0].covered.pixels()[i] != 0 && shot.shading.masks[0].light.pixels()[i] == 0;
    }
    EXPECT_GT(covered, 1000u);
    EXPECT_EQ(dark, 0u) << elevation;
  }
}

TEST(RayTraced, IsRightInPicturesThatEndWithinAPacketOrATile) {
  const auto s = scene::withGround(shapes::scene({shapes::box({-1, -1, 0}, {1, 1, 1.5})}));
  const std::vector<Light> lights{point({2, -3, 4}), sun({-1, 0.5, -0.6}),
                                  spot({2, -3, 4}, {-2, 3, -4}, Angle::degrees(20))};
  std::size_t clear = 0, lit = 0;
  for (const auto& [width, height] : {std::pair(1, 1), {3, 1}, {5, 3}, {31, 15}, {33, 17}, {70, 35}}) {
    const Camera camera = looking({4, -5, 3}, {0, 0, 0.5}, width, height);
    const Agreement a = compareWithOracle(shoot(s, camera, lights), camera, lights);
    EXPECT_EQ(a.wrong, 0u) << width << " x " << height;
    clear += a.clear, lit += a.lit;
  }
  EXPECT_GT(lit, 1000u);
  EXPECT_GT(clear - lit, 1000u);
}

// Straight light rakes along every wall, and an eye in a wall's plane sees it edge-on: sides that no plane's height tells.
TEST(RayTraced, IsRightWhereLightAndEyeLieInPlanesOfFaces) {
  const auto s =
      scene::withGround(shapes::scene({shapes::box({-1, -1, 0}, {1, 1, 1.5}), shapes::box({2, -1, 0}, {3, 1, 1})}));
  const std::vector<Light> lights{sun({0, 0, -1}), sun({1, 0, 0}), point({1, -4, 3}), point({4, 4, 1.5}),
                                  point({1, -1, 1.5})};
  for (const Vec3& eye : {Vec3(5, -6, 4), Vec3(1, -6, 3), Vec3(6, -1, 1.5)}) {
    const Camera camera = looking(eye, {0.3, 0.1, 0.5});
    const Agreement a = compareWithOracle(shoot(s, camera, lights), camera, lights);
    EXPECT_GT(a.clear, 5000u);
    EXPECT_EQ(a.wrong, 0u);
  }
}

TEST(RayTraced, IsTheSameInAnyNumberOfThreads) {
  const auto s =
      scene::withGround(shapes::scene({shapes::knot({0, 0, 2}, 1.5, 0.3, 120, 16),
                                       shapes::soup(3, 200, [](shapes::Random& r) { return r.latticePoint(-2, 2); })}));
  const Camera camera = looking({6, -7, 4}, {0, 0, 1}, 320, 200);
  const std::vector<Light> lights{point({2, -4, 6})};
  const Shot many = shoot(s, camera, lights);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Shot alone = shoot(s, camera, lights);
  EXPECT_EQ(many.shading.surface.triangle, alone.shading.surface.triangle);
  EXPECT_EQ(many.shading.surface.depth, alone.shading.surface.depth);
  EXPECT_EQ(many.shading.masks[0].light, alone.shading.masks[0].light);
}

}  // namespace
}  // namespace umbrage::techniques
