#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "umbrage/math/box.hpp"
#include "umbrage/math/predicates.hpp"

namespace umbrage {
namespace {

Vec3 latticePoint() {
  const auto coordinate = rc::gen::inRange(-4, 5);
  return {double(*coordinate), double(*coordinate), double(*coordinate)};
}

TEST(Box, IsEmptyUntilAPointIsAdded) {
  Box3 box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.radius(), 0.0);
  box.add(Vec3(1, 2, 3));
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.centre(), Vec3(1, 2, 3));
}

TEST(LightSide, KnowsBothSidesAndTheEdgeOnCase) {
  const Vec3 a(0, 0, 0), b(0, 1, 0), c(1, 0, 0);
  const int above = lightSide(a, b, c, {0, 0, 5, 1});
  EXPECT_NE(above, 0);
  EXPECT_EQ(lightSide(a, b, c, {0, 0, -5, 1}), -above);
  EXPECT_EQ(lightSide(a, b, c, {0, 0, 1, 0}), above);
  EXPECT_EQ(lightSide(a, b, c, {7, 8, 0, 1}), 0);
  EXPECT_EQ(lightSide(a, a, c, {0, 0, 5, 1}), 0);
}

// A light in a corner lies in the plane, whatever the corner's coordinates are.
TEST(LightSide, IsZeroForALightInACorner) {
  for (int i = 0; i < 1000; ++i) {
    const auto at = [i](int k) {
      return Vec3(Vec3f(std::sin(i + 7.1 * k), std::cos(3.3 * i - k), std::sin(1.7 * i * k + 2)));
    };
    std::array<Vec3, 3> corner{at(1), at(2), at(3)};
    std::sort(corner.begin(), corner.end(), lexicographicallyLess<Vec3>);
    for (const Vec3& p : corner) EXPECT_EQ(lightSide(corner[0], corner[1], corner[2], Vec4(p, 1.0)), 0) << i;
    const Vec3 lifted = corner[1] + 1e-9 * glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    EXPECT_NE(lightSide(corner[0], corner[1], corner[2], Vec4(lifted, 1.0)), 0) << i;
  }
}

TEST(DistanceToTriangle, ToFaceEdgeAndCorner) {
  const Vec3 a(0, 0, 0), b(0, 2, 0), c(2, 0, 0);
  EXPECT_DOUBLE_EQ(distanceToTriangle({0.5, 0.5, -3}, a, b, c), 3.0);
  EXPECT_DOUBLE_EQ(distanceToTriangle({1, -4, 3}, a, b, c), 5.0);
  EXPECT_DOUBLE_EQ(distanceToTriangle({5, -4, 0}, a, b, c), 5.0);
  EXPECT_DOUBLE_EQ(distanceToTriangle({2, 2, 0}, a, b, c), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(distanceToTriangle({0, 3, 4}, a, a, a), 5.0);
}

RC_GTEST_PROP(NearestOnTriangle, IsAtTheDistanceOfTheTriangleAndOnIt, ()) {
  const Vec3 a = latticePoint(), b = latticePoint(), c = latticePoint(), p = latticePoint();
  const Vec3 near = nearestOnTriangle(p, a, b, c);
  RC_ASSERT(std::abs(glm::distance(near, p) - distanceToTriangle(p, a, b, c)) < 1e-12);
  RC_ASSERT(distanceToTriangle(near, a, b, c) < 1e-12);
}

// What a float leaves of a double. GCC 12 makes 0 of it unless it is told not to (cmake/UmbrageModule.cmake).
[[gnu::noinline]] Vec3f remainder(const Vec3& v) { return Vec3f(v - Vec3(Vec3f(v))); }
TEST(Rounding, IsNotDroppedByTheCompiler) {
  volatile double x = 984.4169169664383, y = -926.7190098762512, z = 0.01;
  const Vec3f left = remainder({x, y, z});
  EXPECT_FLOAT_EQ(left.x, -1.41859055e-05f);
  EXPECT_FLOAT_EQ(left.y, -1.57356262e-05f);
  EXPECT_FLOAT_EQ(left.z, 2.2351742e-10f);
}

// On small integers doubles are exact, so the sign must be the exact determinant's.
RC_GTEST_PROP(LightSide, EqualsTheExactDeterminantOnALattice, ()) {
  std::array<Vec3, 3> corner{latticePoint(), latticePoint(), latticePoint()};
  std::sort(corner.begin(), corner.end(), lexicographicallyLess<Vec3>);
  const Vec4 light(latticePoint(), *rc::gen::inRange(0, 2));
  const auto as = [](double v) { return static_cast<long>(v); };
  const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], l = Vec3(light) - corner[0] * light.w;
  const long exact = as(u.x) * (as(v.y) * as(l.z) - as(v.z) * as(l.y)) -
                     as(u.y) * (as(v.x) * as(l.z) - as(v.z) * as(l.x)) +
                     as(u.z) * (as(v.x) * as(l.y) - as(v.y) * as(l.x));
  RC_ASSERT(lightSide(corner[0], corner[1], corner[2], light) == (exact > 0) - (exact < 0));
}

TEST(LiesInPlane, IsMeasuredByTheTrianglesReach) {
  const Vec3 a(-100, -100, 0), b(0, 100, 0), c(100, -100, 0);
  EXPECT_TRUE(liesInPlane(a, b, c, {1, 2, 0}));
  EXPECT_TRUE(liesInPlane(a, b, c, {1, 2, 1e-6}));
  EXPECT_FALSE(liesInPlane(a, b, c, {1, 2, 1e-5}));
  EXPECT_TRUE(liesInPlane(a, b, c, a));
  EXPECT_TRUE(liesInPlane(a, a, c, {5, 5, 5}));  // no plane at all
}

}  // namespace
}  // namespace umbrage
