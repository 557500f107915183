#include <gtest/gtest.h>

#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"

namespace umbrage::io {
namespace {

const std::string kIv = "#Inventor V2.1 ascii\n";
const std::string kVrml = "#VRML V2.0 utf8\n";

Result<scene::Scene> load(const std::string& text, const char* name = "test.iv") {
  const test::Folder folder;
  return loadScene(folder.write(name, text));
}

scene::Scene loaded(const std::string& text, const char* name = "test.iv") {
  auto scene = load(text, name);
  EXPECT_TRUE(scene) << scene.error().text();
  return scene ? *scene : scene::Scene{};
}

bool warns(const scene::Scene& scene, const std::string& part) {
  for (const std::string& warning : scene.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

TEST(Inventor, cube) {
  const auto scene = loaded(kIv + "Cube { width 2 height 4 depth 6 }");
  EXPECT_EQ(scene::triangleCount(scene), 12U);
  EXPECT_EQ(test::wholeReport<Vec3>(scene).topology, mesh::Topology::closed);
  EXPECT_EQ(scene::bounds(scene).max, Vec3(1, 2, 3));
  EXPECT_EQ(scene.up, scene::UpAxis::y);
  EXPECT_EQ(scene.instances.at(0).name, "Cube");
}

TEST(Inventor, namesTransformsAndMaterials) {
  const auto scene = loaded(kIv + R"(
    DEF House Separator {
      DEF Brick Material { diffuseColor 1 0.5 0 transparency 0.25 }
      Translation { translation 10 0 0 }
      DEF Roof Separator { Scale { scaleFactor -2 2 2 } DEF Ridge Cube { } }
      DEF Wall Separator { Rotation { rotation 0 1 0 1.5707963 } Cube { width 4 } }
    })");
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.instances[0].name, "House/Roof/Ridge");
  EXPECT_EQ(scene.instances[1].name, "House/Wall");
  EXPECT_EQ(transformPoint(scene.instances[0].toWorld, Vec3(1, 1, 1)), Vec3(8, 2, 2));
  EXPECT_LT(glm::length(transformPoint(scene.instances[1].toWorld, Vec3(2, 0, 0)) - Vec3(10, 0, -2)), 1e-5);
  const auto& brick = scene.materials[scene.meshes[0]->materials.at(0)];
  EXPECT_EQ(brick.name, "Brick");
  EXPECT_NEAR(brick.opacity, 0.75, 1e-6);
  EXPECT_NEAR(brick.colour.x, 1.0, 1e-6);
  EXPECT_NEAR(brick.colour.y, std::pow((0.5 + 0.055) / 1.055, 2.4), 1e-6);
}

TEST(Inventor, usedTwiceIsThereTwice) {
  const auto scene = loaded(kIv + "Separator { DEF A Cube { } Translation { translation 5 0 0 } USE A }");
  EXPECT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene::bounds(scene).max, Vec3(6, 1, 1));
}

TEST(Inventor, switchesShowWhatTheySay) {
  EXPECT_EQ(scene::triangleCount(loaded(kIv + "Switch { Cube { } Cube { } }")), 0U);
  EXPECT_EQ(scene::triangleCount(loaded(kIv + "Switch { whichChild 1 Cube { } Group { Cube { } Cube { } } }")), 24U);
  EXPECT_EQ(scene::triangleCount(loaded(kIv + "Switch { whichChild -3 Cube { } Cube { } }")), 24U);
}

TEST(Inventor, facesOfTheirOwnColour) {
  const auto scene = loaded(kIv + R"(Separator {
    Material { diffuseColor [ 1 0 0, 0 0 1 ] }
    MaterialBinding { value PER_FACE }
    Coordinate3 { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }
    IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ] } })");
  const auto& materials = scene.meshes.at(0)->materials;
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(scene.materials[materials[0]].colour, Vec3(1, 0, 0));
  EXPECT_EQ(scene.materials[materials[1]].colour, Vec3(0, 0, 1));
}

// Coin reads past the default index of these bindings.
TEST(Inventor, indexedBindingsWithoutIndices) {
  for (const char* binding : {"PER_FACE_INDEXED", "PER_VERTEX_INDEXED", "PER_PART_INDEXED", "PER_VERTEX"}) {
    const auto scene = loaded(kIv + "Separator { Material { diffuseColor [ 1 0 0, 0 0 1 ] } MaterialBinding { value " +
                              binding + " } Normal { vector [ 0 0 1 ] } NormalBinding { value " + binding +
                              " } Coordinate3 { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }"
                              " IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ] } }");
    EXPECT_EQ(scene::triangleCount(scene), 2U) << binding;
  }
}

// Coin itself tells no triangle of what follows a face of two corners.
TEST(Inventor, facesAfterOneThatIsNoneAreRead) {
  const auto scene = loaded(kIv + R"(Separator {
    Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1 ] }
    MaterialBinding { value PER_FACE }
    Coordinate3 { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }
    IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 2, -1, 0, 2, 3, -1 ] } })");
  const auto& materials = scene.meshes.at(0)->materials;
  ASSERT_EQ(materials.size(), 3U) << "the second one has no area";
  EXPECT_EQ(scene.materials[materials[0]].colour, Vec3(1, 0, 0));
  EXPECT_EQ(scene.materials[materials[2]].colour, Vec3(0, 0, 1)) << "each face keeps its colour";
}

TEST(Inventor, concaveFaceWithHintIsCutInside) {
  const auto scene = loaded(kIv + R"(Separator { ShapeHints { faceType UNKNOWN_FACE_TYPE }
    Coordinate3 { point [ 0 0 0, 4 0 0, 4 1 0, 1 1 0, 1 4 0, 0 4 0 ] } FaceSet { numVertices 6 } })");
  EXPECT_EQ(scene::triangleCount(scene), 4U);
  double area = 0.0;
  const mesh::Mesh& m = *scene.meshes.at(0);
  for (const mesh::Triangle& t : m.triangles)
    area += 0.5 * glm::length(glm::cross(m.positions[t[1]] - m.positions[t[0]], m.positions[t[2]] - m.positions[t[0]]));
  EXPECT_NEAR(area, 7.0, 1e-6);
}

TEST(Inventor, lights) {
  const auto scene = loaded(kIv + R"(Separator { Translation { translation 1 0 0 }
    DEF Lamp PointLight { location 0 2 0 color 1 0 0 intensity 0.5 }
    DirectionalLight { direction 0 -1 0 } SpotLight { location 0 5 0 direction 0 -1 0 cutOffAngle 0.5 }
    PointLight { on FALSE } })");
  ASSERT_EQ(scene.lights.size(), 3U);
  EXPECT_EQ(scene.lights[0].name, "Lamp");
  EXPECT_EQ(std::get<scene::PointLight>(scene.lights[0].shape).position, Vec3(1, 2, 0));
  EXPECT_EQ(scene.lights[0].colour, Vec3(1, 0, 0));
  EXPECT_EQ(scene.lights[0].intensity, 0.5);
  EXPECT_EQ(std::get<scene::DirectionalLight>(scene.lights[1].shape).direction, Vec3(0, -1, 0));
  EXPECT_NEAR(std::get<scene::SpotLight>(scene.lights[2].shape).cutoff.radians(), 0.5, 1e-6);
}

TEST(Inventor, indicesOutOfRangeDropTheShape) {
  const auto scene = loaded(kIv + R"(Separator { Cube { } Coordinate3 { point [ 0 0 0, 1 0 0, 1 1 0 ] }
    IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 1, 99999, -1 ] } })");
  EXPECT_EQ(scene::triangleCount(scene), 12U);
  EXPECT_TRUE(warns(scene, "1 shape dropped"));
}

TEST(Inventor, aNodeThatContainsItselfIsRefused) {
  const auto scene = load(kIv + "DEF Loop Separator { Cube { } USE Loop }");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "a node contains itself (Loop)");
}

TEST(Inventor, twentyThousandNestedNodesAreFine) {
  std::string text = kIv;
  for (int i = 0; i < 20000; ++i) text += "Separator {";
  text += "Cube { }";
  EXPECT_EQ(scene::triangleCount(loaded(text + std::string(20000, '}'))), 12U);
}

TEST(Inventor, includesOnlyFromItsOwnFolder) {
  const test::Folder folder, elsewhere;
  folder.write("part.iv", kIv + "Cube { }");
  const auto secret = elsewhere.write("secret.iv", kIv + "Cube { }");
  const auto scene = loadScene(folder.write("whole.iv", kIv + "Separator { File { name \"part.iv\" } File { name \"" +
                                                            secret.string() + "\" } File { name \"gone.iv\" } }"));
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene::triangleCount(*scene), 12U);
  EXPECT_TRUE(warns(*scene, "secret.iv"));
  EXPECT_TRUE(warns(*scene, "gone.iv"));
}

TEST(Inventor, includingItselfEnds) {
  const test::Folder folder;
  const auto scene = loadScene(folder.write("self.iv", kIv + "Separator { Cube { } File { name \"self.iv\" } }"));
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_TRUE(warns(*scene, "without end"));
}

TEST(Inventor, animationStandsStill) {
  const std::string text = kIv + "Separator { Rotor { rotation 0 0 1 0.3 speed 5 } Cube { } }";
  const auto a = loaded(text), b = loaded(text);
  EXPECT_EQ(a.instances.at(0).toWorld, b.instances.at(0).toWorld);
}

TEST(Inventor, syntaxErrorsNameTheLine) {
  const auto scene = load(kIv + "Separator {\n Cube { width }\n}");
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message.find("line"), std::string::npos) << scene.error().message;
}

TEST(Vrml, version1) {
  const auto scene =
      loaded("#VRML V1.0 ascii\nDEF Tower Separator { Material { diffuseColor 0 1 0 } Cube { } }", "test.wrl");
  EXPECT_EQ(scene::triangleCount(scene), 12U);
  EXPECT_EQ(scene.instances.at(0).name, "Tower");
  EXPECT_EQ(scene.materials[scene.meshes[0]->materials.at(0)].colour, Vec3(0, 1, 0));
}

TEST(Vrml, version97) {
  const auto scene = loaded(kVrml + R"(DEF Site Transform { translation 0 0 5 children [
      DEF Hall Shape { appearance Appearance { material Material { diffuseColor 0 0 1 transparency 0.5 } }
        geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 2 0 0, 2 2 0, 0 2 0 ] } coordIndex [ 0 1 2 3 -1 ] } } ] }
      PointLight { location 1 2 3 })",
                            "test.wrl");
  EXPECT_EQ(scene::triangleCount(scene), 2U);
  EXPECT_EQ(scene.instances.at(0).name, "Site/Hall");
  EXPECT_EQ(scene::bounds(scene).min, Vec3(0, 0, 5));
  const auto& material = scene.materials[scene.meshes[0]->materials.at(0)];
  EXPECT_EQ(material.colour, Vec3(0, 0, 1));
  EXPECT_EQ(material.opacity, 0.5);
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(std::get<scene::PointLight>(scene.lights[0].shape).position, Vec3(1, 2, 3));
}

TEST(Vrml, inlinesFromItsOwnFolder) {
  const test::Folder folder;
  folder.write("part.wrl", kVrml + "Shape { geometry Box { } }");
  const auto scene = loadScene(folder.write(
      "whole.wrl",
      kVrml + "Transform { translation 5 0 0 children [ Inline { url \"part.wrl\" } Inline { url \"whole.wrl\" } ] }"));
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene::triangleCount(*scene) % 12, 0U);
  EXPECT_GE(scene::triangleCount(*scene), 12U);
  EXPECT_TRUE(warns(*scene, "without end"));
}

}  // namespace
}  // namespace umbrage::io
