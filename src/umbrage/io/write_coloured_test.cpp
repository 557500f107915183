#include "umbrage/io/write_coloured.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "umbrage/base/file.hpp"
#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"

namespace umbrage::io {
namespace {

ColouredMesh sample() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 2, 1}, {2, 2, 1}},
          {{0, 1, 2}, {1, 3, 2}},
          {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}},
          {{7, 0, 0}, {0, 7, 0}, {0, 0, 7}, {3.5f, 3.5f, 3.5f}}};
}

std::string bytesOf(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
}

scene::Scene frame() {
  scene::Scene scene;
  scene.materials.push_back({"grey", Vec3(0.8)});
  return scene;
}

// What this project's own readers make of the files: the same triangles, turned to Y up.
TEST(WriteColoured, FilesReadBack) {
  const test::Folder folder;
  for (const char* name : {"light.glb", "light.ply"}) {
    const auto path = folder.path() / name;
    ASSERT_TRUE(writeColoured(sample(), frame(), path));
    const auto scene = loadScene(path);
    ASSERT_TRUE(scene) << scene.error().text();
    EXPECT_EQ(scene::triangleCount(*scene), 2u) << name;
    const Box3 box = scene::bounds(*scene);
    EXPECT_EQ(box.min, Vec3(0, 0, -2)) << name;
    EXPECT_EQ(box.max, Vec3(2, 1, 0)) << name;
  }
}

TEST(WriteColoured, GlbHoldsColoursAndExitance) {
  const test::Folder folder;
  ASSERT_TRUE(writeColoured(sample(), frame(), folder.path() / "a.glb"));
  const std::string bytes = bytesOf(folder.path() / "a.glb");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  const auto json = nlohmann::json::parse(bytes.substr(20, length));
  const auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  const auto floats = [&](const char* name, std::size_t i) {
    const auto& view =
        json["bufferViews"][json["accessors"][attributes[name].get<std::size_t>()]["bufferView"].get<std::size_t>()];
    float value = 0;
    std::memcpy(&value, bytes.data() + 28 + length + view["byteOffset"].get<std::size_t>() + 4 * i, 4);
    return value;
  };
  EXPECT_EQ(floats("COLOR_0", 0), 1.0f);
  EXPECT_EQ(floats("COLOR_0", 9), 0.5f);
  EXPECT_EQ(floats("_EXITANCE", 4), 7.0f);
  EXPECT_EQ(json["extensionsUsed"][0], "KHR_materials_unlit");
}

TEST(WriteColoured, PlyHoldsColoursAndExitance) {
  const test::Folder folder;
  ASSERT_TRUE(writeColoured(sample(), frame(), folder.path() / "a.ply"));
  const std::string bytes = bytesOf(folder.path() / "a.ply");
  const std::size_t data = bytes.find("end_header\n") + 11, row = 3 * 8 + 3 + 3 * 4;
  EXPECT_EQ(bytes.size(), data + 4 * row + 2 * 13);
  EXPECT_EQ(static_cast<unsigned char>(bytes[data + 24]), 255);
  EXPECT_EQ(static_cast<unsigned char>(bytes[data + 3 * row + 24]), 188);  // a half, as sRGB has it
  float value = 0;
  std::memcpy(&value, bytes.data() + data + 27, 4);
  EXPECT_EQ(value, 7.0f);
}

TEST(WriteColoured, NothingAndUnknownNames) {
  const test::Folder folder;
  EXPECT_TRUE(writeColoured({}, frame(), folder.path() / "a.glb"));
  EXPECT_TRUE(writeColoured({}, frame(), folder.path() / "a.ply"));
  EXPECT_EQ(writeColoured(sample(), frame(), folder.path() / "a.obj").error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace umbrage::io
