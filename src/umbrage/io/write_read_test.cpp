// What is written comes back.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <regex>

#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"
#include "umbrage/io/write.hpp"
#include "umbrage/samples/samples.hpp"

namespace umbrage::io {
namespace {

scene::Scene returned(const scene::Scene& scene, const std::string& extension) {
  const test::Folder folder;
  const auto path = folder.path() / ("scene." + extension);
  const auto done = writeScene(scene, path);
  EXPECT_TRUE(done) << (done ? "" : done.error().text());
  auto back = loadScene(path);
  EXPECT_TRUE(back) << (back ? "" : back.error().text());
  return back ? *back : scene::Scene{};
}

/// Into the frame with Z up, whatever the scene's.
Vec3 zUp(const scene::Scene& s, const Vec3& p) { return s.up == scene::UpAxis::z ? p : Vec3(p.x, -p.z, p.y); }

/// All triangles as corners in the world with Z up, each starting at its smallest corner, sorted: what must not change.
std::vector<std::array<Vec3, 3>> trianglesOf(const scene::Scene& s) {
  std::vector<std::array<Vec3, 3>> all;
  for (const scene::Instance& i : s.instances)
    for (const mesh::Triangle& t : s.meshes[i.mesh]->triangles) {
      std::array<Vec3, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = zUp(s, transformPoint(i.toWorld, s.meshes[i.mesh]->positions[t[k]])) + 0.0;
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), lexicographicallyLess<Vec3>),
                  corners.end());
      all.push_back(corners);
    }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), lexicographicallyLess<Vec3>);
  });
  return all;
}

/// Triangles by the look of their material, in 8 bits per channel.
std::map<std::array<long, 4>, std::size_t> looksOf(const scene::Scene& s) {
  std::map<std::array<long, 4>, std::size_t> looks;
  for (const scene::Instance& i : s.instances) {
    const mesh::Mesh& m = *s.meshes[i.mesh];
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      const scene::Material& material = s.materials[m.materials.empty() ? 0 : m.materials[t]];
      const Vec3 c = material.colour * 255.0;
      ++looks[{std::lround(c.x), std::lround(c.y), std::lround(c.z), std::lround(255.0 * material.opacity)}];
    }
  }
  return looks;
}

std::vector<std::string> namesOf(const scene::Scene& s, const std::string& kept = {}) {
  std::vector<std::string> names;
  for (const scene::Instance& i : s.instances) {
    names.push_back(i.name);
    if (!kept.empty())
      std::replace_if(
          names.back().begin(), names.back().end(),
          [&](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && kept.find(c) == std::string::npos; },
          '_');
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Names without what CityJSON adds where a level's name is taken: "Tower/Facade (2)" -> "Tower/Facade".
scene::Scene withoutNumbers(scene::Scene s) {
  for (scene::Instance& i : s.instances) i.name = std::regex_replace(i.name, std::regex(R"( \(\d+\))"), "");
  return s;
}

std::vector<std::string> materialNamesOf(const scene::Scene& s) {
  std::vector<std::string> names;
  for (const scene::Material& m : s.materials) names.push_back(m.name);
  std::sort(names.begin(), names.end());
  return names;
}

TEST(WriteRead, GlbKeepsFiltersAndOthersTheirOpacity) {
  auto scene = *samples::make("courtyard");
  scene.materials.resize(std::max<std::size_t>(scene.materials.size(), 3));
  scene.materials[0].filter = Vec3(0.25, 0.5, 0.125), scene.materials[0].opacity = 0.5;
  scene.materials[1].filter = Vec3(1.0), scene.materials[1].opacity = 0.0;
  scene.materials[2].opacity = 0.5;
  const auto back = returned(scene, "glb");
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(glm::length(scene::transmittance(back.materials[i]) - scene::transmittance(scene.materials[i])), 1e-9);
  EXPECT_EQ(back.materials[0].filter, scene.materials[0].filter);
  EXPECT_FALSE(back.materials[2].filter);
  for (const char* extension : {"iv", "obj", "city.json"})
    for (const scene::Material& m : returned(scene, extension).materials)
      EXPECT_TRUE(!m.filter || m.opacity == 0.0) << extension;
}

using Case = std::tuple<std::string, std::string>;
std::string caseName(const testing::TestParamInfo<Case>& each) {
  const auto& [sample, extension] = each.param;
  return sample + "_" + extension.substr(0, extension.find('.'));
}
class EverySampleAndFormat : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(WriteRead, EverySampleAndFormat,
                         testing::Combine(testing::Values("courtyard", "tower", "industrial", "building", "pavilion"),
                                          testing::Values("glb", "iv", "city.json", "obj")),
                         caseName);

TEST_P(EverySampleAndFormat, ComesBackAsItWas) {
  const auto& [sample, extension] = GetParam();
  const scene::Scene given = *samples::make(sample), back = returned(given, extension);
  EXPECT_TRUE(back.warnings.empty()) << back.warnings.front();
  EXPECT_EQ(scene::triangleCount(back), scene::triangleCount(given));
  // To the last bit: samples stand on a lattice that every format holds.
  EXPECT_TRUE(trianglesOf(back) == trianglesOf(given));
  EXPECT_EQ(looksOf(back), looksOf(given));
  if (extension == "glb" || extension == "iv") {
    EXPECT_EQ(namesOf(back), namesOf(given));
  }
  if (extension == "glb") {
    EXPECT_EQ(back.meshes.size(), given.meshes.size());
  }
  if (extension == "city.json") {
    EXPECT_EQ(namesOf(withoutNumbers(back)), namesOf(given));
    EXPECT_EQ(materialNamesOf(back), materialNamesOf(given));
  }
  if (extension == "obj") {
    EXPECT_EQ(namesOf(back), namesOf(given, "_-"));
  }
}

/// A closed body far from the origin, on coordinates that single precision does not hold.
scene::Scene farAway(scene::UpAxis up) {
  const Vec3 at = up == scene::UpAxis::z ? Vec3(85123.4, 446012.7, 12.3) : Vec3(85123.4, 12.3, -446012.7);
  auto body = std::make_shared<mesh::Mesh>();
  body->name = "Body";
  body->positions = {at, at + Vec3(1.1, 0, 0), at + Vec3(0, 1.1, 0), at + Vec3(0, 0, 1.1)};
  body->triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  scene::Scene s;
  s.up = up;
  s.crs = "EPSG:28992";
  s.materials = {{"clay", Vec3(0.5), 1.0}};
  s.meshes = {body};
  s.instances = {{"Far/Body", 0, Mat4(1.0), true}};
  return s;
}

TEST(WriteRead, LosesNothingThatMattersFarFromTheOrigin) {
  for (const scene::UpAxis up : {scene::UpAxis::y, scene::UpAxis::z})
    for (const std::string extension : {"glb", "city.json"}) {
      const scene::Scene given = farAway(up), back = returned(given, extension);
      const auto before = trianglesOf(given), after = trianglesOf(back);
      ASSERT_EQ(before.size(), after.size());
      for (std::size_t t = 0; t < before.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(glm::length(before[t][k] - after[t][k]), 1e-6) << extension;
      EXPECT_EQ(test::wholeReport<Vec3>(back).topology, mesh::Topology::closed);
      if (extension == "city.json") {
        EXPECT_EQ(back.crs, "EPSG:28992");
      }
    }
}

TEST(WriteRead, TurnsAndScalesToMetres) {
  scene::Scene given = farAway(scene::UpAxis::y);
  auto m = std::make_shared<mesh::Mesh>(*given.meshes[0]);
  for (Vec3& p : m->positions) p = glm::round((p - given.meshes[0]->positions[0]) * 100.0);
  given.meshes = {m};
  given.metresPerUnit = 0.5;
  for (const std::string extension : {"glb", "iv", "city.json", "obj"}) {
    const scene::Scene back = returned(given, extension);
    const Box3 box = scene::bounds(back);
    EXPECT_EQ(back.up, extension == "city.json" ? scene::UpAxis::z : scene::UpAxis::y);
    EXPECT_EQ(back.metresPerUnit, 1.0);
    EXPECT_EQ(glm::dot(box.max, scene::upVector(back.up)), 55.0) << extension;
    EXPECT_EQ(box.max.x, 55.0) << extension;
  }
}

TEST(WriteRead, TakesNamesOfAllKinds) {
  scene::Scene given = farAway(scene::UpAxis::z);
  const std::string names[] = {"Far/Body", "", "/", "Far", "Körper/\"Dach\" {1}\\x", "1st/2nd", "Far/Body", "a\nb"};
  given.instances.clear();
  for (const std::string& name : names) given.instances.push_back({name, 0, Mat4(1.0), true});
  for (const std::string extension : {"glb", "iv", "city.json", "obj"})
    EXPECT_EQ(scene::triangleCount(returned(given, extension)), scene::triangleCount(given)) << extension;
  std::string deep;
  for (int level = 0; level < 100000; ++level) deep += "d/";
  given.instances[5].name = deep;
  given.instances[4].name = "bytes that are no text: \xff\xfe";
  for (const std::string extension : {"glb", "iv", "city.json", "obj"})
    EXPECT_EQ(scene::triangleCount(returned(given, extension)), scene::triangleCount(given)) << extension;
}

/// Any soup on an integer lattice: repeated corners, repeated triangles, mirrored and shared placements.
scene::Scene anyScene() {
  const auto point = [] { return Vec3(*rc::gen::inRange(-3, 4), *rc::gen::inRange(-3, 4), *rc::gen::inRange(-3, 4)); };
  const auto below = [](std::size_t end) {
    return *rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(end));
  };
  scene::Scene s;
  s.up = *rc::gen::arbitrary<bool>() ? scene::UpAxis::y : scene::UpAxis::z;
  s.materials = {{"a", Vec3(0.25), 1.0}, {"b", Vec3(0.5), 0.5}, {"c", Vec3(0.75), 1.0}};
  for (std::uint32_t m = 0; m < 2; ++m) {
    mesh::Mesh soup;
    const auto corners = 3 + below(6), triangles = below(8);
    for (std::uint32_t i = 0; i < corners; ++i) soup.positions.push_back(point());
    for (std::uint32_t i = 0; i < triangles; ++i) {
      soup.triangles.push_back({below(corners), below(corners), below(corners)});
      soup.materials.push_back(below(3));
    }
    s.meshes.push_back(std::make_shared<const mesh::Mesh>(soup));
  }
  const auto count = below(5);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Mat4 moved = glm::translate(Mat4(1.0), 10.0 * point());
    const Vec3 stretched(*rc::gen::element(-2.0, -1.0, 1.0, 2.0), *rc::gen::element(-1.0, 1.0), 1.0);
    s.instances.push_back(
        {*rc::gen::element<std::string>("A", "A/B", "A/B/C", "D"), below(2), glm::scale(moved, stretched)});
  }
  return s;
}

/// Without triangles of fewer than three different corners, starting anywhere and wound either way (mirroring may turn them).
std::vector<std::array<Vec3, 3>> properTriangles(const scene::Scene& s) {
  auto all = trianglesOf(s);
  std::erase_if(all, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  for (auto& t : all) std::sort(t.begin(), t.end(), lexicographicallyLess<Vec3>);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), lexicographicallyLess<Vec3>);
  });
  return all;
}

TEST(WriteRead, GlbKeepsWhatShinesMirrorsAndBends) {
  auto room = samples::make("cornell"), balls = samples::make("still_life");
  ASSERT_TRUE(room && balls);
  for (const scene::Scene& given : {*room, *balls}) {
    const scene::Scene back = returned(given, "glb");
    for (const scene::Material& material : given.materials) {
      const auto same = std::ranges::find(back.materials, material.name, &scene::Material::name);
      ASSERT_NE(same, back.materials.end());
      EXPECT_LT(glm::length(same->emission - material.emission), 1e-12) << material.name;
      EXPECT_NEAR(same->mirror, material.mirror, 1e-12) << material.name;
      EXPECT_EQ(same->ior, material.ior) << material.name;
    }
  }
}

RC_GTEST_PROP(WriteRead, AnySoupComesBack, ()) {
  const scene::Scene given = anyScene();
  const auto extension = *rc::gen::element<std::string>("glb", "iv", "city.json", "obj");
  const scene::Scene back = returned(given, extension);
  RC_ASSERT(properTriangles(back) == properTriangles(given));
  RC_ASSERT(extension != "glb" || trianglesOf(back) == trianglesOf(given));
}

}  // namespace
}  // namespace umbrage::io
