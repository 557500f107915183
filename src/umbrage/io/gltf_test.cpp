#include <gtest/gtest.h>

#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"
#include "umbrage/io/test_gltf.hpp"

namespace umbrage::io {
namespace {

using test::base64;
using test::bytesOf;

// A unit cube: 8 corners (96 bytes), then 36 short indices (72 bytes).
const std::vector<float> kCorners = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
const std::vector<std::uint16_t> kIndices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                             1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
std::string cubeBytes() { return bytesOf(kCorners) + bytesOf(kIndices); }

std::string buffer(const std::string& bytes) {
  return R"("buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
         R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + R"("}],)";
}

const std::string kCubeViews =
    R"("bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},
               {"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)";
const std::string kCubeMesh = R"("meshes":[{"name":"cube","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)";

std::string gltf(const std::string& content) { return R"({"asset":{"version":"2.0"},)" + content + "}"; }
std::string cubes(const std::string& nodes) { return gltf(buffer(cubeBytes()) + kCubeViews + kCubeMesh + nodes); }

Result<scene::Scene> load(const std::string& text, const char* name = "test.gltf") {
  const test::Folder folder;
  return loadScene(folder.write(name, text));
}

scene::Scene loaded(const std::string& text, const char* name = "test.gltf") {
  auto scene = load(text, name);
  EXPECT_TRUE(scene) << scene.error().text();
  return scene ? *scene : scene::Scene{};
}

TEST(Gltf, cubeIsClosed) {
  const auto scene = loaded(cubes(R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])"));
  EXPECT_EQ(scene::triangleCount(scene), 12U);
  EXPECT_EQ(test::wholeReport<Vec3>(scene).topology, mesh::Topology::closed);
  EXPECT_EQ(scene.up, scene::UpAxis::y);
  EXPECT_EQ(scene.instances.at(0).name, "cube");
}

TEST(Gltf, binaryFile) {
  std::string json = gltf(R"("buffers":[{"byteLength":168}],)" + kCubeViews + kCubeMesh + R"("nodes":[{"mesh":0}])");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    const auto word32 = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&word32), 4);
  };
  const std::string glb = "glTF" + word(2) + word(12 + 8 + json.size() + 8 + 168) + word(json.size()) + "JSON" + json +
                          word(168) + std::string("BIN\0", 4) + cubeBytes();
  EXPECT_EQ(scene::triangleCount(loaded(glb, "test.glb")), 12U);
}

TEST(Gltf, hierarchyInstancesAndTransforms) {
  const auto scene = loaded(cubes(R"("nodes":[
    {"name":"House","children":[1,2],"translation":[10,0,0]},
    {"name":"Roof","mesh":0,"translation":[0,5,0],"scale":[2,2,2]},
    {"name":"a/b","mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,7,1]}],"scenes":[{"nodes":[0]}],"scene":0)"));
  EXPECT_EQ(scene.meshes.size(), 1U);
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.instances[0].name, "House/Roof");
  EXPECT_EQ(scene.instances[1].name, "House/a_b");
  EXPECT_EQ(transformPoint(scene.instances[0].toWorld, Vec3(1, 1, 1)), Vec3(12, 7, 2));
  EXPECT_EQ(transformPoint(scene.instances[1].toWorld, Vec3(1, 1, 1)), Vec3(9, 1, 8));
}

TEST(Gltf, rotationIsAQuaternionXyzw) {
  // A quarter turn about z.
  const auto scene = loaded(cubes(R"("nodes":[{"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476]}])"));
  EXPECT_LT(glm::length(transformPoint(scene.instances.at(0).toWorld, Vec3(1, 0, 0)) - Vec3(0, 1, 0)), 1e-12);
}

TEST(Gltf, materialsKeepLinearColourOpacityAndName) {
  const auto scene = loaded(gltf(buffer(cubeBytes()) + kCubeViews + R"("materials":[
    {"name":"brick","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,0.5]}},
    {"name":"glass","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0,0,1,0.25]}},
    {"name":"cut","alphaMode":"MASK","alphaCutoff":0.6,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0},
                             {"attributes":{"POSITION":0},"indices":1,"material":1}]}],"nodes":[{"mesh":0}])"));
  ASSERT_EQ(scene.meshes.size(), 1U);
  const auto& materials = scene.meshes[0]->materials;
  ASSERT_EQ(materials.size(), 24U);
  const auto& brick = scene.materials[materials[0]];
  EXPECT_EQ(brick.name, "brick");
  EXPECT_EQ(brick.colour, Vec3(0.5, 0.25, 0.125));
  EXPECT_EQ(brick.opacity, 1.0);
  EXPECT_EQ(scene.materials[materials[23]].name, "glass");
  EXPECT_EQ(scene.materials[materials[23]].opacity, 0.25);
  EXPECT_EQ(scene.materials.at(2).opacity, 0.0);
}

TEST(Gltf, whatShinesMirrorsAndBendsLight) {
  const auto scene = loaded(
      gltf(buffer(cubeBytes()) + kCubeViews + R"("extensionsUsed":["KHR_materials_emissive_strength"],"materials":[
    {"name":"lamp","emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}},
    {"name":"mirror","pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0}},
    {"name":"brushed","pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0.5}},
    {"name":"painted","pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0,"metallicRoughnessTexture":{"index":0}}},
    {"name":"pane","extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.7}}},
    {"name":"lens","extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.7},"KHR_materials_volume":{"thicknessFactor":1}}}],
    "textures":[{}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],"nodes":[{"mesh":0}])"));
  EXPECT_EQ(scene.materials.at(0).emission, Vec3(4, 2, 0));
  EXPECT_EQ(scene.materials.at(0).mirror, 0.0);
  EXPECT_EQ(scene.materials.at(1).mirror, 1.0);
  EXPECT_EQ(scene.materials.at(2).mirror, 0.25);
  EXPECT_EQ(scene.materials.at(3).mirror, 0.0);
  EXPECT_EQ(scene.materials.at(4).ior, 1.0);
  EXPECT_EQ(scene.materials.at(5).ior, 1.7);
}

TEST(Gltf, whatLetsLightThrough) {
  const auto scene =
      loaded(gltf(buffer(cubeBytes()) + kCubeViews + R"("extensionsUsed":["KHR_materials_transmission"],"materials":[
    {"name":"clear","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.2,0.4,0.6,0]}},
    {"name":"tinted","pbrMetallicRoughness":{"baseColorFactor":[0.5,1,0.25,1]},"extensions":{"KHR_materials_transmission":{"transmissionFactor":0.8}}},
    {"name":"beyond","pbrMetallicRoughness":{"baseColorFactor":[1.0000001,-1,0.5,1]},"extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}},
    {"name":"odd","extensions":{"KHR_materials_transmission":{"transmissionFactor":"much"}}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],"nodes":[{"mesh":0}])"));
  EXPECT_EQ(scene::transmittance(scene.materials.at(0)), Vec3(1.0));
  EXPECT_LT(glm::length(scene::transmittance(scene.materials.at(1)) - 0.8 * Vec3(0.5, 1, 0.25)), 1e-12);
  EXPECT_NEAR(scene.materials.at(1).opacity, 0.2, 1e-12);
  EXPECT_EQ(scene::transmittance(scene.materials.at(2)), Vec3(1, 0, 0.5));
  EXPECT_EQ(scene.materials.at(3).opacity, 1.0);
  EXPECT_TRUE(scene.warnings.empty());
}

scene::Scene withMode(int mode, const std::vector<float>& points) {
  const auto count = std::to_string(points.size() / 3);
  const std::string bytes = bytesOf(points);
  return loaded(gltf(buffer(bytes) + R"("bufferViews":[{"buffer":0,"byteLength":)" + std::to_string(bytes.size()) +
                     R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" + count +
                     R"(,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":)" +
                     std::to_string(mode) + R"(}]}],"nodes":[{"mesh":0}])"));
}

TEST(Gltf, stripsAndFansWindAlike) {
  const auto strip = withMode(5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  EXPECT_EQ(scene::triangleCount(strip), 3U);
  EXPECT_EQ(test::wholeReport<Vec3>(strip).windingFlips, 0U);
  EXPECT_EQ(test::wholeReport<Vec3>(strip).borderEdges, 5U);
  const auto fan = withMode(6, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0});
  EXPECT_EQ(scene::triangleCount(fan), 3U);
  EXPECT_EQ(test::wholeReport<Vec3>(fan).windingFlips, 0U);
  EXPECT_EQ(scene::triangleCount(withMode(4, {0, 0, 0, 1, 0, 0, 0, 1, 0})), 1U);
}

TEST(Gltf, pointsAndLinesGiveAnEmptyScene) {
  EXPECT_EQ(scene::triangleCount(withMode(0, {0, 0, 0, 1, 0, 0, 0, 1, 0})), 0U);
  EXPECT_EQ(scene::triangleCount(withMode(3, {0, 0, 0, 1, 0, 0, 0, 1, 0})), 0U);
}

TEST(Gltf, sparseAccessorReplacesCorners) {
  // Corner 6 becomes (5, 5, 5).
  const std::string bytes =
      cubeBytes() + bytesOf(std::vector<std::uint16_t>{6, 0}) + bytesOf(std::vector<float>{5, 5, 5});
  const auto scene = loaded(gltf(buffer(bytes) + R"("bufferViews":[{"buffer":0,"byteLength":96},
    {"buffer":0,"byteOffset":96,"byteLength":72},{"buffer":0,"byteOffset":168,"byteLength":4},
    {"buffer":0,"byteOffset":172,"byteLength":12}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","sparse":{"count":1,
      "indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":3}}},
      {"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)" +
                                 kCubeMesh + R"("nodes":[{"mesh":0}])"));
  EXPECT_EQ(scene::bounds(scene).max, Vec3(5, 5, 5));
  EXPECT_EQ(test::wholeReport<Vec3>(scene).topology, mesh::Topology::closed);
}

TEST(Gltf, stridesAndOffsets) {
  // Each corner followed by 8 bytes of something else, after 4 bytes of something else.
  std::string bytes = "skip";
  for (std::size_t i = 0; i < 8; ++i)
    bytes += bytesOf(std::vector<float>(kCorners.begin() + 3 * i, kCorners.begin() + 3 * i + 3)) + "ABCDEFGH";
  const std::string offset = std::to_string(bytes.size());
  bytes += bytesOf(kIndices);
  const auto scene = loaded(
      gltf(buffer(bytes) + R"("bufferViews":[{"buffer":0,"byteLength":164,"byteStride":20},{"buffer":0,"byteOffset":)" +
           offset + R"(,"byteLength":72}],
    "accessors":[{"bufferView":0,"byteOffset":4,"componentType":5126,"count":8,"type":"VEC3"},
      {"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)" +
           kCubeMesh + R"("nodes":[{"mesh":0}])"));
  EXPECT_EQ(test::wholeReport<Vec3>(scene).topology, mesh::Topology::closed);
  EXPECT_EQ(scene::bounds(scene).max, Vec3(1, 1, 1));
}

TEST(Gltf, quantisedPositions) {
  const std::vector<std::int16_t> points = {-32768, 0, 0, 0, 32767, 0, 0, 0, 0, 0, 0, 0};
  const std::string bytes = bytesOf(points);
  const auto scene =
      loaded(gltf(R"("extensionsRequired":["KHR_mesh_quantization"],"extensionsUsed":["KHR_mesh_quantization"],)" +
                  buffer(bytes) + R"("bufferViews":[{"buffer":0,"byteLength":24,"byteStride":8}],
    "accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}])"));
  EXPECT_EQ(scene::bounds(scene).min, Vec3(-1, 0, 0));
  EXPECT_EQ(scene::bounds(scene).max, Vec3(1, 0, 0));
}

TEST(Gltf, externalBufferInTheSameFolderOnly) {
  const test::Folder folder, elsewhere;
  folder.write("cube data.bin", cubeBytes());
  const auto secret = elsewhere.write("secret.bin", cubeBytes());
  const auto text = [](const std::string& uri) {
    return gltf(R"("buffers":[{"byteLength":168,"uri":")" + uri + R"("}],)" + kCubeViews + kCubeMesh +
                R"("nodes":[{"mesh":0}])");
  };
  const auto inside = loadScene(folder.write("inside.gltf", text("cube%20data.bin")));
  ASSERT_TRUE(inside) << inside.error().text();
  EXPECT_EQ(scene::triangleCount(*inside), 12U);
  EXPECT_FALSE(
      loadScene(folder.write("outside.gltf", text("../" + elsewhere.path().filename().string() + "/secret.bin"))));
  EXPECT_FALSE(loadScene(folder.write("absolute.gltf", text(secret.string()))));
}

TEST(Gltf, aNodeGraphThatIsNoTreeIsRefused) {
  const auto cycle = load(cubes(R"("nodes":[{"children":[1]},{"children":[0],"mesh":0}],"scenes":[{"nodes":[0]}])"));
  ASSERT_FALSE(cycle);
  EXPECT_NE(cycle.error().message.find("not a tree"), std::string::npos);
  EXPECT_FALSE(load(cubes(R"("nodes":[{"children":[2]},{"children":[2]},{"mesh":0}],"scenes":[{"nodes":[0,1]}])")));
  EXPECT_FALSE(load(cubes(R"("nodes":[{"children":[77]}],"scenes":[{"nodes":[0]}])")));
}

TEST(Gltf, aChainOfTwentyThousandNodesIsFine) {
  std::string nodes = R"("nodes":[)";
  for (int i = 0; i < 19999; ++i) nodes += R"({"name":"link","children":[)" + std::to_string(i + 1) + "]},";
  EXPECT_EQ(scene::triangleCount(loaded(cubes(nodes + R"({"mesh":0}],"scenes":[{"nodes":[0]}])"))), 12U);
}

TEST(Gltf, requiredExtensions) {
  const auto refused = load(gltf(R"("extensionsRequired":["EXT_meshopt_compression"],"nodes":[])"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_NE(refused.error().message.find("EXT_meshopt_compression"), std::string::npos);
  EXPECT_TRUE(load(gltf(R"("extensionsRequired":["KHR_materials_ior"],"nodes":[])")));
}

TEST(Gltf, versionOneIsUnsupported) {
  EXPECT_EQ(load(R"({"asset":{"version":"1.0"},"nodes":{}})").error().code, ErrorCode::unsupported);
}

TEST(Gltf, accessorsBeyondTheirBuffersAreErrors) {
  const auto broken = [](const std::string& accessor) {
    const auto scene =
        load(gltf(buffer(cubeBytes()) + R"("bufferViews":[{"buffer":0,"byteLength":96}],"accessors":[)" + accessor +
                  R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}])"));
    return !scene && scene.error().message.find("parser crash") == std::string::npos;
  };
  EXPECT_TRUE(broken(R"({"bufferView":0,"componentType":5126,"count":9,"type":"VEC3"})"));
  EXPECT_TRUE(broken(R"({"bufferView":0,"byteOffset":4,"componentType":5126,"count":8,"type":"VEC3"})"));
  EXPECT_TRUE(broken(R"({"bufferView":0,"componentType":5126,"count":4000000000,"type":"VEC3"})"));
  EXPECT_TRUE(broken(R"({"bufferView":0,"componentType":5126,"count":6148914691236517206,"type":"VEC3"})"));
  EXPECT_TRUE(broken(R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC2"})"));
  EXPECT_FALSE(broken(R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"})"));
}

TEST(Gltf, aCornerThatDoesNotExistIsCounted) {
  auto indices = kIndices;
  indices[4] = 8;
  const auto scene =
      loaded(gltf(buffer(bytesOf(kCorners) + bytesOf(indices)) + kCubeViews + kCubeMesh + R"("nodes":[{"mesh":0}])"));
  EXPECT_EQ(scene::triangleCount(scene), 11U);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_EQ(scene.warnings[0], "1 of 12 triangles dropped: corners that do not exist");
}

}  // namespace
}  // namespace umbrage::io
