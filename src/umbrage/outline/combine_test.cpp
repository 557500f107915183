#include "umbrage/outline/combine.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "umbrage/outline/shadow.hpp"
#include "umbrage/outline/test_prisms.hpp"

namespace umbrage::outline {
namespace {

Region regionOf(const Ring& ring) {
  Region region;
  region.polygons.push_back({ring, {}});
  region.area = areaOf(ring);
  return region;
}

TEST(Combine, rectangles) {
  const Region a = regionOf(rectangle({0, 0}, 10, 8)), b = regionOf(rectangle({6, 3}, 10, 10));
  EXPECT_NEAR(without(a, b).area, 80.0 - 20.0, 1e-6);
  EXPECT_NEAR(common(a, b).area, 20.0, 1e-6);
  EXPECT_NEAR(together({a, b}).area, 80.0 + 100.0 - 20.0, 1e-6);
  EXPECT_TRUE(without(a, a).polygons.empty());
  EXPECT_NEAR(common(a, a).area, 80.0, 1e-6);
  // A hole comes and is filled again.
  const Region hole = without(a, regionOf(rectangle({2, 2}, 3, 3)));
  ASSERT_EQ(hole.polygons.size(), 1U);
  EXPECT_EQ(hole.polygons[0].holes.size(), 1U);
  EXPECT_NEAR(hole.area, 71.0, 1e-6);
  EXPECT_NEAR(without(a, hole).area, 9.0, 1e-6);
  EXPECT_FALSE(covers(hole, {3, 3}));
  EXPECT_TRUE(covers(hole, {1, 1}));
}

TEST(Combine, nothingIsNothing) {
  const Region a = regionOf(rectangle({0, 0}, 10, 8));
  EXPECT_TRUE(without({}, a).polygons.empty());
  EXPECT_NEAR(without(a, {}).area, 80.0, 1e-6);
  EXPECT_TRUE(common(a, {}).polygons.empty());
  EXPECT_TRUE(together({}).polygons.empty());
  EXPECT_TRUE(grown({}, 1.0, 0.1).polygons.empty());
  EXPECT_TRUE(std::isinf(distanceTo({}, {0, 0})));
}

TEST(Combine, grownByADistance) {
  // A rectangle grows by its sides and four quarters of a disc.
  const double d = 5.0;
  const Region g = grown(regionOf(rectangle({100, 50}, 20, 10)), d, 1e-4);
  const double exact = 200.0 + 60.0 * d + std::numbers::pi * d * d;
  EXPECT_LE(g.area, exact);
  EXPECT_NEAR(g.area, exact, 1e-4 * 2.0 * std::numbers::pi * d);
  for (const Vec2& p : g.polygons.at(0).outer) {
    EXPECT_LE(distanceTo(regionOf(rectangle({100, 50}, 20, 10)), p), d + 1e-7);
    EXPECT_GE(distanceTo(regionOf(rectangle({100, 50}, 20, 10)), p), d - 1e-4);
  }
  // A court that grows shut.
  const Region court = without(regionOf(rectangle({0, 0}, 30, 30)), regionOf(rectangle({10, 10}, 10, 10)));
  EXPECT_EQ(grown(court, 4.0, 1e-3).polygons.at(0).holes.size(), 1U);
  EXPECT_TRUE(grown(court, 6.0, 1e-3).polygons.at(0).holes.empty());
}

TEST(Combine, inPieces) {
  Ring comb;
  for (int i = 0; i < 300; ++i)
    for (const Vec2& p : {Vec2(0.3 * i, 2), Vec2(0.3 * i + 0.1, 2), Vec2(0.3 * i + 0.1, 40), Vec2(0.3 * i + 0.3, 40)})
      comb.push_back(p);
  comb.emplace_back(90, 50), comb.emplace_back(0, 50);
  const Region region = without(regionOf(comb), regionOf(rectangle({10, 43}, 20, 3)));
  const std::vector<Region> pieces = inPieces(region, 64);
  EXPECT_GT(pieces.size(), 10U);
  double area = 0.0;
  for (const Region& piece : pieces) {
    area += piece.area;
    std::size_t corners = 0;
    for (const Polygon& polygon : piece.polygons) {
      corners += polygon.outer.size();
      for (const Ring& hole : polygon.holes) corners += hole.size();
    }
    EXPECT_LE(corners, 64U);
    EXPECT_LT(without(piece, region).area, 1e-5);
  }
  EXPECT_NEAR(area, region.area, 1e-5);
  EXPECT_EQ(inPieces(region, 5000).size(), 1U);
  EXPECT_TRUE(inPieces({}, 64).empty());
  // The shadow on the pieces is that on the whole.
  const CasterPart low = prism("low", rectangle({-5, -20}, 10, 8), 0, 9),
                   high = prism("high", rectangle({12, -20}, 20, 10), 0, 40);
  for (const Vec2& slope : {Vec2(0.1, 0.9), Vec2(1.0, 1.4), Vec2(-0.9, 0.3)})
    EXPECT_NEAR(newShadowArea({high, low}, {low}, slope, pieces), newShadow({high, low}, {low}, slope, region).area,
                1e-5)
        << slope.x;
  EXPECT_EQ(newShadowArea({low}, {low}, {0.3, 1.0}, pieces), 0.0);
}

// The shadow of a box on its own ground: the ground plan, and what its width across the slope sweeps over.
double boxShadow(double width, double depth, double height, const Vec2& slope) {
  return width * depth + height * (width * std::abs(slope.y) + depth * std::abs(slope.x));
}

TEST(NewShadow, twoKnownBoxes) {
  // Two boxes of one ground plan, 20 m by 10 m: the taller one adds a strip of the difference.
  const Vec2 slope(0.9, 1.6);
  const CasterPart low = prism("low", rectangle({3, -2}, 20, 10), 0, 7),
                   high = prism("high", rectangle({3, -2}, 20, 10), 0, 18);
  const double expected = boxShadow(20, 10, 18, slope) - boxShadow(20, 10, 7, slope);
  EXPECT_NEAR(newShadow({high}, {low}, slope).area / expected, 1.0, 1e-6);
  EXPECT_EQ(newShadow({low}, {high}, slope).area, 0.0);
  EXPECT_EQ(newShadow({low}, {low}, slope).area, 0.0);
  // Apart from each other all of it is new.
  const CasterPart far = prism("far", rectangle({300, -2}, 20, 10), 0, 18);
  EXPECT_NEAR(newShadow({far}, {low}, slope).area / boxShadow(20, 10, 18, slope), 1.0, 1e-6);
  // Towards the north: the second box stands 12 m behind the first, whose shadow of 16 m reaches 4 m into the second's of 20 m and 10 m of
  // ground plan.
  const CasterPart first = prism("first", rectangle({0, 0}, 20, 10), 0, 16),
                   second = prism("second", rectangle({0, 22}, 20, 10), 0, 20);
  EXPECT_NEAR(newShadow({second}, {first}, {0, 1}).area / (20.0 * (10 + 20 - 4)), 1.0, 1e-6);
  const Region park = regionOf(rectangle({-5, 40}, 15, 30));
  EXPECT_NEAR(newShadow({second}, {first}, {0, 1}, park).area / (10.0 * 12.0), 1.0, 1e-6);
}

TEST(NewShadow, farFromTheOriginAndWhateverStands) {
  const Vec2 slope(0.7, 1.1);
  const CasterPart low = prism("low", rectangle({4801966.4, 2919500.7}, 10, 7), 200, 207);
  const CasterPart high = prism("high", rectangle({4801966.4, 2919500.7}, 10, 7), 200, 212);
  const auto raised = [](const CasterPart& part) { return aboveHeight({part}, 200.0); };
  const double expected = boxShadow(10, 7, 12, slope) - boxShadow(10, 7, 7, slope);
  EXPECT_NEAR(newShadow(raised(high), raised(low), slope).area / expected, 1.0, 1e-6);
  EXPECT_TRUE(aboveHeight({low}, 300.0).empty());
}

// On any town of boxes the new shadow is the difference of the two shadows.
TEST(NewShadow, isTheDifferenceOfShadows) {
  EXPECT_TRUE(rc::check([] {
    const auto number = rc::gen::resize(100, rc::gen::inRange(0, 12));
    const auto numbers = *rc::gen::container<std::vector<int>>(20, number);
    std::vector<CasterPart> parts;
    for (std::size_t i = 0; i + 4 < numbers.size(); i += 5)
      parts.push_back(prism("p", rectangle(Vec2(numbers[i], numbers[i + 1]), 1 + numbers[i + 2], 1 + numbers[i + 3]), 0,
                            1 + numbers[i + 4]));
    const Vec2 slope(0.37, 0.81);
    const std::vector<CasterPart> standing(parts.begin(), parts.begin() + 2), added(parts.begin() + 2, parts.end());
    const auto area = [&](const std::vector<CasterPart>& of) {
      return shadowsOnPlane(of, 0.0, {slope}, Grouping::merged)->front().front().region.area;
    };
    RC_ASSERT(std::abs(newShadow(added, standing, slope).area - (area(parts) - area(standing))) < 1e-5);
  }));
}

}  // namespace
}  // namespace umbrage::outline
