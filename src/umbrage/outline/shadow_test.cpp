#include "umbrage/outline/shadow.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "umbrage/outline/test_prisms.hpp"

namespace umbrage::outline {
namespace {

std::vector<Shadow> shadows(const std::vector<CasterPart>& parts, const Vec2& slope,
                            Grouping grouping = Grouping::merged, double height = 0.0) {
  const auto all = shadowsOnPlane(parts, height, {slope}, grouping);
  EXPECT_TRUE(all);
  return all ? all->front() : std::vector<Shadow>{};
}
double mergedArea(const std::vector<CasterPart>& parts, const Vec2& slope, double height = 0.0) {
  return shadows(parts, slope, Grouping::merged, height).at(0).region.area;
}

// The shadow of a convex prism on its own base: the base, and what its width across the slope sweeps over.
double convexShadow(const Ring& ring, double height, const Vec2& slope) {
  const Vec2 across = Vec2(-slope.y, slope.x);
  double low = 1e300, high = -1e300;
  for (const Vec2& p : ring) {
    low = std::min(low, glm::dot(p, across));
    high = std::max(high, glm::dot(p, across));
  }
  return areaOf(ring) + height * (high - low);
}

const std::vector<Vec2> kSlopes = {{0.3, 1.7},   {-2.0, 0.25},  {1.0, 0.0}, {0.0, -3.0},
                                   {11.0, 17.0}, {1e-3, -1e-4}, {0.0, 0.0}};

TEST(ShadowOnPlane, boxesAndPrisms) {
  for (const Vec2& slope : kSlopes) {
    const Ring box = rectangle({3, -2}, 12.5, 8.0);
    EXPECT_NEAR(mergedArea({prism("box", box, 0, 21)}, slope) / convexShadow(box, 21, slope), 1.0, 1e-6);
    for (const int corners : {3, 6, 37}) {
      const Ring ring = polygon(corners, 9.0, {100.0, 50.0});
      EXPECT_NEAR(mergedArea({prism("prism", ring, 0, 14)}, slope) / convexShadow(ring, 14, slope), 1.0, 1e-6);
    }
  }
}

TEST(ShadowOnPlane, farFromTheOrigin) {
  const Ring box = rectangle({4801966.4, 2919500.7}, 10.0, 7.0);
  EXPECT_NEAR(mergedArea({prism("box", box, 200.0, 212.0)}, {0.7, 1.1}, 200.0) / (70 + 12 * (10 * 1.1 + 7 * 0.7)), 1.0,
              1e-6);
}

// An L of 20 x 20 without 12 x 12 at its north-eastern corner, shadow towards the north-east, shorter than the notch: the southern wing
// sweeps 20 v.y + 8 v.x beyond itself, the western one 8 v.y + 12 v.x, and they share what the western wing stands in, 8 v.y.
TEST(ShadowOnPlane, anLShape) {
  const CasterPart l = joined({prism("l", rectangle({0, 0}, 20, 8), 0, 5), prism("l", rectangle({0, 8}, 8, 12), 0, 5)});
  for (const Vec2& slope : {Vec2(0.4, 0.6), Vec2(2.2, 1e-3), Vec2(1.7, 2.3)}) {
    const Vec2 v = 5.0 * slope;
    EXPECT_NEAR(mergedArea({l}, slope) / (256 + 20 * v.x + 20 * v.y), 1.0, 1e-6);
  }
}

// A court of 30 m inside walls of 10 m: high walls, low sun and the other way round.
TEST(ShadowOnPlane, aCourtWithAHole) {
  const auto court = [](double h) {
    return joined(
        {prism("court", rectangle({-10, -10}, 50, 10), 0, h), prism("court", rectangle({-10, 30}, 50, 10), 0, h),
         prism("court", rectangle({-10, 0}, 10, 30), 0, h), prism("court", rectangle({30, 0}, 10, 30), 0, h)});
  };
  const Vec2 slope(0.5, 0.8);
  for (const double h : {10.0, 20.0, 30.0}) {
    const Vec2 v = h * slope;
    const auto shadow = shadows({court(h)}, slope).at(0).region;
    const double lit = std::max(0.0, 30 - v.x) * std::max(0.0, 30 - v.y);
    EXPECT_NEAR(shadow.area / (convexShadow(rectangle({-10, -10}, 50, 50), h, slope) - lit), 1.0, 1e-6) << h;
    ASSERT_EQ(shadow.polygons.size(), 1U);
    EXPECT_EQ(shadow.polygons[0].holes.size(), 1U);
    EXPECT_NEAR(areaOf(shadow.polygons[0]), shadow.area, 1e-9 * shadow.area);
  }
}

TEST(ShadowOnPlane, cutOffAtThePlane) {
  const Ring box = rectangle({0, 0}, 4, 6);
  const Vec2 slope(1.5, -0.5);
  EXPECT_NEAR(mergedArea({prism("box", box, -3, 7)}, slope) / convexShadow(box, 7, slope), 1.0, 1e-9);
  EXPECT_NEAR(mergedArea({prism("box", box, 0, 7)}, slope, 2.5) / convexShadow(box, 4.5, slope), 1.0, 1e-9);
  EXPECT_EQ(mergedArea({prism("box", box, 0, 7)}, slope, 7.0), 0.0);
  EXPECT_TRUE(shadows({prism("box", box, 0, 7)}, slope, Grouping::parts, 8.0).empty());
  // Floating: the base is carried along as well.
  EXPECT_NEAR(mergedArea({prism("box", box, 2, 7)}, slope) / convexShadow(box, 5, slope), 1.0, 1e-9);
}

TEST(ShadowOnPlane, aGroundInThePlaneCastsNothing) {
  CasterPart ground{"ground", {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}}, {{0, 1, 2}}, {}};
  EXPECT_EQ(mergedArea({ground}, {1, 1}), 0.0);
  ground.points[2].z = 1e-3;
  EXPECT_NEAR(mergedArea({ground}, {0, 0}), 5000.0, 1e-3);
}

TEST(ShadowOnPlane, windingAndTopologyDoNotMatter) {
  CasterPart box = prism("box", rectangle({0, 0}, 4, 6), 0, 7);
  for (std::size_t i = 0; i < box.triangles.size(); i += 3) std::swap(box.triangles[i][0], box.triangles[i][1]);
  const Vec2 slope(0.6, 0.9);
  EXPECT_NEAR(mergedArea({box}, slope) / convexShadow(rectangle({0, 0}, 4, 6), 7, slope), 1.0, 1e-9);
  // A single wall, open: a parallelogram.
  const CasterPart wall{"wall", {{0, 0, 0}, {10, 0, 0}, {10, 0, 3}, {0, 0, 3}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  EXPECT_NEAR(mergedArea({wall}, slope), 10 * 3 * 0.9, 1e-6);
  // The same twice is the same.
  EXPECT_NEAR(mergedArea({wall, wall}, slope), 10 * 3 * 0.9, 1e-6);
}

TEST(ShadowOnPlane, partsKeepTheirNamesAndOverlap) {
  const std::vector<CasterPart> two = {prism("a", rectangle({0, 0}, 10, 10), 0, 10),
                                       prism("b", rectangle({5, 5}, 10, 10), 0, 10)};
  const auto parts = shadows(two, {0, 0}, Grouping::parts);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[1].name, "b");
  EXPECT_NEAR(parts[0].region.area, 100.0, 1e-6);
  EXPECT_NEAR(mergedArea(two, {0, 0}), 175.0, 1e-6);
}

TEST(ShadowOnPlane, slopeOfTheSun) {
  const sun::SunPosition south{Angle::degrees(45), Angle::degrees(180)};
  EXPECT_NEAR(shadowSlope(south).x, 0.0, 1e-12);
  EXPECT_NEAR(shadowSlope(south).y, 1.0, 1e-12);
  const sun::SunPosition west{Angle::degrees(30), Angle::degrees(270)};
  EXPECT_NEAR(shadowSlope(west).x, std::sqrt(3.0), 1e-12);
  // True north 90 degrees clockwise of the y axis lies along x.
  EXPECT_NEAR(shadowSlope(south, Angle::degrees(90)).x, 1.0, 1e-12);
}

// Triangles of any kind on a small lattice, so that corners, edges and whole triangles coincide: at points off the lattice the union is what
// some triangle covers.
TEST(ShadowOnPlane, unionIsWhatSomeTriangleCovers) {
  EXPECT_TRUE(rc::check([] {
    const auto number = rc::gen::resize(100, rc::gen::inRange(0, 8));
    const auto corners =
        *rc::gen::container<std::vector<int>>(*rc::gen::resize(100, rc::gen::inRange(1, 40)) * 9, number);
    CasterPart soup{"soup", {}, {}, {}};
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      soup.points.emplace_back(corners[i], corners[i + 1], corners[i + 2] - 2);
    for (std::uint32_t i = 0; i + 2 < soup.points.size(); i += 3) soup.triangles.push_back({i, i + 1, i + 2});
    const auto region = shadows({soup}, {1, 0}).at(0).region;
    double area = 0.0;
    for (const Polygon& p : region.polygons) area += areaOf(p);
    RC_ASSERT(std::abs(area - region.area) <= 1e-6);
    const auto covered = [&](const Vec2& p) {
      for (const mesh::Triangle& t : soup.triangles) {
        // The ray from p towards the sun is (p.x - z, p.y, z), z > 0: in a frame of p.x - z the triangle is plain.
        Ring flat, above;
        for (const std::uint32_t c : t) flat.push_back(Vec2(soup.points[c]) + Vec2(soup.points[c].z, 0.0));
        if (!holds(flat, p) || areaOf(flat) == 0.0) continue;
        const double whole = areaOf(flat);
        double z = 0.0;
        for (int k = 0; k < 3; ++k)
          z += areaOf(Ring{p, flat[(k + 1) % 3], flat[(k + 2) % 3]}) / whole * soup.points[t[k]].z;
        if (z > 0.0) return true;
      }
      return false;
    };
    for (int x = 0; x < 15; ++x)
      for (int y = 0; y < 8; ++y) {
        const Vec2 p(x + 0.371232, y + 0.604317);
        RC_ASSERT(holds(region, p) == covered(p));
      }
    RC_CLASSIFY(region.area > 20.0, "large");
  }));
}

}  // namespace
}  // namespace umbrage::outline
