#include "umbrage/render/large_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrage::render {
namespace {

const Vec3 kEye(0.3, -0.2, 0.1), kForward(0, 1, 0);

// One triangle. Its corners lie where `surfaces` would put them.
scene::Surfaces one(const Vec3& a, const Vec3& b, const Vec3& c) {
  scene::Surfaces s;
  s.positions = {Vec3f(a), Vec3f(b), Vec3f(c)};
  s.triangles = {{0, 1, 2}};
  return s;
}

TEST(Arrange, KeepsApartOnlyWhatReachesFartherThanItsDistance) {
  const Vec3 front(0, 10, 0);
  EXPECT_TRUE(arrange(one(front, front + Vec3(7, 1, 0), front + Vec3(0, 1, 7)), kEye, kForward).large.empty());
  EXPECT_EQ(arrange(one(front, front + Vec3(11, 0, 0), front + Vec3(0, 0, 1)), kEye, kForward).large.size(), 1u);
  EXPECT_EQ(arrange(one({-1, -1, -1}, {1, -1, -1}, {0, 2, -1}), kEye, kForward).large.size(), 1u) << "beside the eye";
  EXPECT_TRUE(arrange(one({-50, -9, -1}, {50, -9, -1}, {0, -3, 9}), kEye, kForward).large.empty()) << "behind it";
}

TEST(Arrange, LeavesOutWhatTheEyeSeesEdgeOn) {
  const Arrangement a = arrange(one({-1, 1, 0.1}, {1, 1, 0.1}, {0, 900, 0.1}), kEye, kForward);
  EXPECT_EQ(a.edgeOn, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(a.large.empty());
}

// In single precision, as the shader works it out.
TEST(Arrange, GivesDepthRightToAFewUnitsInTheLastPlace) {
  const Vec3 a(-4000, 40, -1.7), b(5000, -30, -1.9), c(100, 6000, -1.8);
  const Arrangement arrangement = arrange(one(a, b, c), kEye, kForward);
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
  const Arrangement arrangement = arrange(one({-100, 90, just}, {100, 90, just}, {0, 900, just}), kEye, kForward);
  ASSERT_EQ(arrangement.large.size(), 1u);
  EXPECT_LT(arrangement.large[0].plane.w, 0.0f);
}

}  // namespace
}  // namespace umbrage::render
