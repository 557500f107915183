#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "umbrage/mesh/edge_table.hpp"
#include "umbrage/mesh/mesh_report.hpp"
#include "umbrage/mesh/weld.hpp"

namespace umbrage::mesh {
namespace {

const std::vector<Triangle> kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

MeshReport reportOf(const std::vector<Triangle>& triangles) { return inspect(triangles, buildEdgeTable(triangles)); }

TEST(Weld, JoinsIdenticalPositionsOnly) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {1e-300, 0, 0}};
  const Weld w = weld(std::span<const Vec3>(points));
  EXPECT_EQ(w.remap, (std::vector<std::uint32_t>{0, 1, 0, 2}));
  EXPECT_EQ(w.first, (std::vector<std::uint32_t>{0, 1, 3}));
  EXPECT_TRUE(weld(std::span<const Vec3>()).remap.empty());
}

RC_GTEST_PROP(Weld, KeepsEveryPositionAndNoneTwice, ()) {
  const auto coordinate = rc::gen::inRange(-2, 3);
  std::vector<Vec3f> points(*rc::gen::inRange<std::size_t>(0, 60));
  for (Vec3f& p : points) p = {float(*coordinate), float(*coordinate), float(*coordinate)};
  const Weld w = weld(std::span<const Vec3f>(points));
  std::set<std::array<float, 3>> distinct;
  for (std::size_t i = 0; i < points.size(); ++i) {
    RC_ASSERT(points[w.first[w.remap[i]]] == points[i]);
    distinct.insert({points[i].x, points[i].y, points[i].z});
  }
  RC_ASSERT(distinct.size() == w.first.size());
}

TEST(MeshReport, TellsTheTopologiesApart) {
  EXPECT_EQ(reportOf({}).topology, Topology::empty);
  EXPECT_EQ(reportOf(kTetrahedron).topology, Topology::closed);
  EXPECT_EQ(reportOf(kTetrahedron).windingFlips, 0u);
  auto open = kTetrahedron;
  open.pop_back();
  EXPECT_EQ(reportOf(open).topology, Topology::open);
  EXPECT_EQ(reportOf(open).borderEdges, 3u);
  auto fin = kTetrahedron;
  fin.push_back({0, 1, 4});
  EXPECT_EQ(reportOf(fin).topology, Topology::nonManifold);
  EXPECT_EQ(reportOf(fin).nonManifoldEdges, 1u);
  auto flipped = kTetrahedron;
  std::swap(flipped[0][0], flipped[0][1]);
  EXPECT_EQ(reportOf(flipped).windingFlips, 3u);
}

TEST(Components, AreNumberedByFirstOccurrence) {
  const Components c = connectedComponents(std::vector<Triangle>{{5, 6, 7}, {0, 1, 2}, {7, 8, 9}, {2, 3, 4}});
  EXPECT_EQ(c.count, 2u);
  EXPECT_EQ(c.ofTriangle, (std::vector<std::uint32_t>{0, 1, 0, 1}));
}

RC_GTEST_PROP(EdgeTable, HoldsEveryProperEdgeOfEveryTriangle, ()) {
  const auto corner = rc::gen::inRange<std::uint32_t>(0, 6);
  std::vector<Triangle> triangles(*rc::gen::inRange<std::size_t>(0, 30));
  std::map<std::array<std::uint32_t, 2>, std::size_t> expected;
  for (Triangle& t : triangles) {
    t = {*corner, *corner, *corner};
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[(k + 1) % 3], t[(k + 2) % 3]);
      if (low != high) ++expected[{low, high}];
    }
  }
  const EdgeTable table = buildEdgeTable(triangles);
  RC_ASSERT(table.size() == expected.size());
  for (std::size_t e = 0; e < table.size(); ++e) {
    RC_ASSERT(expected[table.ends[e]] == table.usesOf(e).size());
    for (const EdgeUse& use : table.usesOf(e)) {
      const Triangle& t = triangles[use.triangle];
      const auto [low, high] = std::minmax(t[(use.opposite + 1) % 3], t[(use.opposite + 2) % 3]);
      RC_ASSERT(low == table.ends[e][0] && high == table.ends[e][1]);
    }
  }
}

}  // namespace
}  // namespace umbrage::mesh
