#include <gtest/gtest.h>

#include <cstdio>

#include "conformance/judge.hpp"
#include "support/oracle.hpp"
#include "support/shapes.hpp"

namespace umbrage::conformance {
namespace {

class Conformance : public testing::TestWithParam<std::string> {};

void judgeTechnique(const shadow::TechniqueEntry& entry, const Case& c,
                    const std::shared_ptr<const shadow::Geometry>& geometry) {
  auto judge = Judge::make(entry, geometry);
  if (!judge) {
    ASSERT_EQ(judge.error().code, ErrorCode::device) << judge.error().text();
    std::printf("%-12s cannot run here: %s\n", entry.traits.name.c_str(), judge.error().text().c_str());
    return;
  }
  Tally tally;
  for (const NamedView& view : c.views) {
    const auto verdicts = judge->judge(view, c.lights);
    ASSERT_TRUE(verdicts.has_value()) << entry.traits.name << ", " << view.name << ": " << verdicts.error().text();
    for (const Verdict& v : *verdicts) {
      tally.add(v);
      EXPECT_EQ(v.difference.farFromEdge, 0u) << v.technique << ", view " << v.view << ", light " << v.light << ": "
                                              << v.difference.differing << " pixels differ";
    }
  }
  std::printf("%-12s %-24s %4zu masks %8zu covered %6zu differing %4zu far\n", entry.traits.name.c_str(),
              c.name.c_str(), tally.masks, tally.covered, tally.differing, tally.far);
}

TEST_P(Conformance, NoPixelDiffersFarFromATrueEdge) {
  const Case c = makeCase(GetParam());
  const auto geometry = shadow::makeGeometry(c.scene);
  for (const shadow::TechniqueEntry& entry : allTechniques()) {
    if (entry.traits.needsClosed && geometry->casters.report.topology != mesh::Topology::closed) continue;
    judgeTechnique(entry, c, geometry);
  }
}

class ConformanceOfWays : public testing::TestWithParam<std::string> {};

// Every ninth view; others for each scene.
TEST_P(ConformanceOfWays, NoPixelDiffersFarFromATrueEdge) {
  Case c = makeCase(GetParam());
  const auto geometry = shadow::makeGeometry(c.scene);
  std::size_t place = c.name.size();
  std::erase_if(c.views, [&](const NamedView&) { return place++ % 9 != 0; });
  for (const shadow::TechniqueEntry& entry : askedWays()) judgeTechnique(entry, c, geometry);
}

// A face is seen edge-on from its own plane; single precision would tilt what is drawn of it (its cap) into view, and half the picture would change
// sides.
TEST(ConformanceOfEyes, InFacesOfCasters) {
  Case c = makeCase("box");
  const auto geometry = shadow::makeGeometry(c.scene);
  const shadow::CasterSet& casters = geometry->casters;
  c.views.clear();
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
    const Vec3 a = casters.corner(t, 0), u = casters.corner(t, 1) - a, v = casters.corner(t, 2) - a;
    const Vec3 eye = a + 0.375 * u + 0.25 * v + geometry->surfaces.origin, normal = glm::cross(u, v);
    const double size = glm::length(u) / glm::length(normal);
    c.views.push_back(
        {"face " + std::to_string(t), looking(eye, eye + u - 0.5 * v + 0.4 * size * normal, 70, 120, 90)});
  }
  for (const shadow::TechniqueEntry& entry : allTechniques()) judgeTechnique(entry, c, geometry);
  for (const shadow::TechniqueEntry& entry : askedWays()) judgeTechnique(entry, c, geometry);
}

// Two sheets, one over the other.
scene::Scene sheets() {
  mesh::Mesh m;
  for (const double z : {2.0, 1.0})
    for (const Vec2& at : {Vec2(-3, -2), Vec2(3, -2), Vec2(3, 2), Vec2(-3, 2)}) m.positions.emplace_back(at.x, at.y, z);
  m.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  scene::Scene s;
  s.materials.emplace_back();
  s.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  s.instances.push_back({.name = "sheets"});
  return s;
}

// The plane across the view then holds an edge that the eye lies on: the picture of its triangle has no extent at all.
TEST(ConformanceOfEyes, OnEdgesOfCastersAcrossTheView) {
  for (const bool isSolid : {true, false}) {
    Case c = makeCase("box");
    if (!isSolid) c.scene = scene::withGround(sheets(), 0.0);
    const auto geometry = shadow::makeGeometry(c.scene);
    const shadow::CasterSet& casters = geometry->casters;
    c.views.clear();
    for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
      for (unsigned k = 0; k < 3; ++k) {
        const Vec3 a = casters.corner(t, k), b = casters.corner(t, (k + 1) % 3), third = casters.corner(t, (k + 2) % 3);
        const Vec3 eye = 0.625 * a + 0.375 * b + geometry->surfaces.origin;
        const Vec3 along = glm::normalize(glm::cross(glm::cross(b - a, third - a), b - a));
        c.views.push_back(
            {"edge " + std::to_string(3 * t + k), looking(eye, eye + (t % 2 == 0 ? 1.0 : -1.0) * along, 70, 80, 60)});
      }
    for (const shadow::TechniqueEntry& entry : allTechniques()) judgeTechnique(entry, c, geometry);
  }
}

// Sixteen pixels of every view and light, those on which brute force is sure.
TEST_P(Conformance, TheTruthAgreesWithBruteForce) {
  const Case c = makeCase(GetParam());
  const auto geometry = shadow::makeGeometry(c.scene);
  const oracle::Oracle bruteForce(geometry->surfaces);
  const auto truth = allTechniques().front().create();
  ASSERT_TRUE(truth && (*truth)->prepare(geometry));
  shapes::Random random(1);
  std::size_t clear = 0;
  for (const NamedView& view : c.views) {
    for (const NamedLight& light : c.lights) {
      const auto shading = (*truth)->shade({view.camera, {&light.light, 1}});
      ASSERT_TRUE(shading.has_value());
      const shadow::LightMask& mask = shading->masks.front();
      for (int i = 0; i < 16; ++i) {
        const int x = random.whole(0, view.camera.width - 1), y = random.whole(0, view.camera.height - 1);
        const oracle::Pixel pixel = bruteForce.look(view.camera, light.light, x + 0.5, y + 0.5);
        clear += pixel.clear;
        const bool same = (mask.covered(x, y) != 0) == pixel.covered && (mask.light(x, y) == 255) == pixel.lit;
        if (!pixel.clear || same || oracle::onEdge(bruteForce, view.camera, light.light, x, y, pixel)) continue;
        ADD_FAILURE() << "view " << view.name << ", light " << light.name << ", pixel " << x << ' ' << y
                      << ": should be " << (pixel.covered ? "" : "un") << "covered and "
                      << (pixel.lit ? "lit" : "dark");
      }
    }
  }
  EXPECT_GT(clear, 8 * c.views.size() * c.lights.size());
}

INSTANTIATE_TEST_SUITE_P(Scenes, ConformanceOfWays, testing::ValuesIn(sceneNames()),
                         [](const testing::TestParamInfo<std::string>& row) { return row.param; });

INSTANTIATE_TEST_SUITE_P(Scenes, Conformance, testing::ValuesIn(sceneNames()),
                         [](const testing::TestParamInfo<std::string>& row) { return row.param; });

}  // namespace
}  // namespace umbrage::conformance
