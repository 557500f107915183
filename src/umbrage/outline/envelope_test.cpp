#include "umbrage/outline/envelope.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "umbrage/outline/detail/above.hpp"
#include "umbrage/outline/test_prisms.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::outline {
namespace {

Region swept(const std::vector<CasterPart>& parts, const std::vector<Vec2>& slopes, double height = 0.0) {
  const auto envelope = sweepShadows(parts, height, {{slopes, 0.0, {}, {}}}, Grouping::merged);
  EXPECT_TRUE(envelope);
  return envelope ? envelope->shadows.at(0).region : Region{};
}
Region shadow(const std::vector<CasterPart>& parts, const Vec2& slope) {
  return shadowsOnPlane(parts, 0.0, {slope}, Grouping::merged)->front().front().region;
}

// A post of no width, drawn as a tetrahedron about to vanish: its shadow sweeps the triangle of its foot and the top's way.
TEST(Envelope, aPostSweepsATriangle) {
  const double e = 1e-7;
  const CasterPart post{
      "post", {{-e, 0, 0}, {e, 0, 0}, {0, e, 0}, {0, 0, 10}}, {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {}};
  EXPECT_NEAR(swept({post}, {{1, 0}, {0, 1}}).area, 0.5 * 10 * 10, 1e-4);
  EXPECT_NEAR(swept({post}, {{1, 0}, {1, 1}, {0, 1}}).area, 10 * 10, 1e-4);
}

// The shadow of a box on its own base sweeps: the base, and beyond it the hexagons' union, here the convex hull of base, and top shifted to
// both ends, for a convex caster whose top moves straight.
TEST(Envelope, aBoxSweepsAHull) {
  const CasterPart box = prism("box", rectangle({0, 0}, 4, 6), 0, 5);
  // From (5, 10) to (10, 5): corners of the hull (0,0) (4,0) (14,5) (14,11) (9,16) (5,16) (0,6), its area by the shoelace formula.
  EXPECT_NEAR(swept({box}, {{1, 2}, {2, 1}}).area,
              areaOf(Ring{{0, 0}, {4, 0}, {14, 5}, {14, 11}, {9, 16}, {5, 16}, {0, 6}}), 1e-6);
  EXPECT_NEAR(swept({box}, {{1, 2}, {1, 2}}).area, shadow({box}, {1, 2}).area, 1e-6);
}

// For how much of the way from one slope to the other a triangle's shadow covers a point: its three edges leave the point on their left
// during intervals with closed forms, as their turns are linear in time.
double coveredFor(const CasterPart& part, const mesh::Triangle& t, const Vec2& p, const Vec2& from, const Vec2& to) {
  double longest = -1.0;
  for (const double sense : {1.0, -1.0}) {
    double begin = 0.0, end = 1.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = part.points[t[k]], b = part.points[t[(k + 1) % 3]];
      const auto turn = [&](const Vec2& slope) {
        const Vec2 u = Vec2(b) + b.z * slope - Vec2(a) - a.z * slope, v = p - Vec2(a) - a.z * slope;
        return sense * (u.x * v.y - u.y * v.x);
      };
      const double first = turn(from), last = turn(to);
      if (first < 0.0 && last < 0.0) end = -1.0;
      if (first < 0.0 && last >= 0.0) begin = std::max(begin, first / (first - last));
      if (first >= 0.0 && last < 0.0) end = std::min(end, first / (first - last));
    }
    longest = std::max(longest, end - begin);
  }
  return longest;
}

TEST(Envelope, coversWhatIsCoveredAtAnyTimeAndNothingElse) {
  EXPECT_TRUE(rc::check([] {
    const auto number = rc::gen::resize(100, rc::gen::inRange(0, 8));
    const auto corners =
        *rc::gen::container<std::vector<int>>(*rc::gen::resize(100, rc::gen::inRange(1, 16)) * 9, number);
    CasterPart soup{"soup", {}, {}, {}};
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      soup.points.emplace_back(corners[i], corners[i + 1], corners[i + 2] - 2);
    for (std::uint32_t i = 0; i + 2 < soup.points.size(); i += 3) soup.triangles.push_back({i, i + 1, i + 2});
    const Vec2 from(1.0, -0.5), to(-0.5, 1.25);
    const Region envelope = swept({soup}, {from, to});
    const CasterPart raised = detail::above(soup, 0.0);
    for (int x = -4; x < 16; ++x)
      for (int y = -4; y < 16; ++y) {
        const Vec2 p(x + 0.371232, y + 0.604317);
        double covered = -1.0;
        for (const mesh::Triangle& t : raised.triangles)
          covered = std::max(covered, coveredFor(raised, t, p, from, to));
        // A point that is all but on a border may go either way.
        if (covered > 1e-5) RC_ASSERT(holds(envelope, p));
        if (covered < -1e-5) RC_ASSERT(!holds(envelope, p));
      }
    RC_CLASSIFY(envelope.area > 50.0, "large");
  }));
}

TEST(Envelope, pathsFollowTheSun) {
  const auto place = sun::makePlace(48.2, 16.37);
  const auto day = std::chrono::sys_days(std::chrono::year(2026) / 12 / 21);
  const SweepPeriod period{*place, Angle{}, day, day + std::chrono::hours(24), Angle::degrees(5), 1e-4};
  const auto paths = slopePaths(period);
  ASSERT_EQ(paths.size(), 1U);
  const SlopePath& path = paths[0];
  EXPECT_LE(path.deviation, 1e-4);
  EXPECT_NEAR(sun::sunPosition(*place, path.from).elevation.degrees(), 5.0, 1e-4);
  EXPECT_NEAR(sun::sunPosition(*place, path.to).elevation.degrees(), 5.0, 1e-4);
  for (auto t = path.from; t < path.to; t += std::chrono::seconds(97)) {
    const Vec2 slope = shadowSlope(sun::sunPosition(*place, t));
    double off = 1e300;
    for (std::size_t i = 1; i < path.slopes.size(); ++i) {
      const Vec2 a = path.slopes[i - 1], ab = path.slopes[i] - a;
      const double along = std::clamp(glm::dot(slope - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
      off = std::min(off, glm::length(slope - a - along * ab));
    }
    EXPECT_LE(off, path.deviation);
  }
  EXPECT_LT(path.slopes.size(), 600U);
}

TEST(Envelope, polarDaysAndNights) {
  const auto place = sun::makePlace(70, 20);
  const auto winter = std::chrono::sys_days(std::chrono::year(2026) / 12 / 20);
  EXPECT_TRUE(slopePaths({*place, Angle{}, winter, winter + std::chrono::hours(24)}).empty());
  const auto summer = std::chrono::sys_days(std::chrono::year(2026) / 6 / 20);
  ASSERT_EQ(slopePaths({*place, Angle{}, summer, summer + std::chrono::hours(24), Angle::degrees(1)}).size(), 1U);
  // Two stretches where midnight is too low.
  EXPECT_EQ(slopePaths(
                {*place, Angle{}, summer + std::chrono::hours(12), summer + std::chrono::hours(36), Angle::degrees(10)})
                .size(),
            2U);
}

}  // namespace
}  // namespace umbrage::outline
