#include "umbrage/shadow/planes.hpp"

#include <gtest/gtest.h>

#include "support/shapes.hpp"

namespace umbrage::shadow {
namespace {

using shapes::box;
using shapes::quad;

scene::Surfaces boxOnGround(const Vec3& shift = Vec3(0.0)) {
  Mat4 m(1.0);
  m[3] = Vec4(shift, 1.0);
  return scene::flatten(
      shapes::scene({box({0, 0, 0}, {1, 2, 3}), quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})}, m));
}

TEST(Planes, OfABoxOnAGroundAreSixTheGroundFirst) {
  for (const Vec3& shift : {Vec3(0.0), Vec3(85000.25, 446000.5, 12.0)}) {
    const auto surfaces = boxOnGround(shift);
    const auto found = findPlanes(surfaces, {.leastShare = 0.0});
    ASSERT_EQ(found.planes.size(), 6u);
    EXPECT_NEAR(found.planes[0].area, 18.0 * 18.0 + 2.0, 1e-6);  // the box's bottom lies in the ground
    EXPECT_NEAR(std::abs(found.planes[0].equation.z), 1.0, 1e-12);
    for (const std::uint8_t p : found.planeOf) EXPECT_NE(p, 0);
    std::size_t ground = 0;
    for (const std::uint8_t p : found.planeOf) ground += p == 1;
    EXPECT_EQ(ground, 4u);
  }
}

TEST(Planes, AreTheLargestAndLargeEnough) {
  const auto surfaces = boxOnGround();
  EXPECT_EQ(findPlanes(surfaces, {.most = 3, .leastShare = 0.0}).planes.size(), 3u);
  // The square of the diagonal of all is 657, the ground has an area of 324.
  const auto large = findPlanes(surfaces, {.leastShare = 0.4});
  ASSERT_EQ(large.planes.size(), 1u);
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    EXPECT_EQ(large.planeOf[t] != 0, surfaces.normal(t).z != 0.0 && surfaces.corner(t, 0).z == 0.0);
}

TEST(Planes, GivenOnesHoldWhatLiesInThem) {
  const auto surfaces = boxOnGround();
  const auto found = findPlanes(surfaces, {.given = {{{0, 0, 3}, {0, 0, -2}}, {{7, 0, 0}, {1, 0, 0}}}});
  ASSERT_EQ(found.planes.size(), 2u);
  EXPECT_NEAR(found.planes[0].area, 2.0, 1e-12);
  EXPECT_EQ(found.planes[1].area, 0.0);
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    EXPECT_EQ(found.planeOf[t] != 0,
              surfaces.corner(t, 0).z == 3.0 && surfaces.corner(t, 1).z == 3.0 && surfaces.corner(t, 2).z == 3.0);
}

// Parts of one wall that were rotated and rounded by themselves; steps a hand's breadth apart stay apart.
TEST(Planes, SurviveRoundingAndKeepStepsApart) {
  std::vector<mesh::Mesh> parts;
  const double c = std::cos(0.7853981), s = std::sin(0.7853981);
  for (int i = 0; i < 12; ++i) {
    const double a = 1.7 * i, b = a + 1.3;
    parts.push_back(quad({c * a, s * a, 0.1}, {c * b, s * b, 0.1}, {c * b, s * b, 2.3}, {c * a, s * a, 2.3}));
  }
  for (int i = 0; i < 5; ++i) parts.push_back(quad({0, 0, 0.1 * i}, {3, 0, 0.1 * i}, {3, 3, 0.1 * i}, {0, 3, 0.1 * i}));
  const auto found = findPlanes(scene::flatten(shapes::scene(std::move(parts))), {.leastShare = 0.0});
  ASSERT_EQ(found.planes.size(), 6u);
  EXPECT_NEAR(found.planes[0].area, 12 * 1.3 * 2.2, 1e-5);
}

TEST(Planes, OfNothingAreNone) {
  EXPECT_TRUE(findPlanes(scene::Surfaces{}).planes.empty());
  const auto sphere = scene::flatten(shapes::scene({shapes::sphere({0, 0, 0}, 1, 64, 32)}));
  EXPECT_TRUE(findPlanes(sphere).planes.empty());
}

}  // namespace
}  // namespace umbrage::shadow
