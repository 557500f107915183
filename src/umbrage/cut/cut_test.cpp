#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "support/oracle.hpp"
#include "support/shapes.hpp"
#include "umbrage/cut/light_cutter.hpp"
#include "umbrage/cut/lit_scene.hpp"
#include "umbrage/cut/pieces.hpp"

namespace umbrage::cut {
namespace {

using shapes::Random;

scene::Light sun(const Vec3& travels) { return {scene::DirectionalLight{travels}, Vec3(1.0), 1.0, ""}; }
scene::Light lamp(const Vec3& at) { return {scene::PointLight{at}, Vec3(1.0), 1.0, ""}; }
scene::Light spot(const Vec3& at, const Vec3& direction, double degrees) {
  return {scene::SpotLight{at, direction, Angle::degrees(degrees)}, Vec3(1.0), 1.0, ""};
}

mesh::Mesh flat(double x0, double y0, double x1, double y1, double z) {
  return shapes::quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
}

/// Every mesh has a material of its own; the first only receives.
struct Cutting {
  std::shared_ptr<const shadow::Geometry> geometry;
  scene::Scene scene;
  Pieces pieces;
  std::vector<Areas> areas;
};
Cutting cutAll(std::vector<mesh::Mesh> meshes, const std::vector<scene::Light>& lights, const Mat4& place = Mat4(1.0)) {
  Cutting c;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    meshes[i].materials.assign(meshes[i].triangles.size(), static_cast<std::uint32_t>(i));
  const std::size_t count = meshes.size();
  c.scene = shapes::scene(std::move(meshes), place);
  c.scene.materials.assign(count, {"grey", Vec3(0.8), 1.0});
  if (count > 0) c.scene.instances[0].casts = false;
  c.geometry = shadow::makeGeometry(c.scene);
  auto pieces = cutSurfaces(c.geometry, lights);
  EXPECT_TRUE(pieces.has_value());
  if (pieces) c.pieces = std::move(*pieces);
  c.areas = areasByMaterial(c.geometry->surfaces, count, c.pieces, lights.size());
  return c;
}

std::size_t piecesOf(const Cutting& c, std::uint32_t material) {
  std::size_t count = 0;
  for (const Piece& p : c.pieces.pieces) count += c.geometry->surfaces.materials[p.triangle] == material;
  return count;
}

// Every piece is convex, and the pieces of each triangle are as large together as it is.
void expectCovered(const Cutting& c) {
  const auto& s = c.geometry->surfaces;
  std::vector<double> area(s.triangles.size(), 0.0);
  for (const Piece& p : c.pieces.pieces) {
    area[p.triangle] += areaOf(c.pieces, p);
    const Vec3 normal = glm::normalize(s.normal(p.triangle));
    const std::uint32_t n = p.end - p.begin;
    ASSERT_GE(n, 3u);
    const auto at = [&](std::uint32_t i) { return c.pieces.corners[p.begin + i % n]; };
    for (std::uint32_t i = 0; i < n; ++i) {
      const Vec3 a = at(i + 1) - at(i), b = at(i + 2) - at(i + 1);
      EXPECT_GE(glm::dot(glm::cross(a, b), normal),
                -1e-9 * (glm::length(a) + glm::length(b)) * glm::length(s.bounds.size()));
    }
  }
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    const double whole = 0.5 * glm::length(s.normal(t));
    EXPECT_NEAR(area[t], whole, 1e-12 * whole + 1e-15 * glm::dot(s.bounds.size(), s.bounds.size()));
  }
}

// --- areas in closed form ------------------------------------------------------------------------------------------------------

TEST(Cut, ABoxOnTheGroundShadowsWhatItsHeightSays) {
  for (const Vec3& d : {Vec3(1, 0.3, -1), Vec3(-0.2, -1, -0.7), Vec3(1, 0, -1), Vec3(0, 0, -1)}) {
    const auto c = cutAll({flat(-20, -20, 20, 20, 0), shapes::box({-1, -2, 0}, {2, 1, 3})}, {sun(d)});
    const double along = std::abs(d.x / d.z) * 3, across = std::abs(d.y / d.z) * 3;
    EXPECT_NEAR(c.areas[0].lights[0].shadowed, 9 + 3 * along + 3 * across, 1e-9) << d.x << ' ' << d.y;
    EXPECT_NEAR(c.areas[0].lights[0].lit, 1600 - c.areas[0].lights[0].shadowed, 1e-9);
    // The roof, and the walls that face the sun; the floor is the ground's.
    EXPECT_NEAR(c.areas[1].lights[0].lit, 9 + 9 * (d.x != 0.0) + 9 * (d.y != 0.0), 1e-9);
    expectCovered(c);
  }
}

TEST(Cut, ShadowsFallOnWallsAndRoofsToo) {
  // Before a long wall stands a post of 1 x 1 and 3 high; its shadow climbs the wall up to 3 - 2 x 0.5, and the eaves' board shadows the roof below.
  const auto c = cutAll({flat(-20, -20, 20, 20, 0), shapes::box({-10, 0, 0}, {10, 5, 6}),
                         shapes::box({-1, -3, 0}, {0, -2, 3}), flat(-10, 0, 10, 1, 8)},
                        {sun({0, 1, -0.5})});
  EXPECT_NEAR(c.areas[1].lights[0].shadowed, 20 * 6 + 100 + 2 * 30 + 2.0 + 20.0,
              1e-9);  // back, floor, ends, the post's shadow, the board's
  EXPECT_NEAR(c.areas[1].lights[0].lit, 120 - 2.0 + 100 - 20.0, 1e-9);
  expectCovered(c);
}

TEST(Cut, ALampEnlargesASquareBySimilarTriangles) {
  for (const double height : {2.0, 5.0 - 0x1p-10, 0x1p-10}) {
    const auto c =
        cutAll({flat(-1e5, -1e5, 1e5, 1e5, 0), flat(-0.5, -0.5, 0.5, 0.5, height)}, {lamp({0.25, 0.125, 5})});
    const double scale = 5 / (5 - height);
    EXPECT_NEAR(c.areas[0].lights[0].shadowed / (scale * scale), 1.0, 1e-9) << height;
  }
}

TEST(Cut, ALampFarAwayIsASun) {
  const Vec3 towards(3, -2, 4);
  const std::vector<mesh::Mesh> meshes = {flat(-20, -20, 20, 20, 0), shapes::box({-1, -2, 0}, {2, 1, 3}),
                                          shapes::sphere({5, 5, 4}, 2, 12, 6)};
  const auto near = cutAll(meshes, {sun(-towards)});
  for (const double distance : {1e9, 1e12, 1e14}) {
    const auto far = cutAll(meshes, {lamp(distance * towards)});
    for (std::size_t m = 0; m < meshes.size(); ++m)
      EXPECT_NEAR(far.areas[m].lights[0].lit, near.areas[m].lights[0].lit, 1e-4 + 1e6 / distance) << distance;
  }
}

TEST(Cut, ASpotLightsACircle) {
  for (const double degrees : {10.0, 45.0, 80.0}) {
    const double radius = 3 * std::tan(degrees * std::numbers::pi / 180);
    const auto c = cutAll({flat(-20, -20, 20, 20, 0)}, {spot({0.5, 1, 3}, {0, 0, -1}, degrees)});
    EXPECT_NEAR(c.areas[0].lights[0].lit / (std::numbers::pi * radius * radius), 1.0, 2e-5);
    expectCovered(c);
  }
  const auto whole = cutAll({flat(-20, -20, 20, 20, 0)}, {spot({0.5, 1, 3}, {0, 0, 1}, 180)});
  EXPECT_EQ(whole.pieces.pieces.size(), 2u);
  EXPECT_NEAR(whole.areas[0].lights[0].lit, 1600, 1e-9);
}

TEST(Cut, ASpotsConeIsThatOfItsMask) {
  Random random(3);
  for (const double degrees : {1.0, 33.0, 90.0, 91.0, 135.0, 179.0}) {
    const auto light = spot({1, 2, 3}, {0.3, -0.5, -1}, degrees);
    const auto c = cutAll({flat(-20, -20, 20, 20, 0), shapes::box({3, 3, 1}, {4, 4, 2})}, {light});
    expectCovered(c);
    for (const Piece& p : c.pieces.pieces) {
      if (c.geometry->surfaces.casts[p.triangle] != 0) continue;
      Vec3 middle(0.0);
      for (auto i = p.begin; i < p.end; ++i) middle += c.pieces.corners[i] / double(p.end - p.begin);
      if (p.litBy != 0) {
        EXPECT_TRUE(scene::insideCone(light, middle)) << degrees;
      }
    }
  }
}

// A disc that a file's rounded matrices left 2.5e-6 radians out of the plane of the wall it touches (a windmill's tower): the wall is before half of it
// by less than single precision tells at that distance, and hides nothing. What stands on both shadows both.
TEST(Cut, NearlyCoplanarFacesHideNothingOfEachOther) {
  const double tilt = 2.5e-6;
  const auto disc = shapes::quad({-1, -1, 0.3 - tilt}, {1, -1, 0.3 - tilt}, {1, 1, 0.3 + tilt}, {-1, 1, 0.3 + tilt});
  const auto wall = shapes::quad({-1, -7, 0.3}, {1, -7, 0.3}, {1, 0, 0.3}, {-1, 0, 0.3});
  const scene::Light light = sun({0.4, 0.5, -1});
  const auto flush = cutAll({flat(-9, -9, 9, 9, -1), disc, wall}, {light});
  EXPECT_NEAR(flush.areas[1].lights[0].lit, 4.0, 1e-5);
  EXPECT_NEAR(flush.areas[2].lights[0].lit, 14.0, 1e-5);
  const auto post =
      cutAll({flat(-9, -9, 9, 9, -1), disc, wall, shapes::box({-0.5, -0.5, 0.3}, {-0.25, -0.25, 0.8})}, {light});
  // The post stands on both; its shadow on either is its foot and what its edges sweep.
  EXPECT_NEAR(post.areas[1].lights[0].shadowed, 0.0625 + 0.25 * 0.2 + 0.25 * 0.25, 1e-4);
}

// --- pieces ------------------------------------------------------------------------------------------------------------------------

TEST(Cut, WhatNoBorderCrossesStaysAsItIs) {
  const auto c = cutAll({flat(-20, -20, 20, 20, 0), shapes::box({-1, -2, 4}, {2, 1, 5})}, {sun({0.1, 0, -1})});
  const auto& s = c.geometry->surfaces;
  std::size_t whole = 0;
  for (const Piece& p : c.pieces.pieces) {
    if (s.casts[p.triangle] == 0) continue;
    ++whole;
    ASSERT_EQ(p.end - p.begin, 3u);
    for (std::uint32_t k = 0; k < 3; ++k)
      EXPECT_EQ(c.pieces.corners[p.begin + k], s.corner(p.triangle, static_cast<int>(k)));
  }
  EXPECT_EQ(whole, 12u);
}

TEST(Cut, EdgesInsideAShadowCutNothing) {
  const auto sheet = [](int cells) {
    return shapes::grid(cells, cells, false, false, [](double u, double v) { return Vec3(u, v, 2); });
  };
  const auto coarse = cutAll({flat(-4, -5, 6, 7, 0), sheet(1)}, {sun({0.1, 0.2, -1})});
  const auto fine = cutAll({flat(-4, -5, 6, 7, 0), sheet(32)}, {sun({0.1, 0.2, -1})});
  EXPECT_LE(piecesOf(coarse, 0), 12u);
  EXPECT_LE(piecesOf(fine, 0), 12u);
  EXPECT_NEAR(fine.areas[0].lights[0].shadowed, 1.0, 1e-12);
}

TEST(Cut, ScalesAndPlacesChangeNoShare) {
  const std::vector<mesh::Mesh> meshes = {flat(-20, -20, 20, 20, 0), shapes::knot({0, 0, 4}, 3, 0.5, 40, 8)};
  const double lit = cutAll(meshes, {sun({1, 0.3, -1})}).areas[0].lights[0].lit;
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    Mat4 place(scale);
    place[3] = Vec4(1000 * scale, -3000 * scale, 17 * scale, 1);
    const auto c = cutAll(meshes, {sun({1, 0.3, -1})}, place);
    EXPECT_NEAR(c.areas[0].lights[0].lit / (scale * scale * lit), 1.0, 1e-3) << scale;
    expectCovered(c);
  }
}

TEST(Cut, SeveralLightsAreToldApart) {
  const std::vector<scene::Light> lights = {sun({1, 0.3, -1}), lamp({1, 1, 6}), spot({-4, -4, 7}, {0.5, 0.5, -1}, 30)};
  const auto c = cutAll(
      {flat(-10, -10, 10, 10, 0), shapes::box({-1, -2, 0.5}, {2, 1, 3}), shapes::sphere({4, 3, 2}, 1, 10, 6)}, lights);
  expectCovered(c);
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const auto alone =
        cutAll({flat(-10, -10, 10, 10, 0), shapes::box({-1, -2, 0.5}, {2, 1, 3}), shapes::sphere({4, 3, 2}, 1, 10, 6)},
               {lights[k]});
    for (std::size_t m = 0; m < 3; ++m) EXPECT_NEAR(c.areas[m].lights[k].lit, alone.areas[m].lights[0].lit, 1e-9);
  }
}

TEST(Cut, NothingIsNothing) {
  EXPECT_TRUE(cutAll({}, {sun({0, 0, -1})}).pieces.pieces.empty());
  const auto dark = cutAll({flat(0, 0, 1, 1, 0)}, {});
  EXPECT_EQ(dark.pieces.pieces.size(), 2u);
  // Without area, and with the light in its plane.
  const auto thin = cutAll(
      {flat(0, 0, 1, 1, 0), shapes::triangle({0, 0, 1}, {1, 1, 1}, {2, 2, 1}), flat(0, 0, 1, 1, 1)}, {sun({1, 0, 0})});
  for (const Piece& p : thin.pieces.pieces) EXPECT_EQ(p.litBy, 0u);
  EXPECT_EQ(piecesOf(thin, 1), 0u);
}

// --- bounds ------------------------------------------------------------------------------------------------------------------------

// Two combs whose shadows cross each other everywhere: as many pieces as the square of their teeth.
std::vector<mesh::Mesh> combs(int teeth) {
  mesh::Mesh m{"combs", {}, {}, {}};
  for (int i = 0; i < teeth; ++i) {
    const double at = i / double(teeth), width = 0.4 / teeth;
    for (const bool turned : {false, true}) {
      const auto base = static_cast<std::uint32_t>(m.positions.size());
      for (const auto& [x, y] : {std::pair(at, 0.0), std::pair(at + width, 0.0), std::pair(at, 1.0)})
        m.positions.push_back(turned ? Vec3(y, x, 2) : Vec3(x, y, 1));
      m.triangles.push_back({base, base + 1, base + 2});
    }
  }
  return {flat(-1, -1, 2, 2, 0), m};
}

TEST(Cut, TooMuchIsAnErrorAndNoFlood) {
  auto s = shapes::scene(combs(300));
  s.instances[0].casts = false;
  const auto geometry = shadow::makeGeometry(s);
  const scene::Light light = sun({0, 0, -1});
  auto cut = cutSurfaces(geometry, {&light, 1}, {}, Effort::Limits{1 << 30, 2000});
  ASSERT_FALSE(cut.has_value());
  EXPECT_EQ(cut.error().code, ErrorCode::input);
  cut = cutSurfaces(geometry, {&light, 1}, {}, Effort::Limits{10000, 1 << 30});
  ASSERT_FALSE(cut.has_value());
  EXPECT_EQ(cut.error().code, ErrorCode::input);
}

TEST(Cut, CrossingCombsComeOutRight) {
  const auto c = cutAll(combs(24), {sun({0, 0, -1})});
  // 24 triangles of 0.4 / 24 / 2 each way; where two cross is counted by points.
  const auto& s = c.geometry->surfaces;
  Effort effort(Effort::usual(s.triangles.size()));
  const LightCutter cutter(c.geometry, sun({0, 0, -1}), ConeSides::none);
  const oracle::Oracle bruteForce(s);
  Random random(7);
  std::size_t dark = 0;
  for (std::uint32_t t = 0; t < 2; ++t) {
    if (s.casts[t] != 0) continue;
    const auto face = cutter.cut(t, effort);
    ASSERT_TRUE(face);
    for (int i = 0; i < 2000; ++i) {
      double u = random.unit(), v = random.unit();
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const Vec3 a = s.corner(t, 0), p = a + u * (s.corner(t, 1) - a) + v * (s.corner(t, 2) - a);
      const auto answer = bruteForce.hidden(p, {0, 0, 1}, false);
      if (answer == oracle::Answer::unclear) continue;
      dark += answer == oracle::Answer::yes;
      EXPECT_EQ(face->isLit(p), answer == oracle::Answer::no) << p.x << ' ' << p.y;
    }
  }
  EXPECT_GT(dark, 20u);
}

TEST(Cut, StopsWhenAskedTo) {
  auto s = shapes::scene(combs(4));
  const scene::Light light = sun({0, 0, -1});
  const auto cut = cutSurfaces(shadow::makeGeometry(s), {&light, 1}, [](double, std::string_view) { return false; });
  ASSERT_FALSE(cut.has_value());
  EXPECT_EQ(cut.error().code, ErrorCode::cancelled);
}

// --- the scene that is written ---------------------------------------------------------------------------------------------------------

TEST(LitScene, KeepsPartsAndNamesWhatReachesThem) {
  const std::vector<scene::Light> lights = {sun({0.4, 0.3, -1}), sun({-0.4, 0.3, -1})};
  auto c = cutAll({flat(-10, -10, 10, 10, 0), shapes::box({-1, -1, 0}, {1, 1, 3})}, lights);
  c.scene.instances[0].name = "Site/Lawn", c.scene.instances[1].name = "House";
  c.scene.materials[0] = {"grass", Vec3(0.2, 0.5, 0.2), 1.0},
  c.scene.materials[1] = {"brick", Vec3(0.6, 0.3, 0.2), 0.5};
  const auto lit = litScene(c.scene, c.geometry->surfaces, c.pieces, lights.size(), 0.25);
  EXPECT_FALSE(scene::findFault(lit).has_value());
  std::set<std::string> names, materials;
  for (const auto& i : lit.instances) names.insert(i.name);
  for (const auto& m : lit.materials) materials.insert(m.name);
  EXPECT_EQ(names, (std::set<std::string>{"Site/Lawn/lit", "Site/Lawn/lit 1", "Site/Lawn/lit 2", "Site/Lawn/shadow",
                                          "House/lit", "House/lit 1", "House/lit 2", "House/shadow"}));
  EXPECT_EQ(materials, (std::set<std::string>{"grass lit", "grass lit 1", "grass lit 2", "grass shadow", "brick lit",
                                              "brick lit 1", "brick lit 2", "brick shadow"}));
  double area = 0.0;
  for (const auto& i : lit.instances)
    for (const auto& t : lit.meshes[i.mesh]->triangles) {
      const auto& p = lit.meshes[i.mesh]->positions;
      area += 0.5 * glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
    }
  EXPECT_NEAR(area, sum(c.areas).surface, 1e-9 * area);
  EXPECT_FALSE(lit.instances[0].casts);
  for (const auto& m : lit.materials) {
    if (m.name == "grass shadow") {
      EXPECT_NEAR(m.colour.g, 0.125, 1e-12);
    }
    if (m.name == "brick lit") {
      EXPECT_EQ(m.colour, Vec3(0.6, 0.3, 0.2));
    }
    if (m.name == "brick lit 2") {
      EXPECT_NEAR(m.colour.r, 0.6 * 0.625, 1e-12);
    }
  }
}

}  // namespace
}  // namespace umbrage::cut
