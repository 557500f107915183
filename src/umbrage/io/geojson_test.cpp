#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "umbrage/io/load.hpp"
#include "umbrage/io/reader/building_height.hpp"
#include "umbrage/io/reader/json_access.hpp"
#include "umbrage/io/test_data.hpp"

namespace umbrage::io {
namespace {

using reader::BuildingHeight;
using reader::HeightFault;
using reader::Json;

const std::string kSquare = "[[[16.6,49.2],[16.601,49.2],[16.601,49.201],[16.6,49.201],[16.6,49.2]]]";

std::string feature(const std::string& properties, const std::string& rings, const std::string& type = "Polygon") {
  return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":{"type":")" + type + R"(","coordinates":)" +
         rings + "}}";
}
std::string map(const std::string& features, const std::string& more = "") {
  return R"({"type":"FeatureCollection",)" + more + R"("features":[)" + features + "]}";
}
std::string crs(const std::string& name) { return R"("crs":{"type":"name","properties":{"name":")" + name + R"("}},)"; }

Result<scene::Scene> load(const std::string& text, const LoadOptions& options = {}, const char* name = "test.geojson") {
  const test::Folder folder;
  return loadScene(folder.write(name, text), options);
}
scene::Scene loaded(const std::string& text, const LoadOptions& options = {}, const char* name = "test.geojson") {
  auto scene = load(text, options, name);
  EXPECT_TRUE(scene) << scene.error().text();
  return scene ? *scene : scene::Scene{};
}
void expectRefused(const std::string& text, const std::string& part, const LoadOptions& options = {}) {
  const auto scene = load(text, options);
  ASSERT_FALSE(scene) << part;
  EXPECT_EQ(exitCode(scene.error().code), 3);
  EXPECT_NE(scene.error().message.find(part), std::string::npos) << scene.error().text();
}
bool warns(const scene::Scene& scene, const std::string& part) {
  for (const std::string& warning : scene.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

double volume(const mesh::Mesh& m) {
  double volume = 0.0;
  const Vec3 origin = m.positions.empty() ? Vec3(0.0) : m.positions[0];
  for (const mesh::Triangle& t : m.triangles)
    volume +=
        glm::dot(m.positions[t[0]] - origin, glm::cross(m.positions[t[1]] - origin, m.positions[t[2]] - origin)) / 6.0;
  return volume;
}
double volume(const scene::Scene& scene) {
  double sum = 0.0;
  for (const auto& mesh : scene.meshes) sum += volume(*mesh);
  return sum;
}

// The area of a small quadrangle of the ellipsoid, its sides along meridians and parallels, in closed form (to 1e-7 here).
double quadrangle(double latitude, double east, double north) {
  constexpr double a = 6378137.0, e2 = 0.00669437999014132, degree = std::numbers::pi / 180.0;
  const double s = std::sin((latitude + north / 2) * degree), w = 1 - e2 * s * s;
  return a * (1 - e2) / std::pow(w, 1.5) * north * degree * a / std::sqrt(w) *
         std::cos((latitude + north / 2) * degree) * east * degree;
}

TEST(GeoJson, degreesBecomeMetres) {
  const auto scene = loaded(map(feature(R"({"height":10,"name":"hall"})", kSquare)));
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.instances[0].name, "hall");
  EXPECT_EQ(scene.up, scene::UpAxis::z);
  EXPECT_TRUE(scene.crs.starts_with("+proj=tmerc")) << scene.crs;
  const double expected = 10.0 * quadrangle(49.2, 0.001, 0.001);
  EXPECT_NEAR(volume(scene) / expected, 1.0, 1e-6);
  EXPECT_EQ(scene::bounds(scene).min.z, 0.0);
  EXPECT_EQ(scene::bounds(scene).max.z, 10.0);
  EXPECT_EQ(test::wholeReport<Vec3>(scene).borderEdges, 0U);
}

TEST(GeoJson, holesAndPartsStayClosed) {
  const std::string rings =
      "[[[[0,0],[30,0],[30,30],[0,30],[0,0]],[[10,10],[10,20],[20,20],[20,10],[10,10]]],[[[40,0],[50,0],[45,8],[40,0]]]"
      "]";
  LoadOptions local;
  local.crs = "local";
  const auto scene = loaded(map(feature(R"({"height":20})", rings, "MultiPolygon")), local);
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_TRUE(scene.crs.empty());
  EXPECT_NEAR(volume(scene), 20.0 * (800.0 + 40.0), 1e-9);
  const auto report = test::wholeReport<Vec3>(scene);
  EXPECT_EQ(report.borderEdges, 0U);
  EXPECT_EQ(report.nonManifoldEdges, 0U);
}

TEST(GeoJson, windingOfTheFileDoesNotMatter) {
  LoadOptions local;
  local.crs = "local";
  EXPECT_NEAR(volume(loaded(map(feature(R"({"height":2})", "[[[0,0],[0,3],[5,3],[5,0],[0,0]]]")), local)), 30.0, 1e-12);
  EXPECT_NEAR(volume(loaded(map(feature(R"({"height":2})", "[[[0,0],[5,0],[5,3],[0,3]]]")), local)), 30.0, 1e-12);
}

TEST(GeoJson, metresAreHonoured) {
  const std::string rings = "[[[90500,435500],[90510,435500],[90510,435520],[90500,435520],[90500,435500]]]";
  const auto scene = loaded(map(feature(R"({"height":3})", rings), crs("urn:ogc:def:crs:EPSG::28992")));
  EXPECT_EQ(scene.crs, "EPSG:28992");
  EXPECT_EQ(scene::bounds(scene).min, Vec3(90500, 435500, 0));
  EXPECT_NEAR(volume(scene), 600.0, 1e-6);
}

TEST(GeoJson, feetOfAMapAreItsUnit) {
  const std::string rings = "[[[980000,190000],[980100,190000],[980100,190100],[980000,190100],[980000,190000]]]";
  const auto scene = loaded(map(feature(R"({"height":30.48006096})", rings), crs("EPSG:2263")));
  EXPECT_NEAR(scene.metresPerUnit, 0.3048006096, 1e-9);
  EXPECT_NEAR(scene::bounds(scene).max.z, 100.0, 1e-9);
}

TEST(GeoJson, heightsInTheWild) {
  const auto height = [](const char* properties, reader::HeightRules rules = {}) {
    const auto found = heightOf(Json::parse(properties), rules);
    const auto* known = std::get_if<BuildingHeight>(&found);
    return known != nullptr ? known->top : -1.0 - static_cast<double>(std::get<HeightFault>(found));
  };
  EXPECT_EQ(height(R"({"height":12})"), 12.0);
  EXPECT_EQ(height(R"({"HEIGHT":"12.5 m"})"), 12.5);
  EXPECT_EQ(height(R"({"measuredHeight":"7,5"})"), 7.5);
  EXPECT_NEAR(height(R"({"building:height":"40 ft"})"), 12.192, 1e-12);
  EXPECT_EQ(height(R"({"building:levels":"4"})"), 12.0);
  EXPECT_EQ(height(R"({"floors":6.0})"), 18.0);
  EXPECT_EQ(height(R"({"height":null,"floors":2})"), 6.0);
  EXPECT_EQ(height(R"({"height":9,"building:levels":2})"), 9.0);
  EXPECT_EQ(height(R"({"H_ridge":9,"height":3})", {"h_ridge", {}, 3.0}), 9.0);
  EXPECT_EQ(height(R"({})", {{}, 8.0, 3.0}), 8.0);
  const auto fault = [](HeightFault f) { return -1.0 - static_cast<double>(f); };
  EXPECT_EQ(height(R"({"height":-7})"), fault(HeightFault::notPositive));
  EXPECT_EQ(height(R"({"height":0})"), fault(HeightFault::notPositive));
  EXPECT_EQ(height(R"({"height":5,"min_height":5})"), fault(HeightFault::notPositive));
  EXPECT_EQ(height(R"({"height":"tall"})"), fault(HeightFault::notANumber));
  EXPECT_EQ(height(R"({"height":"12 cubits"})"), fault(HeightFault::notANumber));
  EXPECT_EQ(height(R"({"height":[3]})"), fault(HeightFault::notANumber));
  EXPECT_EQ(height(R"({"height":1e308})"), fault(HeightFault::tooTall));
  EXPECT_EQ(height(R"({"name":"x"})"), fault(HeightFault::absent));
  EXPECT_EQ(height("null"), fault(HeightFault::absent));
}

TEST(GeoJson, basesAreLifted) {
  const auto scene = loaded(map(feature(R"({"height":10,"min_height":4})", kSquare)));
  EXPECT_EQ(scene::bounds(scene).min.z, 4.0);
}

TEST(GeoJson, crossingRingsAreRepairedOrDropped) {
  LoadOptions local;
  local.crs = "local";
  const auto scene = loaded(map(feature(R"({"height":5})", "[[[0,0],[10,10],[10,0],[0,10],[0,0]]]") + "," +
                                feature(R"({"height":5})", "[[[20,0],[30,0],[20,0],[30,0],[20,0]]]") + "," +
                                feature(R"({"height":5})", "[[[40,0],[50,0]]]")),
                            local);
  EXPECT_NEAR(volume(scene), 5.0 * 50.0, 1e-9);
  EXPECT_EQ(test::wholeReport<Vec3>(scene).borderEdges, 0U);
  EXPECT_TRUE(warns(scene, "1 of 3 polygons repaired: rings that crossed"));
  EXPECT_TRUE(warns(scene, "1 of 3 polygons dropped: rings that enclose nothing"));
  EXPECT_TRUE(warns(scene, "1 of 3 polygons dropped: fewer than three"));
}

TEST(GeoJson, whatOfAHoleLiesOutsideIsNoBuilding) {
  LoadOptions local;
  local.crs = "local";
  const std::string outer = "[[0,0],[10,0],[10,10],[0,10],[0,0]]";
  const auto areaOf = [&](const std::string& rings) {
    const auto scene = loaded(map(feature(R"({"height":1})", "[" + rings + "]")), local);
    EXPECT_TRUE(warns(scene, "1 of 1 polygon repaired"));
    EXPECT_EQ(test::wholeReport<Vec3>(scene).borderEdges, 0U);
    return volume(scene);
  };
  // Half of the hole lies outside: 4 x 4 of 4 x 8.
  EXPECT_NEAR(areaOf(outer + ",[[3,6],[7,6],[7,14],[3,14],[3,6]]"), 100.0 - 16.0, 1e-9);
  // Two holes that share 2 x 2.
  EXPECT_NEAR(areaOf(outer + ",[[2,2],[6,2],[6,6],[2,6],[2,2]],[[4,4],[8,4],[8,8],[4,8],[4,4]]"), 100.0 - 28.0, 1e-9);
  // A spike on the outer ring, and a hole.
  EXPECT_NEAR(areaOf("[[0,0],[10,0],[10,5],[20,5],[10,5],[10,10],[0,10],[0,0]],[[2,2],[6,2],[6,6],[2,6],[2,2]]"),
              100.0 - 16.0, 1e-9);
}

TEST(GeoJson, oddFeaturesAreCounted) {
  const auto scene =
      loaded(map(feature(R"({"height":-7})", kSquare) + "," + feature("null", kSquare) + "," +
                 feature(R"({"height":"12 m"})", kSquare) + "," + feature(R"({"height":1})", "[16.6,49.2]", "Point") +
                 "," + feature(R"({"height":1})", "[[[16.6],[1],[2]]]") +
                 R"(,{"type":"Feature","properties":{"height":1},"geometry":null},7)"));
  EXPECT_EQ(scene.instances.size(), 1U);
  EXPECT_TRUE(warns(scene, "1 of 7 features dropped: a height that is negative"));
  EXPECT_TRUE(warns(scene, "1 of 7 features dropped: no height"));
  EXPECT_TRUE(warns(scene, "1 of 7 features dropped: not rings"));
  EXPECT_TRUE(warns(scene, "3 of 7 features left out: not a polygon"));
}

TEST(GeoJson, degreesTakenForMetresAreRefused) {
  // The file says metres, and its coordinates are degrees.
  expectRefused(map(feature(R"({"height":10})", kSquare), crs("EPSG:3857")), "look like degrees");
  LoadOptions local;
  local.crs = "local";
  expectRefused(map(feature(R"({"height":10})", kSquare)), "look like degrees", local);
  // The file says nothing, which means degrees, and its coordinates are metres: far ones, near ones.
  expectRefused(map(feature(R"({"height":10})", "[[[500000,5000000],[500010,5000000],[500010,5000010]]]")),
                "cannot be degrees");
  expectRefused(map(feature(R"({"height":10})", "[[[0,0],[20,0],[20,15]]]")), "no likely degrees");
}

TEST(GeoJson, unknownSystemsAreRefused) {
  expectRefused(map(feature(R"({"height":10})", kSquare), crs("EPSG:99999999")), "not known");
  expectRefused(map(feature(R"({"height":10})", kSquare), R"("crs":{"type":"link","properties":{"href":"x"}},)"),
                "--crs");
  ::setenv("PROJ_LIB", "/nowhere", 1);
  ::setenv("PROJ_DATA", "/nowhere", 1);
  expectRefused(map(feature(R"({"height":10})", kSquare), crs("EPSG:28992")), "proj.db");
  // Plain longitude and latitude need no data.
  EXPECT_EQ(loaded(map(feature(R"({"height":10})", kSquare))).instances.size(), 1U);
  ::unsetenv("PROJ_LIB");
  ::unsetenv("PROJ_DATA");
}

TEST(GeoJson, acrossTheDateLine) {
  const auto scene = loaded(map(feature(
      R"({"height":10})", "[[[179.9995,-16],[-179.9995,-16],[-179.9995,-15.999],[179.9995,-15.999],[179.9995,-16]]]")));
  EXPECT_NEAR(volume(scene) / (10.0 * quadrangle(-16.0, 0.001, 0.001)), 1.0, 1e-6);
}

TEST(GeoJson, readsOtherFormsAndNames) {
  EXPECT_EQ(loaded(feature(R"({"height":10})", kSquare), {}, "one.json").instances.size(), 1U);
  LoadOptions high;
  high.defaultHeight = 6.0;
  const auto bare = loaded(R"({"type":"Polygon","coordinates":)" + kSquare + "}", high);
  EXPECT_EQ(scene::bounds(bare).max.z, 6.0);
  EXPECT_TRUE(warns(bare, "6 m high by default"));
  expectRefused(R"({"type":"Topology"})", "not GeoJSON");
  expectRefused("[1,2]", "not GeoJSON");
  expectRefused(std::string(100000, '['), "nested");
}

TEST(GeoJson, kawasaki) {
  const auto data = test::testData();
  if (data.empty()) GTEST_SKIP() << "no test data: set UMBRAGE_TEST_DATA";
  const auto scene = loadScene(data / "city/kawasaki_buildings.geojson");
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->instances.size(), 1374U);
  // 0.0302 degrees of longitude at 35.55 N, of latitude.
  EXPECT_NEAR(scene::bounds(*scene).size().x, 2760.0, 80.0);
  EXPECT_NEAR(scene::bounds(*scene).size().y, 3360.0, 50.0);
}

TEST(GeoJson, floorsOfBrno) {
  const auto data = test::testData();
  if (data.empty()) GTEST_SKIP() << "no test data: set UMBRAGE_TEST_DATA";
  const auto scene = loadScene(data / "city/brno_buildings.geojson");
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->crs, "EPSG:3035");
  EXPECT_GT(scene->instances.size(), 100U);
  EXPECT_TRUE(warns(*scene, "as high as their floors"));
  const auto without = loadScene(data / "city/tudcampus_bag.geojson");
  ASSERT_TRUE(without);
  EXPECT_TRUE(warns(*without, "1529 of 1529 features dropped: no height"));
}

}  // namespace
}  // namespace umbrage::io
