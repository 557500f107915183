#include <gtest/gtest.h>

#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"

namespace umbrage::io {
namespace {

// Two cubes' worth of corners: 0..7 the outer cube of 3, 8..15 the inner one from 1 to 2; 16..19 a window in the front wall.
const std::string kVertices = R"("vertices":[
  [0,0,0],[3,0,0],[3,3,0],[0,3,0],[0,0,3],[3,0,3],[3,3,3],[0,3,3],
  [1,1,1],[2,1,1],[2,2,1],[1,2,1],[1,1,2],[2,1,2],[2,2,2],[1,2,2],
  [1,0,1],[2,0,1],[2,0,2],[1,0,2]])";
const std::string kOuter = "[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]";
const std::string kInner =
    "[[[8,9,10,11]],[[12,15,14,13]],[[8,12,13,9]],[[9,13,14,10]],[[10,14,15,11]],[[11,15,12,8]]]";

std::string city(const std::string& objects, const std::string& more = "") {
  return R"({"type":"CityJSON","version":"2.0",)" + more + R"("CityObjects":{)" + objects + "}," + kVertices + "}";
}
std::string building(const std::string& geometry, const std::string& more = "") {
  return R"("b":{"type":"Building",)" + more + R"("geometry":[)" + geometry + "]}";
}
std::string solid(const std::string& shells, const std::string& lod = "2", const std::string& more = "") {
  return R"({"type":"Solid","lod":")" + lod + R"(","boundaries":[)" + shells + "]" + more + "}";
}

scene::Scene loaded(const std::string& text, const LoadOptions& options = {}, const char* name = "test.city.json") {
  const test::Folder folder;
  auto scene = loadScene(folder.write(name, text), options);
  EXPECT_TRUE(scene) << scene.error().text();
  return scene ? *scene : scene::Scene{};
}

double volume(const scene::Scene& scene) {
  double volume = 0.0;
  for (const scene::Instance& i : scene.instances) {
    const mesh::Mesh& m = *scene.meshes[i.mesh];
    for (const mesh::Triangle& t : m.triangles)
      volume += glm::dot(m.positions[t[0]], glm::cross(m.positions[t[1]], m.positions[t[2]])) / 6.0;
  }
  return volume;
}

bool warns(const scene::Scene& scene, const std::string& part) {
  for (const std::string& warning : scene.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

TEST(CityJson, solid) {
  const auto scene = loaded(city(building(solid(kOuter))));
  EXPECT_EQ(scene::triangleCount(scene), 12U);
  EXPECT_EQ(test::wholeReport<Vec3>(scene).topology, mesh::Topology::closed);
  EXPECT_DOUBLE_EQ(volume(scene), 27.0);
  EXPECT_EQ(scene.up, scene::UpAxis::z);
  EXPECT_EQ(scene.metresPerUnit, 1.0);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(CityJson, innerShellIsACavity) {
  const auto scene = loaded(city(building(solid(kOuter + "," + kInner))));
  EXPECT_EQ(scene::triangleCount(scene), 24U);
  EXPECT_EQ(test::wholeReport<Vec3>(scene).topology, mesh::Topology::closed);
  EXPECT_DOUBLE_EQ(volume(scene), 26.0);
}

TEST(CityJson, innerRingIsAHole) {
  // The front wall with a window that a surface of its own closes again, as a shutter.
  const std::string shell =
      "[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4],[16,19,18,17]],[[16,17,18,19]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]";
  const auto scene = loaded(city(building(solid(shell))));
  EXPECT_EQ(scene::triangleCount(scene), 5 * 2 + 8 + 2U);
  EXPECT_EQ(test::wholeReport<Vec3>(scene).topology, mesh::Topology::closed);
  EXPECT_NEAR(volume(scene), 27.0, 1e-12);
}

TEST(CityJson, everySolidAndSurfaceType) {
  const auto count = [](const std::string& type, const std::string& boundaries) {
    return scene::triangleCount(
        loaded(city(building(R"({"type":")" + type + R"(","lod":"1","boundaries":)" + boundaries + "}"))));
  };
  EXPECT_EQ(count("MultiSurface", kOuter), 12U);
  EXPECT_EQ(count("CompositeSurface", kOuter), 12U);
  EXPECT_EQ(count("Solid", "[" + kOuter + "]"), 12U);
  EXPECT_EQ(count("MultiSolid", "[[" + kOuter + "],[" + kInner + "]]"), 24U);
  EXPECT_EQ(count("CompositeSolid", "[[" + kOuter + "],[" + kInner + "]]"), 24U);
  EXPECT_EQ(count("MultiPoint", "[0,1,2]"), 0U);
  EXPECT_EQ(count("MultiLineString", "[[0,1,2]]"), 0U);
}

TEST(CityJson, transformIsAppliedInDoublePrecision) {
  const auto scene = loaded(city(building(solid(kOuter)),
                                 R"("transform":{"scale":[0.001,0.001,0.001],"translate":[84616.5,447423.1,-0.5]},)"));
  EXPECT_EQ(scene::bounds(scene).min, Vec3(84616.5, 447423.1, -0.5));
  EXPECT_EQ(scene::bounds(scene).max, Vec3(3 * 0.001 + 84616.5, 3 * 0.001 + 447423.1, 3 * 0.001 - 0.5));
}

TEST(CityJson, referenceSystemIsShortened) {
  const auto crs = [](const std::string& given) {
    return loaded(city("", R"("metadata":{"referenceSystem":")" + given + R"("},)")).crs;
  };
  EXPECT_EQ(crs("urn:ogc:def:crs:EPSG::28992"), "EPSG:28992");
  EXPECT_EQ(crs("https://www.opengis.net/def/crs/EPSG/0/7415"), "EPSG:7415");
  EXPECT_EQ(crs("local"), "local");
}

TEST(CityJson, semanticsDecideMaterials) {
  const auto scene = loaded(city(building(solid(kOuter, "2", R"(,"semantics":{"surfaces":[{"type":"GroundSurface"},
    {"type":"RoofSurface"},{"type":"WallSurface"}],"values":[[0,1,2,2,null,2]]})"))));
  const auto& materials = scene.meshes.at(0)->materials;
  ASSERT_EQ(materials.size(), 12U);
  const auto nameOf = [&](std::size_t triangle) { return scene.materials[materials[triangle]].name; };
  EXPECT_EQ(nameOf(0), "GroundSurface");
  EXPECT_EQ(nameOf(2), "RoofSurface");
  EXPECT_EQ(nameOf(4), "WallSurface");
  EXPECT_EQ(nameOf(8), "Building");
  EXPECT_NE(scene.materials[materials[2]].colour, scene.materials[materials[4]].colour);
}

TEST(CityJson, appearanceGoesBeforeSemantics) {
  const auto scene =
      loaded(city(building(solid(kOuter, "2", R"(,"material":{"theme":{"value":0}})")),
                  R"("appearance":{"materials":[{"name":"glass","diffuseColor":[0,0,1],"transparency":0.75}]},)"));
  const auto& material = scene.materials[scene.meshes.at(0)->materials.at(0)];
  EXPECT_EQ(material.name, "glass");
  EXPECT_EQ(material.colour, Vec3(0, 0, 1));
  EXPECT_EQ(material.opacity, 0.25);
}

TEST(CityJson, highestLodOrTheOneAskedFor) {
  const std::string text = city(building(solid(kInner, "1.2") + "," + solid(kOuter, "2.2")));
  EXPECT_DOUBLE_EQ(std::abs(volume(loaded(text))), 27.0);
  LoadOptions options;
  options.lod = "1.2";
  EXPECT_DOUBLE_EQ(std::abs(volume(loaded(text, options))), 1.0);
  options.lod = "3";
  const auto none = loaded(text, options);
  EXPECT_TRUE(none.instances.empty());
  EXPECT_TRUE(warns(none, "1 city object left out: not in LoD 3 (the file has 1.2, 2.2)"));
}

TEST(CityJson, lodMayBeANumber) {
  LoadOptions options;
  options.lod = "2";
  EXPECT_EQ(
      loaded(city(building(R"({"type":"Solid","lod":2.0,"boundaries":[)" + kOuter + "]}")), options).instances.size(),
      1U);
}

TEST(CityJson, parentsAreTheHierarchy) {
  const auto scene = loaded(city(R"("part":{"type":"BuildingPart","parents":["house"],"geometry":[)" + solid(kOuter) +
                                 R"(]},"house":{"type":"Building","children":["part"]},
    "x":{"type":"Building","parents":["y"],"geometry":[)" +
                                 solid(kInner) + R"(]},"y":{"type":"Building","parents":["x"]})"));
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.instances[0].name, "house/part");
  EXPECT_EQ(scene.instances[1].name, "y/x");
}

// By the child's own word, by the parent's alone, through a parent that is a part itself; collections are no buildings.
TEST(CityJson, partsKnowTheirBuilding) {
  const std::string geometry = R"("geometry":[)" + solid(kOuter) + "]";
  const auto scene = loaded(city(
      R"("a":{"type":"BuildingPart","parents":["h/1"],)" + geometry + R"(},"b":{"type":"BuildingPart",)" + geometry +
      R"(},"c":{"type":"BuildingInstallation","parents":["a"],)" + geometry +
      R"(},"d":{"type":"Building","parents":["all"],)" + geometry + R"(},"e":{"type":"Building",)" + geometry + R"(},
    "h/1":{"type":"Building","children":["a","b"]},"all":{"type":"CityObjectGroup","children":["d","e"]})"));
  ASSERT_EQ(scene.instances.size(), 5U);
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"h_1/a", "h/1"}, {"h_1/b", "h/1"}, {"h_1/a/c", "h/1"}, {"all/d", "d"}, {"e", "e"}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(scene.instances[i].name, expected[i].first);
    EXPECT_EQ(scene.instances[i].group, expected[i].second);
  }
}

TEST(CityJson, degreesAreNotTakenForMetres) {
  const std::string text = R"({"type":"CityJSON","version":"2.0","CityObjects":{"b":{"type":"Building","geometry":
    [{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}]}},
    "vertices":[[16.37,48.2,0],[16.3702,48.2,0],[16.37,48.2001,10]]})";
  const test::Folder folder;
  const auto file = folder.write("degrees.city.json", text);
  const auto refused = loadScene(file);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("look like degrees, though CityJSON says they are lengths"), std::string::npos)
      << refused.error().message;
  LoadOptions options;
  options.crs = "local";
  EXPECT_TRUE(loadScene(file, options));
}

TEST(CityJson, templatesAreInstanced) {
  const std::string templates =
      R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}],
    "vertices-templates":[[0.5,0,0],[1.5,0,0],[0.5,1,0]]},)";
  const auto tree = [](const std::string& id, int vertex) {
    return "\"" + id +
           R"(":{"type":"SolitaryVegetationObject","geometry":[{"type":"GeometryInstance","template":0,"boundaries":[)" +
           std::to_string(vertex) + R"(],"transformationMatrix":[2,0,0,10, 0,2,0,0, 0,0,2,0, 0,0,0,1]}]})";
  };
  const auto scene = loaded(city(tree("a", 0) + "," + tree("b", 6), templates));
  EXPECT_EQ(scene.meshes.size(), 1U);
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.instances[0].name, "a");
  EXPECT_EQ(transformPoint(scene.instances[0].toWorld, Vec3(0.5, 1, 0)), Vec3(11, 2, 0));
  EXPECT_EQ(transformPoint(scene.instances[1].toWorld, Vec3(0.5, 1, 0)), Vec3(14, 5, 3));
  EXPECT_EQ(scene.materials[scene.meshes[0]->materials.at(0)].name, "SolitaryVegetationObject");
}

TEST(CityJson, sequence) {
  const std::string feature =
      R"({"type":"CityJSONFeature","id":"b","CityObjects":{)" + building(solid(kOuter)) + "}," + kVertices + "}";
  std::string line = feature;
  std::erase(line, '\n');
  const std::string header =
      R"({"type":"CityJSON","version":"2.0","transform":{"scale":[2,2,2],"translate":[0,0,0]},"CityObjects":{},"vertices":[]})";
  const auto scene = loaded(header + "\n" + line + "\n\n{broken\n" + line + "\n", {}, "test.city.jsonl");
  EXPECT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene::bounds(scene).max, Vec3(6, 6, 6));
  EXPECT_TRUE(warns(scene, "1 of 3 lines dropped: not a CityJSONFeature"));
}

TEST(CityJson, badSurfacesAreDroppedAndCounted) {
  const auto scene = loaded(city(building(
      R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]],[[0,1,99]],[[0,1,-1]],[[0,1]],[[3,3,3]],7,[["a"]]]})")));
  EXPECT_EQ(scene::triangleCount(scene), 1U);
  EXPECT_TRUE(warns(scene, "2 of 7 surfaces dropped: vertices that do not exist"));
  EXPECT_TRUE(warns(scene, "2 of 7 surfaces dropped: fewer than three different corners"));
  EXPECT_TRUE(warns(scene, "2 of 7 surfaces dropped: not rings of vertex indices"));
}

TEST(CityJson, whatIsNotCityJsonIsSaidSo) {
  const test::Folder folder;
  EXPECT_EQ(loadScene(folder.write("other.json", "[1,2]")).error().code, ErrorCode::input);
  const auto broken = loadScene(folder.write("broken.json", R"({"type":)"));
  EXPECT_NE(broken.error().message.find("not valid JSON"), std::string::npos);
  EXPECT_NE(loadScene(folder.write("deep.json", std::string(100000, '['))).error().message.find("nested"),
            std::string::npos);
}

}  // namespace
}  // namespace umbrage::io
