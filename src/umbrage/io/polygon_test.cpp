#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <numeric>
#include <random>

#include "umbrage/io/reader/polygon.hpp"

namespace umbrage::io::reader {
namespace {

// Every edge of a ring once, every other edge as often one way as the other.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance(const std::vector<mesh::Triangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const mesh::Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a != b) edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
  return edges;
}

Vec3 areaOf(const std::vector<Vec3>& points, const std::vector<mesh::Triangle>& triangles) {
  Vec3 area(0.0);
  for (const mesh::Triangle& t : triangles)
    area += 0.5 * glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
  return area;
}

double unsignedArea(const std::vector<Vec3>& points, const std::vector<mesh::Triangle>& triangles) {
  double area = 0.0;
  for (const mesh::Triangle& t : triangles)
    area += 0.5 * glm::length(glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
  return area;
}

Rings oneRing(std::size_t corners) {
  Rings rings(1, std::vector<std::uint32_t>(corners));
  std::iota(rings[0].begin(), rings[0].end(), 0U);
  return rings;
}

// A wall of 10 x 6 in the plane y = 3 with two windows.
const std::vector<Vec3> kWall = {{0, 3, 0}, {10, 3, 0}, {10, 3, 6}, {0, 3, 6}, {1, 3, 1}, {1, 3, 3},
                                 {3, 3, 3}, {3, 3, 1},  {5, 3, 2},  {5, 3, 5}, {8, 3, 5}, {8, 3, 2}};

TEST(Polygon, wallWithTwoWindows) {
  const Rings rings = {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}};
  const auto triangles = triangulate(kWall, rings);
  EXPECT_EQ(triangles.size(), 12U + 2 * 2 - 2);
  EXPECT_EQ(balance(triangles).size(), 12U);
  EXPECT_NEAR(areaOf(kWall, triangles).y, -(60.0 - 4.0 - 9.0), 1e-12);
  EXPECT_NEAR(unsignedArea(kWall, triangles), 60.0 - 4.0 - 9.0, 1e-12);
}

TEST(Polygon, holesMayRunEitherWay) {
  const Rings rings = {{0, 1, 2, 3}, {7, 6, 5, 4}, {8, 9, 10, 11}};
  EXPECT_NEAR(unsignedArea(kWall, triangulate(kWall, rings)), 47.0, 1e-12);
}

TEST(Polygon, windsLikeItsOuterRing) {
  const std::vector<Vec3> points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
  EXPECT_NEAR(areaOf(points, triangulate(points, oneRing(5))).z, 10.0, 1e-12);
  EXPECT_NEAR(areaOf(points, triangulate(points, {{4, 3, 2, 1, 0}})).z, -10.0, 1e-12);
}

TEST(Polygon, concaveQuadrilateralIsCutAtItsReflexCorner) {
  const std::vector<Vec3> points = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  EXPECT_NEAR(unsignedArea(points, triangulate(points, oneRing(4))), 4.0, 1e-12);
}

TEST(Polygon, repeatedCornersAreLeftOut) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  EXPECT_EQ(triangulate(points, oneRing(6)).size(), 2U);
}

TEST(Polygon, fewerThanThreeCornersGiveNothing) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  EXPECT_TRUE(triangulate(points, oneRing(3)).empty());
  EXPECT_TRUE(triangulate(points, {}).empty());
  EXPECT_TRUE(triangulate(points, {{}}).empty());
}

TEST(Polygon, cornersOnAStraightEdgeAreKept) {
  // A T-junction's other side has these corners; dropping them would open the seam.
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
  const auto triangles = triangulate(points, oneRing(6));
  EXPECT_EQ(triangles.size(), 4U);
  EXPECT_EQ(balance(triangles).size(), 6U);
  EXPECT_NEAR(unsignedArea(points, triangles), 6.0, 1e-12);
}

TEST(Polygon, farFromTheOriginNothingCancels) {
  const Vec3 far(435440.123, 5790123.456, 12.0);
  std::vector<Vec3> points;
  for (const Vec3& p : kWall) points.push_back(0.01 * p + far);
  const auto triangles = triangulate(points, {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}});
  EXPECT_EQ(balance(triangles).size(), 12U);
  EXPECT_NEAR(unsignedArea(points, triangles), 47.0e-4, 1e-9);
}

TEST(Polygon, aCrossingRingIsStillWatertight) {
  const std::vector<Vec3> bow = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
  EXPECT_EQ(balance(triangulate(bow, oneRing(4))).size(), 4U);
}

TEST(Polygon, aThousandHolesOnEachOtherEnd) {
  std::mt19937 random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i) points.emplace_back(random() % 1000000, random() % 1000000, 0);
  Rings rings = {{0, 1, 2}};
  for (std::uint32_t i = 3; i < 3000; i += 3) rings.push_back({i, i + 1, i + 2});
  const auto triangles = triangulate(points, rings);
  EXPECT_LE(triangles.size(), 3000U + 2 * 999 - 2);
  EXPECT_EQ(balance(triangles).size(), 3000U);
}

// On a small lattice crossings, touching holes, spikes and corners on edges are common.
TEST(Polygon, anyRingsAtAllAreWatertight) {
  rc::check("law 2", [] {
    const auto corners = *rc::gen::inRange<std::size_t>(3, 14);
    const auto holeCorners = *rc::gen::inRange<std::size_t>(0, 7);
    std::vector<Vec3> points;
    Rings rings(holeCorners >= 3 ? 2 : 1);
    for (std::size_t i = 0; i < corners + (holeCorners >= 3 ? holeCorners : 0); ++i) {
      points.emplace_back(*rc::gen::inRange(0, 5), *rc::gen::inRange(0, 5), *rc::gen::inRange(0, 2));
      rings[i < corners ? 0 : 1].push_back(static_cast<std::uint32_t>(i));
    }
    const auto triangles = triangulate(points, rings);
    if (triangles.empty()) return;
    // By place, since corners in one place are one for whoever welds; ring edges traversed to and fro cancel.
    const auto place = [&](std::uint32_t i) {
      return static_cast<std::uint32_t>(points[i].x + 8 * points[i].y + 64 * points[i].z);
    };
    std::vector<mesh::Triangle> placed;
    for (const mesh::Triangle& t : triangles) placed.push_back({place(t[0]), place(t[1]), place(t[2])});
    auto parity = balance(placed);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> border;
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size() && ring.size() >= 3; ++i) {
        const std::uint32_t a = place(ring[i]), b = place(ring[(i + 1) % ring.size()]);
        if (a != b) border[{std::min(a, b), std::max(a, b)}] += 1;
      }
    // Modulo two the border of the triangles is the rings.
    for (auto& [edge, count] : parity) border[edge] += count;
    for (const auto& [edge, count] : border) RC_ASSERT(count % 2 == 0);
  });
}

}  // namespace
}  // namespace umbrage::io::reader
