#include "umbrage/study/detail/hours_balls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "hours/scenes.hpp"
#include "umbrage/math/predicates.hpp"

namespace umbrage::study::detail {
namespace {

using hours_tests::sceneOf;

scene::Surfaces flat(mesh::Mesh m) { return scene::flatten(sceneOf(std::move(m))); }

std::vector<Ball> ballsIn(const scene::Surfaces& s) {
  std::vector<std::uint32_t> all(s.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return findBalls(s, makeCasters(s, all));
}

double distanceTo(const scene::Surfaces& s, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
    least = std::min(least, distanceToTriangle(p, s.corner(t, 0), s.corner(t, 1), s.corner(t, 2)));
  return least;
}

// How often the surface is wound around a point: the solid angle under which it is seen, over the sphere's.
// Source: van Oosterom and Strackee, the solid angle of a plane triangle, 1983. Corners are sorted, so the windings are the mesh's.
double winding(const mesh::Mesh& m, const Vec3& p) {
  double sum = 0.0;
  for (const mesh::Triangle& t : m.triangles) {
    const Vec3 a = glm::normalize(m.positions[t[0]] - p), b = glm::normalize(m.positions[t[1]] - p),
               c = glm::normalize(m.positions[t[2]] - p);
    sum += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
  }
  return sum / (4.0 * std::numbers::pi);
}

void expectWithin(const mesh::Mesh& m) {
  const scene::Surfaces s = flat(m);
  const std::vector<Ball> balls = ballsIn(s);
  EXPECT_FALSE(balls.empty());
  for (const Ball& ball : balls) {
    EXPECT_GE(distanceTo(s, ball.centre), ball.radius * (1.0 - 1e-12));
    EXPECT_GT(std::abs(winding(m, ball.centre + s.origin)), 0.5);
  }
}

TEST(HoursBalls, fillATube) {
  const mesh::Mesh tube = hours_tests::ring(20, 4, 0, 150, 40);
  expectWithin(tube);
  const scene::Surfaces s = flat(tube);
  const std::vector<Ball> balls = ballsIn(s);
  ASSERT_GT(balls.size(), 40u);
  ASSERT_LT(balls.size(), 400u);
  for (const Ball& ball : balls) EXPECT_GT(ball.radius, 3.7);
  // All around the ring, no part of its middle is outside of every ball.
  for (int i = 0; i < 100; ++i) {
    const double a = 2 * std::numbers::pi * i / 100;
    const Vec3 middle = 20.0 * (std::cos(a) * Vec3(1, 0, 0) + std::sin(a) * Vec3(0, 0.6, 0.8)) - s.origin;
    EXPECT_TRUE(std::any_of(balls.begin(), balls.end(), [&](const Ball& b) {
      return glm::distance(b.centre, middle) < 0.7 * b.radius;
    })) << i;
  }
}

TEST(HoursBalls, stayWithinASurfaceThatIsTurnedInsideOut) {
  mesh::Mesh m = hours_tests::ring(20, 4, 0, 150, 40);
  for (mesh::Triangle& t : m.triangles) std::swap(t[1], t[2]);
  expectWithin(m);
}

TEST(HoursBalls, stayWithinASurfaceThatCutsItself) {
  // The tube is wider than the ring it is bent to, so that its inner side lies on the other side.
  expectWithin(hours_tests::ring(4, 7, 0, 60, 30));
}

TEST(HoursBalls, areNotMadeWhereTheyDoNotPay) {
  mesh::Mesh open = hours_tests::ring(20, 4, 0, 60, 20);
  open.triangles.pop_back();
  EXPECT_TRUE(ballsIn(flat(std::move(open))).empty());
  hours_tests::Random random(1);
  EXPECT_TRUE(ballsIn(flat(hours_tests::boxes(3, 20, random))).empty());
  EXPECT_TRUE(findBalls({}, {}).empty());
}

}  // namespace
}  // namespace umbrage::study::detail
