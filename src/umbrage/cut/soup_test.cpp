// Random soups on a small lattice, where everything degenerate is common: coplanar and duplicate triangles, shared edges, triangles that cross, lights in
// corners and in planes.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/oracle.hpp"
#include "support/shapes.hpp"
#include "umbrage/cut/light_cutter.hpp"
#include "umbrage/cut/pieces.hpp"
#include "umbrage/shadow/facing.hpp"

namespace umbrage::cut {
namespace {

using shapes::Random;

int soupCount() {
  const char* asked = std::getenv("UMBRAGE_TEST_MESHES");
  return asked != nullptr ? std::atoi(asked) : 10000;
}

// Some triangles that cast and some that only receive; of the corners some are taken again, and some triangles whole.
scene::Scene soup(Random& random) {
  const int size = random.whole(1, 4);
  const auto corner = [&](Random& r) { return r.latticePoint(0, size); };
  std::vector<mesh::Mesh> meshes;
  for (int part = 0; part < 2; ++part) {
    mesh::Mesh m{"soup", {}, {}, {}};
    const int count = random.whole(1, part == 0 ? 12 : 4);
    for (int i = 0; i < count; ++i) {
      const auto base = static_cast<std::uint32_t>(m.positions.size());
      const bool sharesEdge = base > 0 && random.whole(0, 2) == 0;
      for (int k = 0; k < 3; ++k)
        m.positions.push_back(sharesEdge && k > 0 ? m.positions[base - static_cast<std::uint32_t>(k)] : corner(random));
      if (base > 0 && random.whole(0, 5) == 0)
        for (std::uint32_t k = 0; k < 3; ++k) m.positions[base + k] = m.positions[base - 3 + k];
      m.triangles.push_back({base, base + 1, base + 2});
    }
    meshes.push_back(std::move(m));
  }
  auto s = shapes::scene(std::move(meshes));
  s.instances[1].casts = false;
  return s;
}

scene::Light light(Random& random) {
  const auto whole = [&] { return Vec3(random.whole(-2, 2), random.whole(-2, 2), random.whole(-2, 2)); };
  switch (random.whole(0, 3)) {
    case 0: return {scene::PointLight{random.latticePoint(-1, 5)}, Vec3(1.0), 1.0, ""};
    case 1: return {scene::PointLight{random.point({Vec3(-1.0), Vec3(6.0)})}, Vec3(1.0), 1.0, ""};
    case 2:
      return {scene::DirectionalLight{whole() + Vec3(0, 0, random.whole(0, 1) != 0 ? -3 : 3)}, Vec3(1.0), 1.0, ""};
    default: return {scene::DirectionalLight{random.point({Vec3(-1.0), Vec3(1.0)})}, Vec3(1.0), 1.0, ""};
  }
}

// Whether a caster lies between a point and the light, asked one by one. Those whose plane holds the light hide nothing, by definition.
oracle::Answer hidden(const scene::Surfaces& s, const Vec3& point, const Vec4& light) {
  oracle::Answer answer = oracle::Answer::no;
  const double touching = 1e-10 * s.bounds.radius() / glm::length(scene::towardsLight(light, point));
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    const Vec3 a = s.corner(t, 0), b = s.corner(t, 1), c = s.corner(t, 2);
    if (s.casts[t] == 0 || lightSide(a, b, c, light) == 0) continue;
    const auto hit = oracle::meet(point, scene::towardsLight(light, point), a, b, c, 1e-7);
    if (hit.answer == oracle::Answer::no || hit.t <= touching || (light.w != 0.0 && hit.t >= 1.0 - 1e-12)) continue;
    if (hit.answer == oracle::Answer::yes) return hit.answer;
    answer = oracle::Answer::unclear;
  }
  return answer;
}

/// What was seen over many soups.
struct Seen {
  std::size_t cut = 0, lit = 0, dark = 0;
};

// The light at random points of all triangles, against every caster asked by itself.
void comparePoints(const shadow::Geometry& g, const LightCutter& cutter, const Vec4& towards, Random& random,
                   Seen& seen) {
  Effort effort(Effort::usual(g.surfaces.triangles.size()));
  for (std::uint32_t t = 0; t < g.surfaces.triangles.size(); ++t) {
    if (g.surfaces.normal(t) == Vec3(0.0)) continue;
    const auto cut = cutter.cut(t, effort);
    ASSERT_TRUE(cut);
    seen.cut += !cut->nodes().empty();
    const bool faces = shadow::visibleSideFacesLight(g.surfaces, t, towards, towards);
    for (int i = 0; i < 12; ++i) {
      double u = random.unit(), v = random.unit();
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const Vec3 a = g.surfaces.corner(t, 0);
      const Vec3 p = a + u * (g.surfaces.corner(t, 1) - a) + v * (g.surfaces.corner(t, 2) - a);
      const auto answer = hidden(g.surfaces, p, towards);
      if (answer == oracle::Answer::unclear) continue;
      const bool lit = faces && answer == oracle::Answer::no;
      ++(lit ? seen.lit : seen.dark);
      EXPECT_EQ(cut->isLit(p), lit) << "triangle " << t << ", point " << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

TEST(LatticeSoups, AreLitAndDarkAsBruteForceSays) {
  Seen seen;
  const int count = soupCount();
  double worst = 0.0;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("soup " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i) + 1);
    const auto s = soup(random);
    const auto geometry = shadow::makeGeometry(s);
    scene::Light lamp = light(random);
    // In a corner of a triangle, and in its plane.
    if (!geometry->surfaces.triangles.empty() && random.whole(0, 4) == 0) {
      const Vec3 a = geometry->surfaces.corner(0, 0), b = geometry->surfaces.corner(0, 1);
      lamp.shape = scene::PointLight{random.whole(0, 1) != 0 ? a : 2.0 * b - a};
    }
    if (!scene::isValid(lamp)) continue;
    const Vec4 towards = scene::homogeneous(lamp, geometry->surfaces.origin);
    comparePoints(*geometry, LightCutter(geometry, lamp, ConeSides::none), towards, random, seen);
    const auto pieces = cutSurfaces(geometry, {&lamp, 1});
    ASSERT_TRUE(pieces);
    const Areas areas = sum(areasByMaterial(geometry->surfaces, s.materials.size(), *pieces, 1));
    const double error = std::abs(areas.lights[0].lit + areas.lights[0].shadowed - areas.surface);
    EXPECT_LE(error, 1e-9 * areas.surface);
    if (areas.surface > 0.0) worst = std::max(worst, error / areas.surface);
  }
  std::printf("%d soups: %zu triangles cut, %zu points lit, %zu dark; areas off by %.1e of their sum at most\n", count,
              seen.cut, seen.lit, seen.dark, worst);
  EXPECT_GT(seen.cut, static_cast<std::size_t>(count));
  EXPECT_GT(seen.lit, static_cast<std::size_t>(count));
  EXPECT_GT(seen.dark, static_cast<std::size_t>(count));
}

// Real coordinates: long and thin triangles, all through each other, near the origin and far from it, at any scale.
TEST(RandomSoups, AreLitAndDarkAsBruteForceSays) {
  Seen seen;
  for (int i = 0; i < 120 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("soup " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i) + 77);
    const double thin = random.whole(0, 1) != 0 ? 0.02 : 1.0;
    mesh::Mesh all = shapes::soup(static_cast<std::uint64_t>(i), 40, [](Random& r) {
      return r.point({Vec3(-1.0), Vec3(1.0)});
    });
    for (std::size_t p = 2; p < all.positions.size(); p += 3)
      all.positions[p] = all.positions[p - 1] + thin * (all.positions[p] - all.positions[p - 1]);
    constexpr double kScales[] = {1.0, 1e-9, 1e12, 1.0};
    Mat4 place(kScales[i % 4]);
    place[3] = i % 4 == 3 ? Vec4(3e6, -5e6, 100, 1) : Vec4(0, 0, 0, 1);
    const auto geometry = shadow::makeGeometry(shapes::scene({all}, place));
    scene::Light lamp{scene::DirectionalLight{random.point({Vec3(-1.0), Vec3(1.0)})}, Vec3(1.0), 1.0, ""};
    if (random.whole(0, 1) != 0)
      lamp.shape = scene::PointLight{transformPoint(place, random.point({Vec3(-2.0), Vec3(2.0)}))};
    const Vec4 towards = scene::homogeneous(lamp, geometry->surfaces.origin);
    comparePoints(*geometry, LightCutter(geometry, lamp, ConeSides::none), towards, random, seen);
    const auto pieces = cutSurfaces(geometry, {&lamp, 1});
    ASSERT_TRUE(pieces);
    const Areas areas = sum(areasByMaterial(geometry->surfaces, 1, *pieces, 1));
    EXPECT_NEAR((areas.lights[0].lit + areas.lights[0].shadowed) / areas.surface, 1.0, 1e-9);
  }
  EXPECT_GT(seen.cut, 1000u);
  EXPECT_GT(seen.lit, 1000u);
}

// Numbers at the ends of what single precision holds end, whatever comes out.
TEST(RandomSoups, OfAnySizeEnd) {
  for (const double scale : {1e-40, 1e-30, 1e-15, 1e15, 1e30, 1e37})
    for (int i = 0; i < 8; ++i) {
      const auto s = shapes::scene({shapes::soup(static_cast<std::uint64_t>(i), 30, [&](Random& r) {
        return scale * r.point({Vec3(-1.0), Vec3(1.0)});
      })});
      const auto geometry = shadow::makeGeometry(s);
      const std::vector<scene::Light> lights = {
          {scene::DirectionalLight{{0.3, 0.2, -1}}, Vec3(1.0), 1.0, ""},
          {scene::PointLight{{1, 2, 3}}, Vec3(1.0), 1.0, ""},
          {scene::SpotLight{{1, 2, 3}, {0, 0, -1}, Angle::degrees(30)}, Vec3(1.0), 1.0, ""}};
      ASSERT_TRUE(cutSurfaces(geometry, lights));
    }
}

}  // namespace
}  // namespace umbrage::cut
