#include "umbrage/radiosity/form_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.hpp"
#include "umbrage/radiosity/visible_factor.hpp"

namespace umbrage::radiosity {
namespace {

using Quad = std::array<Vec3, 4>;
constexpr double kPi = std::numbers::pi;

/// The mean over a rectangle, by the middles of n x n cells.
template <class Fn>
double meanOver(const Quad& q, int n, const Fn& at) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += at(q[0] + (i + 0.5) / n * (q[1] - q[0]) + (j + 0.5) / n * (q[3] - q[0]));
  return sum / (n * n);
}

// Two equal rectangles a x b that face each other at a distance of 1. Source: J. R. Howell, A Catalog of Radiation Configuration Factors, C-11.
double opposed(double x, double y) {
  const double x2 = 1 + x * x, y2 = 1 + y * y;
  return 2.0 / (kPi * x * y) *
         (std::log(std::sqrt(x2 * y2 / (x2 + y * y))) + x * std::sqrt(y2) * std::atan(x / std::sqrt(y2)) +
          y * std::sqrt(x2) * std::atan(y / std::sqrt(x2)) - x * std::atan(x) - y * std::atan(y));
}

// From a rectangle w x l to one h x l that stands on its edge of length l = 1. Source: the same, C-14.
double perpendicular(double h, double w) {
  const double h2 = h * h, w2 = w * w, s = h2 + w2;
  const double a = (1 + w2) * (1 + h2) / (1 + s);
  const double b = std::pow(w2 * (1 + s) / ((1 + w2) * s), w2), c = std::pow(h2 * (1 + s) / ((1 + h2) * s), h2);
  return 1.0 / (kPi * w) *
         (w * std::atan(1 / w) + h * std::atan(1 / h) - std::sqrt(s) * std::atan(1 / std::sqrt(s)) +
          0.25 * std::log(a * b * c));
}

Quad floorOf(double x, double y) { return {Vec3(0, 0, 0), Vec3(x, 0, 0), Vec3(x, y, 0), Vec3(0, y, 0)}; }

TEST(FormFactor, ParallelPlatesHaveTheirClosedForm) {
  for (const auto& [x, y] : {std::pair(1.0, 1.0), std::pair(2.0, 0.5), std::pair(5.0, 5.0)}) {
    const Quad low = floorOf(x, y), high{Vec3(0, 0, 1), Vec3(x, 0, 1), Vec3(x, y, 1), Vec3(0, y, 1)};
    const double mine = meanOver(low, 32, [&](const Vec3& p) { return polygonFactor(p, {0, 0, 1}, high); });
    std::printf("parallel %g x %g: %.6f, closed form %.6f\n", x, y, mine, opposed(x, y));
    EXPECT_NEAR(mine / opposed(x, y), 1.0, 1e-3);
  }
  EXPECT_NEAR(opposed(1, 1), 0.199825, 1e-6);  // as tables have it
}

TEST(FormFactor, PerpendicularPlatesHaveTheirClosedForm) {
  for (const auto& [h, w] : {std::pair(1.0, 1.0), std::pair(0.5, 2.0), std::pair(3.0, 1.0)}) {
    const Quad low = floorOf(w, 1), wall{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 1, h), Vec3(0, 0, h)};
    const double mine = meanOver(low, 128, [&](const Vec3& p) { return polygonFactor(p, {0, 0, 1}, wall); });
    std::printf("perpendicular h %g w %g: %.6f, closed form %.6f\n", h, w, mine, perpendicular(h, w));
    EXPECT_NEAR(mine / perpendicular(h, w), 1.0, 2e-3);
  }
  EXPECT_NEAR(perpendicular(1, 1), 0.200044, 1e-6);
}

TEST(FormFactor, BothWaysAlike) {
  const Quad a = floorOf(2, 1), b{Vec3(0.3, 0, 0.1), Vec3(0, 1.5, 0.4), Vec3(-0.4, 1.5, 2), Vec3(-0.1, 0, 1.7)};
  const Vec3 nb = glm::normalize(glm::cross(b[1] - b[0], b[3] - b[0]));
  const double areaB = glm::length(glm::cross(b[1] - b[0], b[3] - b[0]));
  const double ab = 2.0 * meanOver(a, 200, [&](const Vec3& p) { return polygonFactor(p, {0, 0, 1}, b); });
  const double ba =
      areaB * meanOver(b, 200, [&](const Vec3& p) { return polygonFactor(p, nb, a) + polygonFactor(p, -nb, a); });
  std::printf("A1 F12 %.6f, A2 F21 %.6f\n", ab, ba);
  EXPECT_NEAR(ab / ba, 1.0, 1e-3);
}

// Whatever the point and the normal, a closed box around it is everything there is.
TEST(FormFactor, SumsToOneInAClosedBox) {
  const auto box = shapes::box({-1, -2, -1}, {2, 1, 3});
  shapes::Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3 point = random.point({{-0.999, -1.999, -0.999}, {1.999, 0.999, 2.999}});
    const Vec3 normal = glm::normalize(random.point({{-1, -1, -1}, {1, 1, 1}}));
    double sum = 0.0;
    for (const auto& t : box.triangles) {
      const std::array<Vec3, 3> corners{box.positions[t[0]], box.positions[t[1]], box.positions[t[2]]};
      sum += polygonFactor(point, normal, corners);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(FormFactor, NothingBehindAndNothingInThePlane) {
  const std::array<Vec3, 3> below{Vec3(-1, -1, -1), Vec3(1, -1, -1), Vec3(0, 1, -1)};
  EXPECT_EQ(polygonFactor({0, 0, 0}, {0, 0, 1}, below), 0.0);
  const std::array<Vec3, 3> level{Vec3(1, -1, 0), Vec3(2, -1, 0), Vec3(1, 1, 0)};
  EXPECT_EQ(polygonFactor({0, 0, 0}, {0, 0, 1}, level), 0.0);
  const std::array<Vec3, 3> line{Vec3(-1, 0, 1), Vec3(0, 0, 1), Vec3(1, 0, 1)};
  EXPECT_EQ(polygonFactor({0, 0, 0}, {0, 0, 1}, line), 0.0);
}

trace::Occlusion occlusionOf(std::vector<mesh::Mesh> meshes) {
  auto surfaces = std::make_shared<const scene::Surfaces>(scene::flatten(shapes::scene(std::move(meshes))));
  return std::move(*trace::Occlusion::build(surfaces));
}

/// A lamp over the origin, looking down.
Emitter lamp() { return {{Vec3(-1, -1, 2), Vec3(1, -1, 2), Vec3(0, 1, 2)}, {0, 0, -1}, 1e-5}; }

TEST(VisibleFactor, WhatABlockerLeaves) {
  const auto free = occlusionOf({shapes::quad({9, 9, 9}, {10, 9, 9}, {10, 10, 9}, {9, 10, 9})});
  const auto all = occlusionOf({shapes::quad({-5, -5, 1}, {5, -5, 1}, {5, 5, 1}, {-5, 5, 1})});
  const auto speck = occlusionOf({shapes::quad({-.05, -.05, 1}, {.05, -.05, 1}, {.05, .05, 1}, {-.05, .05, 1})});
  const Receiver floor{{0, 0, 0}, {0, 0, 1}, 1e-5};
  const double whole = visibleFactor(free, floor, lamp());
  EXPECT_DOUBLE_EQ(whole, polygonFactor(floor.point, floor.normal, lamp().corner));
  EXPECT_EQ(visibleFactor(all, floor, lamp()), 0.0);
  const Quad shade{Vec3(-.1, -.1, 2), Vec3(.1, -.1, 2), Vec3(.1, .1, 2), Vec3(-.1, .1, 2)};
  EXPECT_NEAR(visibleFactor(speck, floor, lamp()), whole - polygonFactor(floor.point, floor.normal, shade),
              0.02 * whole);
  EXPECT_EQ(visibleFactor(free, {{0, 0, 3}, {0, 0, -1}, 1e-5}, lamp()), 0.0) << "behind the lamp";
  EXPECT_EQ(visibleFactor(free, {{0, 0, 0}, {0, 0, -1}, 1e-5}, lamp()), 0.0) << "looking away";
}

// What of the lamp lies beyond x is hidden by a plate that ends halfway to it; along an axis of the lamp too.
TEST(VisibleFactor, HalfTheLamp) {
  const Receiver floor{{0, 0, 0}, {0, 0, 1}, 1e-5};
  const double whole = polygonFactor(floor.point, floor.normal, lamp().corner);
  double sum = 0.0;
  for (int i = 0; i < 64; ++i) {
    const double x = i / 80.0;
    const auto half = occlusionOf({shapes::quad({x / 2, -5, 1}, {5, -5, 1}, {5, 5, 1}, {x / 2, 5, 1})});
    const std::array<Vec3, 4> left{Vec3(-1, -1, 2), Vec3(x, -1, 2), Vec3(x, 1 - 2 * x, 2), Vec3(0, 1, 2)};
    const double error = visibleFactor(half, floor, lamp()) - polygonFactor(floor.point, floor.normal, left);
    EXPECT_LT(std::abs(error), 0.02 * whole);
    sum += error * error;
  }
  std::printf("half a lamp: off by %.4f of it (root of the mean square)\n", std::sqrt(sum / 64) / whole);
  EXPECT_LT(std::sqrt(sum / 64), 0.006 * whole);
}

}  // namespace
}  // namespace umbrage::radiosity
