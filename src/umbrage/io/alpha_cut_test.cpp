#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "umbrage/io/reader/alpha_cut.hpp"

namespace umbrage::io::reader {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

Coverage randomTexture(std::mt19937& random, int width, int height, bool binary) {
  CoverageCells cells{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    cells.values.push_back(static_cast<std::uint16_t>(binary ? 65535 * (random() % 2) : 257 * (random() % 256)));
  return Coverage(std::move(cells));
}

Coverage texture(int width, int height, const std::string& rows) {
  CoverageCells cells{width, height, {}};
  for (const char c : rows) cells.values.push_back(c == '#' ? 65535 : c == '-' ? 32768 - 16384 : 0);
  return Coverage(std::move(cells));
}

// The plane z = 0 with places as coordinates, so that what a point shows is easily asked.
TexturedTriangle flat(const std::array<Vec2, 3>& places) {
  TexturedTriangle t;
  for (std::size_t k = 0; k < 3; ++k) t.places[k] = places[k], t.corners[k] = Vec3(places[k], 0.0);
  return t;
}
std::vector<TexturedTriangle> square(double size) {
  return {flat({Vec2(0, 0), Vec2(size, 0), Vec2(size, size)}), flat({Vec2(0, 0), Vec2(size, size), Vec2(0, size)})};
}

std::optional<CutPieces> cut(const std::vector<TexturedTriangle>& triangles, const Coverage& coverage,
                             const CutRule& rule, std::size_t level, std::size_t most) {
  std::size_t effort = 10'000'000;
  return cutByCoverage(triangles, coverage, rule, level, most, effort);
}

double areaOf(const std::array<Vec3, 3>& t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2; }
double areaOf(const CutPieces& pieces) {
  double sum = 0.0;
  for (const auto& t : pieces.triangles) sum += areaOf(t);
  return sum;
}

// Of how many triangles a point lies inside, or less than nothing where it is too near a border to tell.
int layersAt(const CutPieces& pieces, const Vec2& p) {
  int layers = 0;
  for (const auto& t : pieces.triangles) {
    const std::array<Vec2, 3> c = {Vec2(t[0]), Vec2(t[1]), Vec2(t[2])};
    const double area = cross(c[1] - c[0], c[2] - c[0]);
    double least = 1.0;
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, cross(c[(k + 1) % 3] - c[k], p - c[k]) * (area > 0.0 ? 1.0 : -1.0));
    if (std::abs(least) < 1e-9) return -1000;
    layers += least > 0.0;
  }
  return layers;
}

Vec2 pointIn(const std::array<Vec2, 3>& t, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double a = unit(random), b = unit(random);
  if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
  return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
}

TEST(AlphaCut, PiecesAreWhatTheTexelsSay) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1.7, 2.9);
  std::size_t asked = 0, there = 0;
  for (int round = 0; round < 60; ++round) {
    const Coverage coverage = randomTexture(random, 1 + round % 9, 1 + round % 7, true);
    CutRule rule{.decides = true, .u = Wrap(round % 3), .v = Wrap(round / 3 % 3)};
    const auto corner = [&] {
      // Every other triangle has its corners on texels' corners.
      const Vec2 p(place(random), place(random));
      const Vec2 size(coverage.level(0).width, coverage.level(0).height);
      return round % 2 == 0 ? p : glm::round(p * size) / size;
    };
    const std::array<Vec2, 3> places = {corner(), corner(), corner()};
    if (std::abs(cross(places[1] - places[0], places[2] - places[0])) < 1e-3) continue;
    const auto pieces = cut({flat(places)}, coverage, rule, 0, 100'000);
    ASSERT_TRUE(pieces);
    EXPECT_EQ(pieces->worstArea, 0.0);
    for (int i = 0; i < 400; ++i) {
      const Vec2 p = pointIn(places, random);
      const int layers = layersAt(*pieces, p);
      if (layers < 0) continue;
      const auto& texels = coverage.level(0);
      const int x = wrapped(static_cast<long>(std::floor(p.x * texels.width)), texels.width, rule.u);
      const int y = wrapped(static_cast<long>(std::floor(p.y * texels.height)), texels.height, rule.v);
      ASSERT_EQ(layers, texels.at(x, y) != 0 ? 1 : 0) << "round " << round << " at " << p.x << " " << p.y;
      ++asked, there += layers == 1;
    }
  }
  EXPECT_GT(asked, 15'000u);
  EXPECT_GT(there, asked / 4);
}

// Edges that belong to one triangle alone, after identical points became one: their length is that of the border, so no piece has a
// neighbour's corner in the middle of its side.
double borderOf(const CutPieces& pieces) {
  std::map<std::array<double, 6>, int> edges;
  for (const auto& t : pieces.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 a = t[k], b = t[(k + 1) % 3];
      const auto key = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
      if (key(b) < key(a)) std::swap(a, b);
      ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
    }
  double length = 0.0;
  for (const auto& [e, count] : edges) {
    EXPECT_LE(count, 2);
    if (count == 1) length += glm::length(Vec3(e[0] - e[3], e[1] - e[4], e[2] - e[5]));
  }
  return length;
}

TEST(AlphaCut, NeighboursShareTheirCorners) {
  // A ring of 6 x 6 texels with a hole of 2 x 2 and a chimney of one: borders of 24, 8 and 2 sides of texels.
  const Coverage ring = texture(8, 8,
                                "......#."
                                ".######."
                                ".######."
                                ".##..##."
                                ".##..##."
                                ".######."
                                ".######."
                                "........");
  const auto pieces = cut(square(1.0), ring, {.decides = true, .u = Wrap::clamp, .v = Wrap::clamp}, 0, 1000);
  ASSERT_TRUE(pieces);
  EXPECT_NEAR(areaOf(*pieces), 33.0 / 64, 1e-12);
  EXPECT_NEAR(borderOf(*pieces), (24 + 8 + 2) / 8.0, 1e-12);
  EXPECT_EQ(pieces->cut, 2u);
}

TEST(AlphaCut, AFenceIsAsManyPiecesAsItHasBars) {
  const Coverage bars = texture(8, 2, ".##..##..##..##.");
  const auto pieces = cut(square(1.0), bars, {.decides = true}, 0, 1000);
  ASSERT_TRUE(pieces);
  EXPECT_NEAR(areaOf(*pieces), 0.5, 1e-12);
  EXPECT_LE(pieces->triangles.size(), 24u);
  // Ten times across: the texture repeats, and the bars join over its seam.
  const auto many = cut(square(10.0), bars, {.decides = true}, 0, 1000);
  ASSERT_TRUE(many);
  EXPECT_NEAR(areaOf(*many), 50.0, 1e-9);
}

TEST(AlphaCut, WhatIsThereInPartIsCutWhereItChanges) {
  const Coverage halves = texture(2, 1, "#-");
  const CutRule rule{.factor = 0.5, .u = Wrap::clamp, .v = Wrap::clamp};
  const auto pieces = cut(square(1.0), halves, rule, 0, 1000);
  ASSERT_TRUE(pieces);
  EXPECT_NEAR(areaOf(*pieces), 1.0, 1e-12);
  for (std::size_t t = 0; t < pieces->triangles.size(); ++t) {
    const auto& c = pieces->triangles[t];
    const double middle = (c[0].x + c[1].x + c[2].x) / 3;
    EXPECT_NEAR(pieces->parts[t], middle < 0.5 ? 0.5 : 0.125, 1e-4);
  }
  EXPECT_NEAR(pieces->worstPart, 0.0, 1e-9);
}

TEST(AlphaCut, SoftAlphaKeepsItsMean) {
  std::mt19937 random(8);
  for (int round = 0; round < 20; ++round) {
    const Coverage noise = randomTexture(random, 16, 16, false);
    const auto pieces = cut(square(1.0), noise, {}, 0, 100'000);
    ASSERT_TRUE(pieces);
    double sum = 0.0;
    for (std::size_t t = 0; t < pieces->triangles.size(); ++t) sum += pieces->parts[t] * areaOf(pieces->triangles[t]);
    EXPECT_NEAR(sum, noise.mean() / 65535, 1.0 / 500);
    EXPECT_LE(pieces->worstPart, 1.0 / 16);
  }
}

TEST(AlphaCut, EveryLevelDecidesByHalfItsCellsAndSaysHowFarItIsOff) {
  std::mt19937 random(3);
  const Coverage noise = randomTexture(random, 64, 64, true);
  const CutRule rule{.decides = true};
  for (std::size_t level = 0; level <= noise.levels(); ++level) {
    const auto pieces = cut(square(1.0), noise, rule, level, 100'000);
    ASSERT_TRUE(pieces);
    const double off = std::abs(areaOf(*pieces) - noise.mean() / 65535);
    EXPECT_LE(off, pieces->worstArea + 1e-3) << level;
    EXPECT_LT(off, level == 0 ? 1e-12 : 1.0);
  }
}

TEST(AlphaCut, LimitsHold) {
  std::mt19937 random(3);
  const Coverage noise = randomTexture(random, 512, 512, true);
  EXPECT_FALSE(cut(square(1.0), noise, {.decides = true}, 0, 1000));
  EXPECT_TRUE(cut(square(1.0), noise, {.decides = true}, noise.levels(), 2));
  std::size_t effort = 5000;
  EXPECT_FALSE(cutByCoverage(square(1.0), noise, {.decides = true}, 0, 1'000'000, effort));
  EXPECT_EQ(effort, 0u);
  EXPECT_TRUE(cutByCoverage(square(1.0), noise, {.decides = true}, noise.levels(), 1'000'000, effort));
  EXPECT_EQ(cellsToLookAt(square(1.0), noise, 0), 2.0 * 512 * 512);
  EXPECT_GT(cellsToLookAt(square(1e4), noise, 0), 1e12);
  EXPECT_EQ(cellsToLookAt(square(1e4), noise, noise.levels()), 0.0);
}

TEST(AlphaCut, PlacesThatAreNoneTakeTheMean) {
  const Coverage most = texture(2, 2, "###.");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  TexturedTriangle t = flat({Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)});
  std::vector<TexturedTriangle> bad;
  for (const double value : {kNan, kInf, -kInf, 1e300, -1e9}) {
    t.places[1].x = value;
    bad.push_back(t);
  }
  const auto pieces = cut(bad, most, {.decides = true}, 0, 100);
  ASSERT_TRUE(pieces);
  EXPECT_EQ(pieces->triangles.size(), bad.size());
  EXPECT_EQ(pieces->unplaced, bad.size());
  EXPECT_NEAR(pieces->worstArea, 0.25, 1e-4);
  // All corners in one place, or on a line, have what is there.
  const auto point =
      cut({flat({Vec2(0.75, 0.75), Vec2(0.75, 0.75), Vec2(0.75, 0.75)})}, most, {.decides = true}, 0, 100);
  ASSERT_TRUE(point);
  EXPECT_EQ(point->dropped, 1u);
  EXPECT_TRUE(cut({flat({Vec2(0, 0), Vec2(1, 1), Vec2(2, 2)})}, most, {.decides = true}, 0, 100));
}

TEST(AlphaCut, CornersStayTheirOwnBits) {
  const Coverage ring = texture(3, 3, "####.####");
  TexturedTriangle t;
  t.corners = {Vec3(0.1, 1e5, 0.3), Vec3(7.7, 1e5 + 0.1, 0.2), Vec3(0.3, 1e5 + 3.3, 9.9)};
  t.places = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  const auto pieces = cut({t}, ring, {.decides = true}, 0, 100);
  ASSERT_TRUE(pieces);
  for (const Vec3& corner : t.corners) {
    bool found = false;
    for (const auto& piece : pieces->triangles)
      for (const Vec3& p : piece) found = found || p == corner;
    EXPECT_TRUE(found);
  }
}

}  // namespace
}  // namespace umbrage::io::reader
