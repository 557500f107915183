#include "umbrage/radiosity/subdivision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/shapes.hpp"

namespace umbrage::radiosity {
namespace {

scene::Surfaces surfacesOf(std::vector<mesh::Mesh> meshes) { return scene::flatten(shapes::scene(std::move(meshes))); }

double totalArea(const Subdivision& mesh) {
  double sum = 0.0;
  for (const Face& f : faces(mesh)) {
    const Vec3 a = mesh.vertices()[f.corner[0]].position;
    sum += 0.5 * glm::length(
                     glm::cross(mesh.vertices()[f.corner[1]].position - a, mesh.vertices()[f.corner[2]].position - a));
  }
  return sum;
}

/// Every edge of every face once each way, but those on the border of the sheet.
std::size_t openEdges(const Subdivision& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Face& f : faces(mesh))
    for (std::size_t k = 0; k < 3; ++k) ++edges[{f.corner[k], f.corner[(k + 1) % 3]}];
  std::size_t open = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    open += !edges.contains({edge.second, edge.first});
  }
  return open;
}

TEST(Subdivision, TheFacesOfABoxAreSheets) {
  const auto surfaces = surfacesOf({shapes::box({0, 0, 0}, {1, 2, 3})});
  const Subdivision mesh(surfaces);
  EXPECT_EQ(mesh.sheets().size(), 6u);
  EXPECT_EQ(mesh.vertices().size(), 6 * 4 + 12u);  // four corners a sheet, a middle a triangle
}

// A wall upon the joint of two floors: light ends there.
TEST(Subdivision, SheetsEndWhereSomethingStandsUponThem) {
  const auto left = shapes::quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}),
             right = shapes::quad({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}),
             wall = shapes::quad({1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1});
  const auto open = surfacesOf({left, right}), parted = surfacesOf({left, right, wall});
  EXPECT_EQ(Subdivision(open).sheets().size(), 1u);
  EXPECT_EQ(Subdivision(parted).sheets().size(), 3u);
}

TEST(Subdivision, UnevenCutsLeaveNoGaps) {
  const auto surfaces = surfacesOf({shapes::quad({0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0})});
  Subdivision mesh(surfaces);
  // Towards one corner ever finer.
  const auto wanted = [&](const Element& e) {
    return mesh.longestEdge(e) > 0.02 + 0.3 * glm::length(mesh.vertices()[e.centre].position - Vec3(1, 1, 0));
  };
  mesh.splitWhile(0, wanted);
  mesh.splitWhile(1, wanted);
  EXPECT_GT(mesh.elements().size(), 500u);
  EXPECT_NEAR(totalArea(mesh), 12.0, 1e-12);
  std::size_t border = 0;
  for (const Face& f : faces(mesh))
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.vertices()[f.corner[k]].position, b = mesh.vertices()[f.corner[(k + 1) % 3]].position;
      for (int axis = 0; axis < 2; ++axis) border += a[axis] == b[axis] && (a[axis] == 0.0 || a[axis] == 4.0 - axis);
    }
  EXPECT_EQ(openEdges(mesh), border);
}

TEST(Subdivision, FindsTheLeafThatHoldsAPoint) {
  const auto surfaces = surfacesOf({shapes::triangle({0, 0, 0}, {5, 1, 0}, {1, 4, 2})});
  Subdivision mesh(surfaces);
  mesh.splitWhile(0, [&](const Element& e) { return mesh.longestEdge(e) > 0.4; });
  shapes::Random random(3);
  const auto at = mesh.corners(mesh.elements()[0]);
  for (int i = 0; i < 500; ++i) {
    double u = random.unit(), v = random.unit();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Vec3 parts(1.0 - u - v, u, v);
    const auto place = mesh.find(0, parts);
    ASSERT_TRUE(place);
    EXPECT_EQ(mesh.elements()[place->element].children, 0u);
    EXPECT_GE(std::min({place->parts.x, place->parts.y, place->parts.z}), -1e-12);
    const auto leaf = mesh.corners(mesh.elements()[place->element]);
    const Vec3 wanted = parts.x * at[0] + parts.y * at[1] + parts.z * at[2];
    const Vec3 found = place->parts.x * leaf[0] + place->parts.y * leaf[1] + place->parts.z * leaf[2];
    EXPECT_LT(glm::length(wanted - found), 1e-12);
  }
}

// What is linear over a sheet stays so, whatever hangs on its edges.
TEST(Subdivision, PlacesLieBetweenTheirVertices) {
  const auto surfaces = surfacesOf({shapes::quad({0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0})});
  Subdivision mesh(surfaces);
  for (const std::uint32_t root : {0u, 1u})
    mesh.splitWhile(root, [&](const Element& e) {
      return mesh.longestEdge(e) > 0.02 + 0.3 * glm::length(mesh.vertices()[e.centre].position - Vec3(1, 1, 0));
    });
  shapes::Random random(5);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    double u = random.unit(), v = random.unit();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const std::uint32_t t = i % 2;
    const Vec3 wanted = (1 - u - v) * surfaces.corner(t, 0) + u * surfaces.corner(t, 1) + v * surfaces.corner(t, 2);
    Vec3 found(0.0);
    double sum = 0.0;
    for (const Share& share : mesh.between(*mesh.find(t, {1 - u - v, u, v}))) {
      EXPECT_GE(share.part, -1e-12);
      found += share.part * mesh.vertices()[share.vertex].position;
      sum += share.part;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_LT(glm::length(found - wanted), 1e-12);
  }
}

TEST(Subdivision, WhatHasNoAreaAndWhatIsThereTwice) {
  const auto surfaces =
      surfacesOf({shapes::triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), shapes::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                  shapes::triangle({0, 1, 0}, {1, 0, 0}, {0, 0, 0})});
  const Subdivision mesh(surfaces);
  EXPECT_EQ(mesh.elements().size(), 1u);
  EXPECT_EQ(mesh.root(0), kNone);
  EXPECT_EQ(mesh.root(1), mesh.root(2));
  EXPECT_FALSE(mesh.find(0, Vec3(1, 0, 0)));
  EXPECT_TRUE(Subdivision(scene::Surfaces{}).vertices().empty());
}

}  // namespace
}  // namespace umbrage::radiosity
