#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "support/box_scene.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::shadow {
namespace {

/// Boxes and a soup of triangles, every instance at a pose of its own.
scene::Scene sceneOf(std::mt19937& random) {
  const auto real = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  scene::Scene s =
      support::boxScene({{"a", Vec3(0), Vec3(1)}, {"b", Vec3(2, 0, 0), Vec3(3, 1, 2)}, {"c", Vec3(-1), Vec3(0, 0, 4)}});
  auto soup = std::make_shared<mesh::Mesh>();
  for (int i = 0; i < 60; ++i) soup->positions.push_back({real(-2, 2), real(-2, 2), real(-2, 2)});
  for (std::uint32_t i = 0; i + 3 <= 60; i += 2) soup->triangles.push_back({i, i + 1, i + 2});
  s.instances.push_back({"soup", 3, Mat4(1.0), true});
  s.instances.push_back({"receiver", 3, glm::translate(Mat4(1.0), Vec3(9, 0, 0)), false});
  s.meshes.push_back(soup);
  return s;
}

void move(scene::Scene& s, std::mt19937& random) {
  const auto real = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (scene::Instance& instance : s.instances) {
    if (real(0, 1) < 0.4) continue;
    const Mat4 turn = glm::rotate(Mat4(1.0), real(0, 6), glm::normalize(Vec3(real(-1, 1), real(-1, 1), 0.5)));
    const double mirror = real(0, 1) < 0.2 ? -1.0 : 1.0;
    instance.toWorld = glm::translate(Mat4(1.0), Vec3(real(-9, 9), real(-9, 9), real(-9, 9))) * turn *
                       glm::scale(Mat4(1.0), Vec3(mirror, 1.0, real(0.5, 2)));
  }
}

void expectSame(const scene::Surfaces& a, const scene::Surfaces& b) {
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.instances, b.instances);
  EXPECT_EQ(a.casts, b.casts);
  EXPECT_EQ(a.bounds.min, b.bounds.min);
  EXPECT_EQ(a.bounds.max, b.bounds.max);
  EXPECT_EQ(a.casterBounds.min, b.casterBounds.min);
  EXPECT_EQ(a.casterBounds.max, b.casterBounds.max);
}

void expectSame(const CasterSet& a, const CasterSet& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.surfaceTriangle, b.surfaceTriangle);
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (std::size_t e = 0; e < a.edges.size(); ++e) {
    EXPECT_EQ(a.edges[e].a, b.edges[e].a);
    EXPECT_EQ(a.edges[e].b, b.edges[e].b);
    EXPECT_EQ(a.edges[e].begin, b.edges[e].begin);
    EXPECT_EQ(a.edges[e].end, b.edges[e].end);
  }
  ASSERT_EQ(a.uses.size(), b.uses.size());
  for (std::size_t u = 0; u < a.uses.size(); ++u) {
    EXPECT_EQ(a.uses[u].triangle, b.uses[u].triangle);
    EXPECT_EQ(a.uses[u].sign, b.uses[u].sign);
  }
  EXPECT_EQ(a.componentOf, b.componentOf);
  EXPECT_EQ(a.componentOfPosition, b.componentOfPosition);
  EXPECT_EQ(a.outward, b.outward);
  EXPECT_EQ(a.bounds.min, b.bounds.min);
  EXPECT_EQ(a.bounds.max, b.bounds.max);
}

TEST(Moved, SurfacesAndCastersAreThoseOfTheWholeWorkBitByBit) {
  std::mt19937 random(3);
  for (int round = 0; round < 30; ++round) {
    scene::Scene s = sceneOf(random);
    move(s, random);
    scene::Welding welding;
    scene::Surfaces surfaces = scene::flatten(s, welding);
    CasterSet casters = buildCasters(surfaces);
    for (int step = 0; step < 4; ++step) {
      move(s, random);
      const auto moved = scene::flattenMoved(s, surfaces, welding);
      ASSERT_TRUE(moved);
      casters = moveCasters(*moved, std::move(casters));
      surfaces = *moved;
      expectSame(surfaces, scene::flatten(s));
      expectSame(casters, buildCasters(surfaces));
    }
  }
}

TEST(Moved, PointsThatMeetOrPartAreToldApart) {
  scene::Scene s = support::boxScene({{"a", Vec3(0), Vec3(1)}, {"b", Vec3(0), Vec3(1)}});
  s.instances[1].toWorld = glm::translate(Mat4(1.0), Vec3(3, 0, 0));
  scene::Welding welding;
  const auto apart = scene::flatten(s, welding);
  s.instances[1].toWorld = glm::translate(Mat4(1.0), Vec3(1, 0, 0));  // the boxes share a face now
  EXPECT_FALSE(scene::flattenMoved(s, apart, welding));
  const auto together = scene::flatten(s, welding);
  EXPECT_LT(together.positions.size(), apart.positions.size());
  s.instances[1].toWorld = glm::translate(Mat4(1.0), Vec3(2, 0, 0));
  EXPECT_FALSE(scene::flattenMoved(s, together, welding));
}

}  // namespace
}  // namespace umbrage::shadow
