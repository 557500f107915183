#include "umbrage/render/carry.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/finder_meshes.hpp"
#include "umbrage/shadow/volume.hpp"

namespace umbrage::render {
namespace {

// Each corner is what its index said: its position, or that position carried away.
TEST(CarryOnProcessor, SendsEveryVertexOnceAsTheVertexShaderWouldComputeIt) {
  const auto casters = shadow::test_meshes::boxy(600).casters();
  const Vec3 eye(3.1, -2.7, 1.9);
  for (const Vec4& light : {Vec4(0.3, -0.2, 0.9, 0.0), Vec4(0.1, 20.3, 9.7, 1.0)}) {
    const auto extruded = shadow::extrude(casters, shadow::findSilhouette(casters, light));
    LightVolume volume{.light = light};
    volume.indices = extruded.sides;
    volume.indices.insert(volume.indices.end(), extruded.caps.begin(), extruded.caps.end());
    volume.groups.push_back(
        {.failSides = {0, extruded.sides.size()}, .failCaps = {extruded.sides.size(), extruded.caps.size()}});
    const auto before = volume.indices;
    carryOnProcessor(casters, eye, volume);
    ASSERT_EQ(volume.indices.size(), before.size());
    EXPECT_EQ(volume.points.size(), std::set<std::uint32_t>(before.begin(), before.end()).size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vec3 p = casters.position(before[i] / 2);
      const Vec4 expected = before[i] % 2 == 0 ? Vec4(p - eye, 1.0) : Vec4(p * light.w - Vec3(light), 0.0);
      const Vec4f point = volume.points[volume.indices[i]];
      ASSERT_LT(glm::length(Vec4(point) - expected), 1e-5) << i;
    }
  }
}

TEST(CarryOnProcessor, TakesTheFarPointsThatAreGiven) {
  const auto casters = shadow::test_meshes::boxy(12).casters();
  LightVolume volume{.light = {0, 0, 1, 0}, .indices = {1, 3, 4}};
  volume.groups.push_back({.passSides = {0, 3}});
  for (std::size_t i = 0; i < casters.positions.size(); ++i) volume.farPoints.emplace_back(float(i), 2.0f, 3.0f, 1.0f);
  carryOnProcessor(casters, Vec3(0.0), volume);
  EXPECT_EQ(volume.points[volume.indices[0]], volume.farPoints[0]);
  EXPECT_EQ(volume.points[volume.indices[1]], volume.farPoints[1]);
  EXPECT_EQ(volume.points[volume.indices[2]], Vec4f(casters.positions[2], 1.0f));
}

}  // namespace
}  // namespace umbrage::render
