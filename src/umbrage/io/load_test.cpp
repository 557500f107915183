// The formats that come through assimp, and what holds for all.
#include "umbrage/io/load.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <numbers>

#include "umbrage/io/test_data.hpp"

namespace umbrage::io {
namespace {

scene::Scene loaded(const std::filesystem::path& file, const LoadOptions& options = {}) {
  auto scene = loadScene(file, options);
  EXPECT_TRUE(scene) << scene.error().text();
  return scene ? *scene : scene::Scene{};
}

void expectBox(const scene::Scene& scene, const Vec3& min, const Vec3& max) {
  const Box3 box = scene::bounds(scene);
  EXPECT_EQ(box.min, min);
  EXPECT_EQ(box.max, max);
}

void expectClosedBox(const scene::Scene& scene) {
  EXPECT_EQ(scene::triangleCount(scene), 12U);
  EXPECT_EQ(test::wholeReport<Vec3>(scene).topology, mesh::Topology::closed);
  expectBox(scene, {0, 0, 0}, {1, 2, 3});
}

bool warns(const scene::Scene& scene, const std::string& part) {
  for (const std::string& warning : scene.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

const std::string kCorners = "0 0 0\n1 0 0\n1 2 0\n0 2 0\n0 0 3\n1 0 3\n1 2 3\n0 2 3\n";
const int kQuads[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
const float kPoints[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}};

std::string objVertices() {
  std::string text;
  for (const auto& p : kPoints)
    text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  return text;
}

std::string objFaces(int base = 1) {
  std::string text;
  for (const auto& quad : kQuads) {
    text += "f";
    for (const int corner : quad) text += " " + std::to_string(corner + base);
    text += "\n";
  }
  return text;
}

TEST(Load, refusesWhatIsNotAFile) {
  EXPECT_EQ(loadScene("/nowhere.obj").error().code, ErrorCode::input);
  EXPECT_EQ(loadScene("/nowhere.obj").error().where, "/nowhere.obj");
  EXPECT_EQ(loadScene("/tmp").error().code, ErrorCode::input);
}

TEST(Load, refusesAPipeWithoutWaiting) {
  const test::Folder folder;
  const auto pipe = folder.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(loadScene(pipe).error().message, "is not a regular file");
}

TEST(Load, refusesUnknownFormatsAndNamesTheKnownOnes) {
  const test::Folder folder;
  const auto scene = loadScene(folder.write("scene.xyz", ""));
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::unsupported);
  EXPECT_NE(scene.error().message.find(".glb"), std::string::npos);
}

TEST(Load, refusesSenselessOptions) {
  LoadOptions options;
  options.metresPerUnit = -1.0;
  EXPECT_EQ(loadScene("x.obj", options).error().code, ErrorCode::usage);
}

TEST(Load, obeysTheCallersFrame) {
  const test::Folder folder;
  LoadOptions options;
  options.up = scene::UpAxis::z;
  options.metresPerUnit = 0.001;
  options.north = Angle::degrees(10);
  const auto scene = loaded(folder.write("box.obj", objVertices() + objFaces()), options);
  EXPECT_EQ(scene.up, scene::UpAxis::z);
  EXPECT_EQ(scene.metresPerUnit, 0.001);
  EXPECT_DOUBLE_EQ(scene.northOffset.degrees(), 10.0);
}

TEST(Load, givesTheSameSceneEveryTime) {
  const test::Folder folder;
  const auto file = folder.write("box.obj", objVertices() + objFaces());
  const auto a = loaded(file), b = loaded(file);
  ASSERT_EQ(a.meshes.size(), 1U);
  EXPECT_EQ(a.meshes[0]->positions, b.meshes[0]->positions);
  EXPECT_EQ(a.meshes[0]->triangles, b.meshes[0]->triangles);
}

// Sanitizers reserve so many addresses that the reader sets no limit under them.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Load, aSmallMemoryLimitIsAnErrorNotAnEnd) {
  const test::Folder folder;
  LoadOptions options;
  options.memoryLimit = std::size_t{100} << 20;
  const auto scene = loadScene(folder.write("box.obj", objVertices() + objFaces()), options);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::input);
}
#endif

TEST(Obj, box) {
  const test::Folder folder;
  const auto scene = loaded(folder.write("box.OBJ", objVertices() + objFaces()));
  expectClosedBox(scene);
  EXPECT_EQ(scene.up, scene::UpAxis::y);
  EXPECT_EQ(scene.meshes[0]->positions.size(), 8U);
}

TEST(Obj, relativeIndices) {
  const test::Folder folder;
  expectClosedBox(loaded(folder.write("box.obj", objVertices() + objFaces(-8))));
}

TEST(Obj, objectsGroupsMaterialsAndOpacity) {
  const test::Folder folder;
  folder.write("look.mtl", "newmtl brick\nKd 1 0.5 0\nnewmtl glass\nKd 0 0 1\nd 0.25\n");
  const auto scene = loaded(folder.write("two.obj", "mtllib look.mtl\n" + objVertices() + "o wall\nusemtl brick\n" +
                                                        objFaces() + "g pane\nusemtl glass\nf 1 2 3\n"));
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.instances[0].name, "wall");
  EXPECT_EQ(scene.instances[1].name, "pane");
  const auto& pane = scene.materials[scene.meshes[scene.instances[1].mesh]->materials.at(0)];
  EXPECT_EQ(pane.name, "glass");
  EXPECT_NEAR(pane.opacity, 0.25, 1e-6);
  EXPECT_NEAR(pane.colour.z, 1.0, 1e-6);
  const auto& brick = scene.materials[scene.meshes[scene.instances[0].mesh]->materials.at(0)];
  EXPECT_NEAR(brick.colour.y, std::pow((0.5 + 0.055) / 1.055, 2.4), 1e-6);
}

TEST(Obj, oneObjectOfTwoMaterialsIsOnePart) {
  const test::Folder folder;
  folder.write("look.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
  const auto scene = loaded(folder.write(
      "two.obj",
      "mtllib look.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no part\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\n"));
  ASSERT_EQ(scene.instances.size(), 1U);
  const auto& materials = scene.meshes[0]->materials;
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(scene.materials[materials[0]].name, "a");
  EXPECT_EQ(scene.materials[materials[1]].name, "b");
}

TEST(Obj, aMissingMaterialFileIsAWarning) {
  const test::Folder folder;
  const auto scene =
      loaded(folder.write("box.obj", "mtllib gone.mtl\n" + objVertices() + "usemtl brick\n" + objFaces()));
  expectClosedBox(scene);
  EXPECT_TRUE(warns(scene, "gone.mtl"));
}

TEST(Obj, concavePolygonIsCutInside) {
  const test::Folder folder;
  const auto scene =
      loaded(folder.write("l.obj", "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 1 1 0\nv 1 4 0\nv 0 4 0\nf 1 2 3 4 5 6\n"));
  double area = 0.0;
  const mesh::Mesh& m = *scene.meshes.at(0);
  for (const mesh::Triangle& t : m.triangles)
    area += 0.5 * glm::length(glm::cross(m.positions[t[1]] - m.positions[t[0]], m.positions[t[2]] - m.positions[t[0]]));
  EXPECT_NEAR(area, 7.0, 1e-9);
}

// A ring that crosses itself has no ears; the two caps of this prism must still share all edges with its sides.
TEST(Obj, aPrismOverACrossingRingIsClosed) {
  const test::Folder folder;
  const auto scene = loaded(folder.write("prism.obj",
                                         "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nv 0 0 1\nv 2 2 1\nv 2 0 1\nv 0 2 1\n"
                                         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"));
  EXPECT_EQ(test::wholeReport<Vec3>(scene).borderEdges, 0U);
}

TEST(Obj, whatIsNotFiniteIsDroppedAndCounted) {
  const test::Folder folder;
  const auto scene =
      loaded(folder.write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 1e39 0 0\nf 1 2 3\nf 1 2 4\nf 2 3 5\n"));
  EXPECT_EQ(scene::triangleCount(scene), 1U);
  EXPECT_TRUE(warns(scene, "2 of 3 triangles dropped: coordinates not finite"));
}

TEST(Obj, namesBecomeUtf8) {
  const test::Folder folder;
  const auto scene = loaded(folder.write("latin.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no T\xfcr\x1b[31m\nf 1 2 3\n"));
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.instances[0].name, "T\xc3\xbcr [31m");
}

TEST(Obj, farCoordinatesInSinglePrecisionAreSaid) {
  const test::Folder folder;
  const auto scene = loaded(folder.write("far.obj", "v 5790123.4 0 0\nv 5790133.4 0 0\nv 5790123.4 10 0\nf 1 2 3\n"));
  EXPECT_TRUE(warns(scene, "far from the origin"));
}

TEST(Obj, anEmptyOneIsAnEmptySceneWithAWarning) {
  const test::Folder folder;
  const auto scene = loaded(folder.write("points.obj", "# nothing but points here\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"));
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(warns(scene, "no triangles"));
}

TEST(Obj, filesOutsideTheFolderAreNotRead) {
  const test::Folder outside, folder;
  const auto secret = outside.write("secret.mtl", "newmtl secret\nKd 1 0 0\n");
  const auto scene = loaded(
      folder.write("box.obj", "mtllib " + secret.string() + "\n" + objVertices() + "usemtl secret\n" + objFaces()));
  for (const scene::Material& m : scene.materials) EXPECT_NE(m.colour, Vec3(1, 0, 0));
}

TEST(Ply, box) {
  const test::Folder folder;
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face 6\n"
      "property list uchar int vertex_indices\nend_header\n" +
      kCorners;
  for (const auto& q : kQuads)
    text += "4 " + std::to_string(q[0]) + " " + std::to_string(q[1]) + " " + std::to_string(q[2]) + " " +
            std::to_string(q[3]) + "\n";
  const auto scene = loaded(folder.write("box.ply", text));
  expectClosedBox(scene);
  EXPECT_EQ(scene.up, scene::UpAxis::y);
}

TEST(Off, box) {
  const test::Folder folder;
  std::string text = "OFF\n8 6 12\n" + kCorners;
  for (const auto& q : kQuads)
    text += "4 " + std::to_string(q[0]) + " " + std::to_string(q[1]) + " " + std::to_string(q[2]) + " " +
            std::to_string(q[3]) + "\n";
  const auto scene = loaded(folder.write("box.off", text));
  expectClosedBox(scene);
  EXPECT_EQ(scene.up, scene::UpAxis::z);
}

template <class T>
void put(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

TEST(Stl, binaryBox) {
  const test::Folder folder;
  std::string text(80, ' ');
  put<std::uint32_t>(text, 12);
  for (const auto& q : kQuads)
    for (const auto& t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
      text.append(12, '\0');
      for (const int corner : t) put(text, kPoints[corner]);
      text.append(2, '\0');
    }
  const auto scene = loaded(folder.write("box.stl", text));
  expectClosedBox(scene);
  EXPECT_EQ(scene.up, scene::UpAxis::z);
}

TEST(Stl, asciiTriangle) {
  const test::Folder folder;
  const auto scene =
      loaded(folder.write("one.stl",
                          "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                          "endloop\nendfacet\nendsolid one\n"));
  EXPECT_EQ(scene::triangleCount(scene), 1U);
  EXPECT_EQ(scene.instances.at(0).name, "one");
}

std::string chunk(std::uint16_t id, const std::string& content) {
  std::string text;
  put(text, id);
  put(text, static_cast<std::uint32_t>(content.size() + 6));
  return text + content;
}

// assimp turns 3DS to Y up; the file's own coordinates must come back, exactly.
TEST(ThreeDs, boxKeepsItsAxes) {
  const test::Folder folder;
  std::string vertices, faces;
  put<std::uint16_t>(vertices, 8);
  for (const auto& p : kPoints) put(vertices, p);
  put<std::uint16_t>(faces, 12);
  for (const auto& q : kQuads)
    for (const auto& t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
      for (const int corner : t) put(faces, static_cast<std::uint16_t>(corner));
      put<std::uint16_t>(faces, 7);
    }
  const std::string object =
      std::string("tower") + '\0' + chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces));
  const auto scene = loaded(folder.write("box.3ds", chunk(0x4d4d, chunk(0x3d3d, chunk(0x4000, object)))));
  expectClosedBox(scene);
  EXPECT_EQ(scene.up, scene::UpAxis::z);
}

TEST(X3d, boxKeepsItsAxes) {
  const test::Folder folder;
  std::string indices;
  for (const auto& q : kQuads)
    for (const int corner : {q[0], q[1], q[2], q[3], -1}) indices += std::to_string(corner) + " ";
  std::string points = kCorners;
  for (char& c : points)
    if (c == '\n') c = ' ';
  const auto scene = loaded(folder.write(
      "box.x3d",
      "<?xml version=\"1.0\"?><X3D version=\"3.0\" profile=\"Interchange\"><Scene><Shape><Appearance><Material "
      "diffuseColor=\"1 0 0\" transparency=\"0.5\"/></Appearance><IndexedFaceSet coordIndex=\"" +
          indices + "\"><Coordinate point=\"" + points + "\"/></IndexedFaceSet></Shape></Scene></X3D>"));
  expectClosedBox(scene);
  EXPECT_EQ(scene.up, scene::UpAxis::y);
}

// The same house stands in the collection as CityJSON, whose coordinates are known without assimp.
TEST(Ifc, keepsItsAxesAndMetres) {
  const auto data = test::testData();
  if (data.empty()) GTEST_SKIP() << "no test data: set UMBRAGE_TEST_DATA";
  const auto ifc = loaded(data / "architecture/AC14-FZK-Haus.ifc");
  EXPECT_EQ(ifc.up, scene::UpAxis::z);
  const Box3 box = scene::bounds(ifc);
  EXPECT_LT(glm::length(box.min - Vec3(-3, -3, -1)), 1e-4);
  EXPECT_LT(glm::length(box.max - Vec3(15, 13, 6.3177)), 1e-4);
}

}  // namespace
}  // namespace umbrage::io
