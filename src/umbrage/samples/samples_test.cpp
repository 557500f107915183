#include "umbrage/samples/samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>

#include "umbrage/mesh/mesh_report.hpp"
#include "umbrage/mesh/weld.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::samples {
namespace {

scene::Scene built(std::string_view name) {
  auto made = make(name);
  EXPECT_TRUE(made.has_value());
  return made ? *made : scene::Scene{};
}

mesh::Mesh welded(const mesh::Mesh& m) {
  const mesh::Weld weld = mesh::weld(m.positions);
  mesh::Mesh result = m;
  result.positions.clear();
  for (const std::uint32_t first : weld.first) result.positions.push_back(m.positions[first]);
  for (mesh::Triangle& t : result.triangles)
    for (std::uint32_t& corner : t) corner = weld.remap[corner];
  return result;
}

mesh::MeshReport inspectWelded(const mesh::Mesh& m) {
  const mesh::Mesh w = welded(m);
  return mesh::inspect(w.triangles, mesh::buildEdgeTable(w.triangles));
}

/// Of the smallest connected piece, times six; positive when every piece is wound outwards.
double smallestVolume(const mesh::Mesh& m) {
  const mesh::Mesh w = welded(m);
  const auto pieces = mesh::connectedComponents(w.triangles);
  std::vector<double> volumes(pieces.count, 0.0);
  std::vector<Vec3> origin(pieces.count, Vec3(0.0));
  std::vector<bool> known(pieces.count, false);
  for (std::size_t t = 0; t < w.triangles.size(); ++t) {
    const std::uint32_t piece = pieces.ofTriangle[t];
    const auto& [a, b, c] = w.triangles[t];
    if (!known[piece]) origin[piece] = w.positions[a];
    known[piece] = true;
    const Vec3 o = origin[piece];
    volumes[piece] += glm::dot(w.positions[a] - o, glm::cross(w.positions[b] - o, w.positions[c] - o));
  }
  return *std::min_element(volumes.begin(), volumes.end());
}

/// FNV-1a over everything that is geometry.
std::uint64_t hash(const scene::Scene& s) {
  std::uint64_t h = 14695981039346656037ull;
  const auto mix = [&](const void* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) h = (h ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211ull;
  };
  for (const auto& m : s.meshes) {
    mix(m->positions.data(), m->positions.size() * sizeof(Vec3));
    mix(m->triangles.data(), m->triangles.size() * sizeof(mesh::Triangle));
    mix(m->materials.data(), m->materials.size() * sizeof(std::uint32_t));
  }
  for (const scene::Instance& i : s.instances) {
    mix(i.name.data(), i.name.size());
    mix(&i.toWorld, sizeof i.toWorld);
  }
  return h;
}

std::string text(const Vec3& v) { return std::to_string(v.x) + ' ' + std::to_string(v.y) + ' ' + std::to_string(v.z); }

struct Expected {
  std::size_t least, most;  // triangles
  Vec3 min, max;
  std::uint64_t hash;
  std::set<std::string> open, nonManifold;  // every other part is closed
};

const std::map<std::string, Expected>& expectations() {
  static const std::map<std::string, Expected> all{
      {"courtyard",
       {20000,
        30000,
        {-30.625, -30.625, 0},
        {30.625, 30.625, 23.375},
        14850130477548263100ull,
        {"Block/Windows/Panes", "Court/Kiosk/Roof"},
        {}}},
      {"tower",
       {40000,
        60000,
        {-64.6318359375, -64.6318359375, 0},
        {64.6318359375, 64.6318359375, 300},
        9924093441426563525ull,
        {"Tower/Platforms/Glass"},
        {}}},
      {"industrial",
       {13000,
        60000,
        {-90.1875, -54, 0},
        {90, 51, 62},
        12066468710241926109ull,
        {"Halls/Hall 1/Glazing", "Halls/Hall 2/Glazing", "Cooling towers/Shell"},
        {"Yard/Containers"}}},
      {"building",
       {175000,
        185000,
        {-37, -27, 0},
        {37, 27, 109},
        16187422567190618673ull,
        {"Tower/Facade/Panes", "Podium/Facade/Panes"},
        {}}},
      {"pavilion",
       {600,
        4000,
        {-6, -5, -0.25},
        {6, 5, 4.0400390625},
        2415523805480208502ull,
        {"Pavilion/South/Panes", "Pavilion/East/Panes"},
        {}}},
      {"cornell", {98, 98, {-0.125, 0, 0}, {5.625, 5.625, 5.75}, 10523043275585144708ull, {"Lamp/Panel"}, {}}},
      {"still_life",
       {60000,
        70000,
        {-6.125, -6, 0},
        {6, 6, 6},
        4984172173680779176ull,
        {"Still life/Floor", "Still life/Mirror"},
        {}}}};
  return all;
}

class EverySample : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] scene::Scene scene() const { return built(GetParam()); }
  [[nodiscard]] const Expected& expected() const { return expectations().at(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Samples, EverySample,
                         testing::Values("courtyard", "tower", "industrial", "building", "pavilion", "cornell",
                                         "still_life"),
                         [](const auto& each) { return each.param; });

TEST_P(EverySample, IsAValidSceneInMetresWithZUp) {
  const scene::Scene s = scene();
  EXPECT_EQ(scene::findFault(s), std::nullopt);
  EXPECT_EQ(s.up, scene::UpAxis::z);
  EXPECT_EQ(s.metresPerUnit, 1.0);
  EXPECT_TRUE(s.warnings.empty());
  std::set<std::string> names;
  for (const scene::Instance& i : s.instances) {
    EXPECT_THAT(i.name, testing::ContainsRegex("^[A-Z][^/]*/")) << "a part has a parent";
    EXPECT_TRUE(names.insert(i.name).second) << i.name << " stands there twice";
  }
}

TEST_P(EverySample, HasItsSize) {
  const scene::Scene s = scene();
  EXPECT_GE(scene::triangleCount(s), expected().least);
  EXPECT_LE(scene::triangleCount(s), expected().most);
  const Box3 box = scene::bounds(s);
  EXPECT_EQ(text(box.min), text(expected().min));
  EXPECT_EQ(text(box.max), text(expected().max));
}

TEST_P(EverySample, IsTheSameEverywhere) { EXPECT_EQ(hash(scene()), expected().hash); }

TEST_P(EverySample, StandsOnTheLatticeOfSinglePrecision) {
  const scene::Scene s = scene();
  for (const auto& i : s.instances)
    for (const Vec3& p : s.meshes[i.mesh]->positions) {
      const Vec3 world = transformPoint(i.toWorld, p);
      ASSERT_EQ(1024.0 * p, glm::round(1024.0 * p)) << i.name;
      ASSERT_EQ(world, Vec3(Vec3f(world))) << i.name;
    }
}

TEST_P(EverySample, HasNoTriangleWithoutArea) {
  for (const auto& m : scene().meshes)
    for (const auto& [a, b, c] : m->triangles)
      ASSERT_GT(glm::length(glm::cross(m->positions[b] - m->positions[a], m->positions[c] - m->positions[a])), 0.0)
          << m->name;
}

TEST_P(EverySample, IsClosedWhereItSaysSo) {
  const scene::Scene s = scene();
  std::set<std::string> open, nonManifold;
  for (const auto& i : s.instances) {
    const mesh::Mesh& m = *s.meshes[i.mesh];
    const mesh::MeshReport report = inspectWelded(m);
    EXPECT_EQ(report.windingFlips, 0u) << i.name;
    if (report.topology == mesh::Topology::open) open.insert(i.name);
    if (report.topology == mesh::Topology::nonManifold) nonManifold.insert(i.name);
    if (report.topology != mesh::Topology::open) {
      EXPECT_GT(smallestVolume(m), 0.0) << i.name << " is wound inwards somewhere";
    }
  }
  EXPECT_EQ(open, expected().open);
  EXPECT_EQ(nonManifold, expected().nonManifold);
}

using Lattice = std::array<std::int64_t, 3>;  // in 1/4096 m

/// A triangle on its plane: the two coordinates that span it best.
struct Flat {
  std::array<std::array<std::int64_t, 2>, 3> at;
  std::string part;
};

/// True when no edge of `a` separates the two; both counter-clockwise. Whole numbers, so touching is not overlapping.
bool noEdgeSeparates(const Flat& a, const Flat& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &p = a.at[i], &q = a.at[(i + 1) % 3];
    if (std::all_of(b.at.begin(), b.at.end(),
                    [&](const auto& r) { return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) <= 0; }))
      return false;
  }
  return true;
}

/// All triangles by oriented plane: reduced normal and distance.
std::map<std::array<std::int64_t, 4>, std::vector<Flat>> byPlane(const scene::Scene& s) {
  std::map<std::array<std::int64_t, 4>, std::vector<Flat>> planes;
  for (const auto& instance : s.instances)
    for (const auto& t : s.meshes[instance.mesh]->triangles) {
      std::array<Lattice, 3> p{};
      for (std::size_t k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
          p[k][static_cast<std::size_t>(axis)] =
              std::llround(4096.0 * transformPoint(instance.toWorld, s.meshes[instance.mesh]->positions[t[k]])[axis]);
      Lattice n{};
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        n[a] = (p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) - (p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
      }
      const std::int64_t g = std::gcd(std::gcd(n[0], n[1]), n[2]);
      for (std::int64_t& x : n) x /= g;
      std::size_t up = 0;
      for (std::size_t a = 1; a < 3; ++a)
        if (std::abs(n[a]) > std::abs(n[up])) up = a;
      const std::size_t u = (up + (n[up] > 0 ? 1 : 2)) % 3, v = 3 - up - u;
      planes[{n[0], n[1], n[2], n[0] * p[0][0] + n[1] * p[0][1] + n[2] * p[0][2]}].push_back(
          {{{{p[0][u], p[0][v]}, {p[1][u], p[1][v]}, {p[2][u], p[2][v]}}}, instance.name});
    }
  return planes;
}

/// Two faces that look the same way from the same place would flicker in every renderer; only what stands on the ground may.
TEST_P(EverySample, HasNoFacesUponEachOther) {
  const std::array<std::int64_t, 4> standing{0, 0, -1, 0};
  for (const auto& [plane, flats] : byPlane(scene())) {
    if (plane == standing) continue;
    for (std::size_t i = 0; i < flats.size(); ++i)
      for (std::size_t j = i + 1; j < flats.size(); ++j)
        if (noEdgeSeparates(flats[i], flats[j]) && noEdgeSeparates(flats[j], flats[i]))
          ADD_FAILURE() << flats[i].part << " and " << flats[j].part << " in the plane " << plane[0] << ' ' << plane[1]
                        << ' ' << plane[2] << ' ' << plane[3] << " near "
                        << static_cast<double>(flats[i].at[0][0]) / 4096 << ' '
                        << static_cast<double>(flats[i].at[0][1]) / 4096;
  }
}

TEST_P(EverySample, UsesAllItsMaterials) {
  const scene::Scene s = scene();
  std::set<std::uint32_t> used;
  for (const auto& m : s.meshes) used.insert(m->materials.begin(), m->materials.end());
  EXPECT_EQ(used.size(), s.materials.size());
}

TEST(Samples, AreListedByName) {
  std::vector<std::string_view> names;
  for (const SampleInfo& info : list()) {
    names.push_back(info.name);
    EXPECT_FALSE(info.summary.empty());
    EXPECT_TRUE(make(info.name));
  }
  EXPECT_THAT(
      names, testing::ElementsAre("courtyard", "tower", "industrial", "building", "pavilion", "cornell", "still_life"));
  const auto none = make("castle");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::usage);
  EXPECT_THAT(none.error().message, testing::HasSubstr("courtyard"));
}

TEST(Building, PatternsChooseFacadeAndConcrete) {
  const scene::Scene s = built("building");
  const auto casting = [&](const char* pattern) {
    std::set<std::string> names;
    for (const auto& i : scene::withCasters(s, {pattern}).instances)
      if (i.casts) names.insert(i.name);
    return names;
  };
  EXPECT_THAT(casting("*Facade*"),
              testing::UnorderedElementsAre("Tower/Facade/Mullions", "Tower/Facade/Transoms", "Tower/Facade/Fins",
                                            "Tower/Facade/Panes", "Podium/Facade/Frame", "Podium/Facade/Panes"));
  EXPECT_THAT(casting("*Concrete*"),
              testing::UnorderedElementsAre("Tower/Concrete/Core", "Tower/Concrete/Slabs", "Tower/Concrete/Columns",
                                            "Tower/Concrete/Stairs", "Podium/Concrete/Deck"));
}

bool meets(const Vec3& from, const Vec3& way, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, p = glm::cross(way, ac);
  const double det = glm::dot(ab, p);
  if (det == 0.0) return false;
  const Vec3 s = from - a, q = glm::cross(s, ab);
  const double u = glm::dot(s, p) / det, v = glm::dot(way, q) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && glm::dot(ac, q) / det > 0.0;
}

/// From the court's floor the block hides exactly what four walls of 20 m around 30 m x 30 m hide.
TEST(Courtyard, TheBlockHidesWhatItsFourWallsHide) {
  scene::Scene s = scene::withCasters(built("courtyard"), {"Block"});
  scene::Scene block = s;
  std::erase_if(block.instances, [](const scene::Instance& i) { return !i.casts; });
  const scene::Surfaces surfaces = scene::flatten(block);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-14.999, 14.999), turn(0.0, 6.283185), climb(0.2, 2.5);
  int hidden = 0, tried = 0;
  for (; tried < 300; ++tried) {
    const Vec3 from{across(random), across(random), 0.0};
    const double angle = turn(random);
    const Vec3 way{std::cos(angle), std::sin(angle), climb(random)};
    const double x = (std::copysign(15.0, way.x) - from.x) / way.x, y = (std::copysign(15.0, way.y) - from.y) / way.y;
    const bool wanted = way.z * std::min(x, y) < 20.0;
    bool found = false;
    for (std::uint32_t t = 0; t < surfaces.triangles.size() && !found; ++t)
      found = meets(from, way, surfaces.corner(t, 0), surfaces.corner(t, 1), surfaces.corner(t, 2));
    ASSERT_EQ(found, wanted) << "from " << from.x << ' ' << from.y << " towards " << way.x << ' ' << way.y << ' '
                             << way.z;
    hidden += found ? 1 : 0;
  }
  EXPECT_GT(hidden, tried / 5);
  EXPECT_LT(hidden, tried * 4 / 5);
}

TEST(Tower, IsMadeOfThousandsOfBodies) {
  std::size_t bodies = 0;
  const scene::Scene s = built("tower");
  for (const auto& i : s.instances) bodies += inspectWelded(*s.meshes[i.mesh]).components;
  EXPECT_GT(bodies, 3000u);
}

TEST(Industrial, SharesMeshesBetweenInstances) {
  const scene::Scene s = built("industrial");
  EXPECT_LT(s.meshes.size() + 10, s.instances.size());
}

}  // namespace
}  // namespace umbrage::samples
