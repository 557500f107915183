#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.hpp"
#include "umbrage/optics/interface.hpp"
#include "umbrage/optics/tracer.hpp"
#include "umbrage/shadow/smooth_normals.hpp"

namespace umbrage::optics {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3 at(double degrees) { return {std::sin(degrees * kPi / 180), 0, -std::cos(degrees * kPi / 180)}; }

TEST(Interface, FollowsSnellAndFresnel) {
  const Vec3 up(0, 0, 1);
  for (const double angle : {0.0, 10.0, 45.0, 80.0, 89.9}) {
    const auto in = refracted(at(angle), up, 1.0, 1.5);
    ASSERT_TRUE(in);
    EXPECT_NEAR(in->x, std::sin(angle * kPi / 180) / 1.5, 1e-14);
    // The way back is the same way.
    const auto out = refracted(*in, up, 1.5, 1.0);
    ASSERT_TRUE(out);
    EXPECT_LT(glm::length(*out - at(angle)), 1e-12);
    EXPECT_NEAR(reflectance(at(angle), up, 1.0, 1.5), reflectance(*in, up, 1.5, 1.0), 1e-12);
  }
  EXPECT_NEAR(reflectance(at(0), up, 1.0, 1.5), 0.04, 1e-14);
  EXPECT_NEAR(reflectance(at(90), up, 1.0, 1.5), 1.0, 1e-12);
  // Brewster's angle: half of the light that is polarised across, and nothing of the other.
  const double brewster = std::atan(1.5) * 180 / kPi;
  EXPECT_NEAR(reflectance(at(brewster), up, 1.0, 1.5), 0.5 * std::pow((1.5 * 1.5 - 1) / (1.5 * 1.5 + 1), 2), 1e-12);
  const double critical = std::asin(1 / 1.5) * 180 / kPi;
  EXPECT_TRUE(refracted(at(critical - 1e-6), up, 1.5, 1.0));
  EXPECT_FALSE(refracted(at(critical + 1e-6), up, 1.5, 1.0));
  EXPECT_EQ(reflectance(at(critical + 1e-6), up, 1.5, 1.0), 1.0);
}

/// Everything shows its own colour: ambient light alone, alike from everywhere.
scene::Scene stage(std::vector<mesh::Mesh> meshes) { return shapes::scene(std::move(meshes)); }

void paintMesh(scene::Scene& s, std::size_t mesh, scene::Material material) {
  s.materials.push_back(std::move(material));
  auto painted = std::make_shared<mesh::Mesh>(*s.meshes[mesh]);
  painted->materials.assign(painted->triangles.size(), static_cast<std::uint32_t>(s.materials.size()) - 1);
  s.meshes[mesh] = painted;
}

scene::Material glass(double ior, Vec3 filter = Vec3(1.0)) {
  return {.name = "glass", .colour = Vec3(0.0), .opacity = 0.0, .filter = filter, .ior = ior};
}

scene::Material lamp(const Vec3& emission) { return {.name = "lamp", .colour = Vec3(0.0), .emission = emission}; }

Tracer tracer(const scene::Scene& scene, const Options& options) {
  return std::move(*Tracer::build(scene, shadow::makeGeometry(scene), {}, options));
}

Options depths(int reflections, int refractions) {
  Options options{.reflections = reflections, .refractions = refractions};
  options.look.background = Vec3(0.0);
  return options;
}

scene::Scene yard() {
  auto s = stage({shapes::box({1, -1, 0}, {2, 1, 2}), shapes::sphere({3.5, 2, 1}, 1, 24, 12),
                  shapes::quad({0.25, -6, 0}, {9, -6, 0}, {9, 6, 0}, {0.25, 6, 0})});
  s.materials[0].colour = Vec3(0.8, 0.5, 0.2);
  return s;
}

// What a mirror shows is what an eye behind it sees.
TEST(Tracer, AMirrorShowsTheMirroredCamerasPicture) {
  auto before = yard();
  before.materials.push_back({.name = "mirror", .colour = Vec3(1.0), .mirror = 1.0});
  auto wall = std::make_shared<mesh::Mesh>(shapes::quad({0, -50, -50}, {0, 50, -50}, {0, 50, 50}, {0, -50, 50}));
  wall->materials = {1, 1};
  before.meshes.push_back(wall);
  before.instances.push_back({"mirror", 3, Mat4(1.0), true});
  const scene::Scene behind = yard();
  scene::Camera camera;
  camera.eye = {6, -5, 4}, camera.target = {-2, 1, 0.5}, camera.up = {0, 0, 1};
  camera.width = 240, camera.height = 160;
  scene::Camera mirrored = camera;
  mirrored.eye.x = -camera.eye.x, mirrored.target.x = -camera.target.x;
  const std::vector<scene::Light> lights{{scene::PointLight{{5, -3, 6}}}};
  const auto seen = paint(before, shadow::makeGeometry(before), camera, lights, {.reflections = 1});
  const auto truth = paint(behind, shadow::makeGeometry(behind), mirrored, lights, {});
  ASSERT_TRUE(seen && truth);
  // Without the mirror the scene itself stands before the picture in the mirror.
  const auto own = paint(yard(), shadow::makeGeometry(behind), camera, lights, {});
  const image::Rgb8 none = own->pixels()[0];
  std::size_t compared = 0, different = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      if ((*own)(x, y) != none) continue;
      ++compared;
      const image::Rgb8 a = (*seen)(x, y), b = (*truth)(camera.width - 1 - x, y);
      different += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 1;
    }
  }
  std::printf("%zu of %zu pixels in the mirror differ\n", different, compared);
  EXPECT_GT(compared, 10000u);
  EXPECT_EQ(different, 0u);
}

TEST(Tracer, WithoutDepthAMirrorHasItsOwnLook) {
  auto scene = yard();
  paintMesh(scene, 1, {.name = "mirror", .colour = Vec3(0.9, 0.8, 0.7), .mirror = 0.7});
  scene::Camera camera;
  camera.eye = {6, -5, 4}, camera.target = {2, 0, 0.5}, camera.up = {0, 0, 1};
  camera.width = 120, camera.height = 80;
  const std::vector<scene::Light> lights{{scene::PointLight{{5, -3, 6}}}};
  const auto geometry = shadow::makeGeometry(scene);
  const auto plain = paint(scene, geometry, camera, lights, {});
  const auto mirrors = paint(scene, geometry, camera, lights, {.reflections = 2});
  auto mat = scene;
  mat.materials.back().mirror = 0.0;
  const auto truth = paint(mat, geometry, camera, lights, {.reflections = 2});
  ASSERT_TRUE(plain && mirrors && truth);
  EXPECT_EQ(*plain, *truth);
  EXPECT_NE(*plain, *mirrors);
}

/// A slab of glass, `thick` below z = 0, and far below it a lamp for x < 0, dark beyond.
scene::Scene slabOver(double thick, double ior, double far) {
  auto s = stage({shapes::box({-50, -50, -thick}, {50, 50, 0}),
                  shapes::quad({-90, -90, -far}, {0, -90, -far}, {0, 90, -far}, {-90, 90, -far})});
  paintMesh(s, 0, glass(ior));
  paintMesh(s, 1, lamp(Vec3(1.0)));
  return s;
}

// The lamp's border is seen beside where it is by t sin(a) (1 - cos(a) / (n cos(b))) / cos(a) along the surface.
TEST(Tracer, ASlabShiftsWhatIsSeenThroughIt) {
  constexpr double kThick = 2.0, kIndex = 1.5, kFar = 5.0;
  const auto scene = slabOver(kThick, kIndex, kFar);
  const Tracer t = tracer(scene, depths(0, 4));
  for (const double angle : {5.0, 20.0, 40.0, 60.0, 75.0}) {
    const double a = angle * kPi / 180, b = std::asin(std::sin(a) / kIndex);
    const double shift = kThick * (std::tan(a) - std::tan(b));
    // Where a ray from a start at x, 3 above the slab, meets the lamp's plane, at 0 exactly.
    const double x = -(3.0 + kFar) * std::tan(a) + shift;
    EXPECT_GT(t.colour({x - 1e-4, 0, 3}, at(angle)).x, 0.9) << angle;
    EXPECT_LT(t.colour({x + 1e-4, 0, 3}, at(angle)).x, 0.1) << angle;
  }
}

// What is reflected and what passes is all there is: in a room that shines alike everywhere glass cannot be seen.
TEST(Tracer, NoLightIsLostOrMadeAtAnInterface) {
  const auto block = shapes::box({-1, -1, -1}, {1, 1, 1});
  auto scene = stage({block, shapes::box({-5, -5, -5}, {5, 5, 5})});
  paintMesh(scene, 0, glass(1.5));
  paintMesh(scene, 1, lamp(Vec3(0.5)));
  const Tracer t = tracer(scene, depths(8, 12));
  shapes::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = random.point({{-4, -4, 2}, {4, 4, 4}}), at = random.point({{-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9}});
    const double seen = t.colour(from, at - from).x;
    EXPECT_NEAR(seen, 0.5, 0.002);
    EXPECT_LE(seen, 0.5 + 1e-12);
  }
}

// From within glass the world above is a disc; beyond the critical angle there is nothing but what is inside.
TEST(Tracer, BeyondTheCriticalAngleAllIsThrownBack) {
  auto scene = stage({shapes::box({-40, -40, -2}, {40, 40, 0}),
                      shapes::quad({-900, -900, 3}, {900, -900, 3}, {900, 900, 3}, {-900, 900, 3}),
                      shapes::quad({-39, -39, -1.9}, {39, -39, -1.9}, {39, 39, -1.9}, {-39, 39, -1.9})});
  paintMesh(scene, 0, glass(1.5));
  paintMesh(scene, 1, lamp(Vec3(1.0, 0, 0)));
  paintMesh(scene, 2, lamp(Vec3(0, 1.0, 0)));
  const Tracer t = tracer(scene, depths(2, 3));
  const double critical = std::asin(1 / 1.5) * 180 / kPi;
  const auto upwards = [&](double angle) { return t.colour({0, 0, -1}, -at(-angle) * Vec3(1, 1, 1)); };
  for (const double angle : {0.0, 20.0, critical - 0.01}) {
    const Vec3 c = upwards(angle);
    const double back = reflectance(at(angle), {0, 0, 1}, 1.5, 1.0);
    EXPECT_NEAR(c.x, 1.0 - back, 1e-3) << angle;
    EXPECT_NEAR(c.y, back, 1e-3) << angle;
  }
  for (const double angle : {critical + 0.01, 50.0, 70.0})
    EXPECT_LT(glm::length(upwards(angle) - Vec3(0, 1, 0)), 1e-9) << angle;
}

// Rays near the axis of a ball of glass meet at n R / 2 (n - 1) from its middle.
TEST(Tracer, ABallIsALensOfItsFocalLength) {
  constexpr double kIndex = 1.5, kRadius = 1.0, kFocal = kIndex * kRadius / (2.0 * (kIndex - 1.0));
  const auto brightOn = [&](double distance) {
    auto scene = stage({shapes::sphere({0, 0, 0}, kRadius, 256, 128), shapes::sphere({0, 0, -distance}, 0.004, 16, 8)});
    paintMesh(scene, 0, glass(kIndex));
    paintMesh(scene, 1, lamp(Vec3(1.0)));
    const auto geometry = shadow::makeGeometry(scene);
    const auto smooth = shadow::smoothNormals(geometry->surfaces, Angle::degrees(30));
    Options options = depths(0, 4);
    options.look.smooth = &smooth;
    const auto t = Tracer::build(scene, geometry, {}, options);
    int met = 0;
    for (int i = 0; i < 64; ++i) {
      const double angle = 2 * kPi * (i + 0.3) / 64;
      met += t->colour({0.1 * std::cos(angle), 0.1 * std::sin(angle), 5}, {0, 0, -1}).x > 0.5;
    }
    return met;
  };
  EXPECT_GT(brightOn(kFocal), 60);
  EXPECT_EQ(brightOn(kFocal - 0.15), 0);
  EXPECT_EQ(brightOn(kFocal + 0.15), 0);
}

TEST(Tracer, EverySurfaceTakesItsFilter) {
  auto scene = slabOver(2.0, 1.5, 5.0);
  scene.materials[1].filter = Vec3(0.5, 0.8, 1.0);
  const Tracer bent = tracer(scene, depths(0, 4)), straight = tracer(scene, depths(0, 0));
  for (const Tracer* t : {&bent, &straight})
    EXPECT_LT(glm::length(t->colour({-20, 0, 3}, {0, 0, -1}) - Vec3(0.25, 0.64, 1.0)), 1e-12);
}

TEST(Tracer, TwoMirrorsEndWhereTheDepthEnds) {
  auto scene = stage({shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}),
                      shapes::quad({-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1})});
  scene.materials[0].colour = Vec3(0.5);
  scene.materials[0].mirror = 1.0;
  for (const int depth : {0, 1, 2, 5}) {
    Options options = depths(depth, 0);
    options.look.ambient = 1.0;
    const double c = tracer(scene, options).colour({0, 0, 0.5}, {0, 0, -1}).x;
    // Sky light from above is 1, from below a half.
    const double last = 0.5 * (depth % 2 == 0 ? 1.0 : 0.5);
    EXPECT_NEAR(c, last * std::pow(0.5, depth), 1e-12) << depth;
  }
}

}  // namespace
}  // namespace umbrage::optics
