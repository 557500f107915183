#include "umbrage/render/large_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/shapes.hpp"

namespace umbrage::render {
namespace {

const Vec3 kEye(0.3, -0.2, 0.1);

// Along +y, with 90 degrees of view.
Arrangement arrangementOf(const shadow::Geometry& geometry) {
  scene::Camera camera;
  camera.eye = kEye, camera.target = kEye + Vec3(0, 1, 0), camera.fovY = Angle::degrees(90);
  camera.width = camera.height = 100;
  return arrange(geometry, viewOf(camera, 1.0), camera.width, camera.height);
}

// One triangle. Its corners lie where `surfaces` would put them.
shadow::Geometry one(const Vec3& a, const Vec3& b, const Vec3& c) {
  shadow::Geometry g;
  g.surfaces.positions = {Vec3f(a), Vec3f(b), Vec3f(c)};
  g.surfaces.triangles = {{0, 1, 2}};
  return g;
}

TEST(Arrange, KeepsApartOnlyWhatReachesFartherThanItsDistance) {
  const Vec3 front(0, 10, 0);
  EXPECT_TRUE(arrangementOf(one(front, front + Vec3(7, 1, 0), front + Vec3(0, 1, 7))).large.empty());
  EXPECT_EQ(arrangementOf(one(front, front + Vec3(11, 0, 0), front + Vec3(0, 0, 1))).large.size(), 1u);
  EXPECT_EQ(arrangementOf(one({-1, -1, -1}, {1, -1, -1}, {0, 2, -1})).large.size(), 1u) << "beside the eye";
  EXPECT_TRUE(arrangementOf(one({-50, -9, -1}, {50, -9, -1}, {0, -3, 9})).large.empty()) << "behind it";
}

TEST(Arrange, LeavesOutWhatTheEyeSeesEdgeOn) {
  const Arrangement a = arrangementOf(one({-1, 1, 0.1}, {1, 1, 0.1}, {0, 900, 0.1}));
  EXPECT_TRUE(a.ordinary.empty());
  EXPECT_TRUE(a.large.empty());
}

TEST(Arrange, LeavesOutWhatIsOutsideThePicture) {
  const auto drawn = [](const Vec3& at) {
    const Arrangement a = arrangementOf(one(kEye + at, kEye + at + Vec3(1, 0, 0), kEye + at + Vec3(0, 0, 1)));
    return a.ordinary.size() + a.large.size();
  };
  EXPECT_EQ(drawn({0, 10, 0}), 1u);
  EXPECT_EQ(drawn({9.5, 10, 0}), 1u) << "across the border";
  EXPECT_EQ(drawn({12, 10, 0}), 0u);
  EXPECT_EQ(drawn({-12, 10, 0}), 0u);
  EXPECT_EQ(drawn({0, 10, 12}), 0u);
  EXPECT_EQ(drawn({0, 10, -12}), 0u);
  EXPECT_EQ(drawn({0, -10, 0}), 0u);
}

TEST(Arrange, LeavesOutAvertedFacesOfConvexSolidsSeenFromOutside) {
  const auto drawn = [](const mesh::Mesh& m) {
    const Arrangement a = arrangementOf(*shadow::makeGeometry(shapes::scene({m})));
    return a.ordinary.size() + a.large.size();
  };
  EXPECT_EQ(drawn(shapes::box({-1, 5, -1}, {1, 7, 1})), 2u) << "the front";
  EXPECT_EQ(drawn(shapes::box({1, 5, 1}, {3, 7, 3})), 6u) << "a corner";
  EXPECT_EQ(drawn(shapes::box({-9, -9, -9}, {9, 9, 9})), 10u) << "from inside, all but what is behind";
  mesh::Mesh open = shapes::box({1, 5, 1}, {3, 7, 3});
  open.triangles.pop_back();
  EXPECT_EQ(drawn(open), 11u) << "through the hole the others may be seen";
}

// In single precision, as the shader works it out.
TEST(Arrange, GivesDepthRightToAFewUnitsInTheLastPlace) {
  const Vec3 a(-4000, 40, -1.7), b(5000, -30, -1.9), c(100, 6000, -1.8);
  const Arrangement arrangement = arrangementOf(one(a, b, c));
  ASSERT_EQ(arrangement.large.size(), 1u);
  const Vec4f plane = arrangement.large[0].plane;
  const Vec3 p = Vec3(Vec3f(a)) - kEye,
             n = glm::cross(Vec3(Vec3f(b)) - Vec3(Vec3f(a)), Vec3(Vec3f(c)) - Vec3(Vec3f(a)));
  for (double x = -0.7; x < 0.7; x += 0.13) {
    for (double z = -0.9; z < -0.01; z += 0.07) {
      const Vec3 ray(x, 1.0, z);
      const double depth = glm::dot(n, p) / glm::dot(n, ray);
      const float inverse = glm::dot(Vec3f(plane), Vec3f(ray));
      // The nearer the ray to the plane, the more its own rounding counts.
      EXPECT_NEAR(1.0 / double(inverse), depth, 0x1p-22 * depth / std::abs(z)) << x << ' ' << z;
      EXPECT_LE(inverse, plane.w);
    }
  }
}

TEST(Arrange, TakesInterpolatedDepthWhereTheEyeIsAlmostInThePlane) {
  const double just = 0.1 - 1e-3;
  const Arrangement arrangement = arrangementOf(one({-100, 90, just}, {100, 90, just}, {0, 900, just}));
  ASSERT_EQ(arrangement.large.size(), 1u);
  EXPECT_LT(arrangement.large[0].plane.w, 0.0f);
}

}  // namespace
}  // namespace umbrage::render
