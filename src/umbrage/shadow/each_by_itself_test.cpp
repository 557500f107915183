#include "umbrage/shadow/each_by_itself.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/finder_meshes.hpp"
#include "umbrage/shadow/volume.hpp"

namespace umbrage::shadow {
namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;

std::map<Ends, int> sums(const std::vector<SilhouetteEdge>& edges, int sign = 1) {
  std::map<Ends, int> out;
  for (const SilhouetteEdge& e : edges) out[{e.a, e.b}] += sign * e.multiplicity;
  std::erase_if(out, [](const auto& row) { return row.second == 0; });
  return out;
}

// On lattices, where triangles coincide, edges have many triangles and lights lie in planes.
TEST(EachByItself, SumsUpToTheSilhouette) {
  std::size_t edges = 0, more = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    test_meshes::Random random(seed);
    const auto mesh = test_meshes::latticeSoup(random);
    const CasterSet casters = mesh.casters();
    const Vec4 light = test_meshes::latticeLight(random, mesh);
    const Silhouette silhouette = findSilhouette(casters, light);
    const Silhouette all = eachByItself(casters, light);
    ASSERT_EQ(all.side, silhouette.side);
    ASSERT_EQ(sums(all.edges), sums(silhouette.edges)) << seed;
    edges += silhouette.edges.size(), more += all.edges.size() - silhouette.edges.size();
  }
  EXPECT_GT(edges, 1000u);
  EXPECT_GT(more, 1000u);
}

TEST(EachByItself, HasThreeEdgesForEveryTriangleThatCounts) {
  test_meshes::Random random(5);
  const auto mesh = test_meshes::latticeSoup(random);
  const CasterSet casters = mesh.casters();
  const Silhouette all = eachByItself(casters, {0.3, 0.2, 1.0, 0.0});
  const auto counted = std::count_if(all.side.begin(), all.side.end(), [](int s) { return s != 0; });
  EXPECT_EQ(all.edges.size(), 3u * static_cast<std::size_t>(counted));
  EXPECT_EQ(all.edges.size() % 3, 0u);
}

TEST(EachByItself, SidesOfBothWindingsHaveTheSameCornersInTheSameOrder) {
  const CasterSet casters = buildCasters(std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                                         std::vector<mesh::Triangle>{{0, 1, 2}, {1, 3, 2}});
  const Silhouette all = eachByItself(casters, {0.1, 0.2, 3.0, 1.0});
  ASSERT_EQ(all.edges.size(), 6u);
  const auto [straight, turned] = byWinding(all);
  EXPECT_EQ(straight.edges.size() + turned.edges.size(), 6u);
  // The diagonal is a side of both triangles.
  const auto sideOf = [&](const Silhouette& half) {
    Silhouette one = half;
    std::erase_if(one.edges, [&](const SilhouetteEdge& e) {
      return casters.position(e.a).x + casters.position(e.b).x != 1.0 ||
             casters.position(e.a).y + casters.position(e.b).y != 1.0;
    });
    EXPECT_EQ(one.edges.size(), 1u);
    return extrude(casters, one, {.caps = false}).sides;
  };
  EXPECT_EQ(sideOf(straight), sideOf(turned));
}

}  // namespace
}  // namespace umbrage::shadow
