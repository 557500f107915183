// What writers write, seen without this project's readers.
#include "umbrage/io/write.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "umbrage/base/file.hpp"
#include "umbrage/io/test_data.hpp"
#include "umbrage/samples/samples.hpp"

namespace umbrage::io {
namespace {

using Json = nlohmann::json;

std::string written(const scene::Scene& scene, const std::string& name) {
  const test::Folder folder;
  const auto path = folder.path() / name;
  const auto done = writeScene(scene, path);
  EXPECT_TRUE(done) << (done ? "" : done.error().text());
  const auto bytes = readFile(path);
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
}

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

struct Glb {
  Json json;
  std::string binary;
};
Glb parsed(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(wordAt(bytes, 4), 2u);
  EXPECT_EQ(wordAt(bytes, 8), bytes.size());
  const std::size_t length = wordAt(bytes, 12);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(length % 4, 0u);
  Glb glb{Json::parse(bytes.substr(20, length)), {}};
  if (20 + length == bytes.size()) return glb;
  EXPECT_EQ(bytes.substr(24 + length, 4), std::string("BIN\0", 4));
  glb.binary = bytes.substr(28 + length);
  EXPECT_EQ(wordAt(bytes, 20 + length), glb.binary.size());
  return glb;
}

/// Two tetrahedra that share a mesh, one of them mirrored, and an open sheet, in two levels.
scene::Scene small() {
  mesh::Mesh body{
      "Body", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}, {0, 0, 1, 1}};
  mesh::Mesh sheet{"Sheet", {{0, 0, 2}, {1, 0, 2}, {1, 1, 2}}, {{0, 1, 2}}, {}};
  scene::Scene s;
  s.materials = {{"red brick", {0.5, 0.1, 0.05}, 1.0}, {"glass", {0.2, 0.3, 0.4}, 0.25}};
  s.meshes = {std::make_shared<const mesh::Mesh>(body), std::make_shared<const mesh::Mesh>(sheet)};
  s.instances = {{"House/Body", 0, Mat4(1.0), true},
                 {"House/Annex/Body", 0, glm::scale(glm::translate(Mat4(1.0), Vec3(5, 0, 0)), Vec3(-1, 1, 1)), true},
                 {"House/Roof", 1, Mat4(1.0), false}};
  return s;
}

TEST(WriteScene, RefusesWhatItDoesNotKnow) {
  const test::Folder folder;
  EXPECT_EQ(writeScene(small(), folder.path() / "a.dwg").error().code, ErrorCode::usage);
  EXPECT_EQ(writeScene(small(), folder.path() / ".glb").error().code, ErrorCode::usage);
  EXPECT_EQ(writeScene(small(), folder.path() / "no" / "a.glb").error().code, ErrorCode::output);
  scene::Scene broken = small();
  broken.instances[0].mesh = 7;
  EXPECT_EQ(writeScene(broken, folder.path() / "a.glb").error().code, ErrorCode::input);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THAT(writableExtensions(), testing::ElementsAre("glb", "iv", "city.json", "json", "obj"));
}

TEST(WriteScene, GivesTheSameBytesEachTime) {
  for (const std::string_view extension : writableExtensions()) {
    const std::string name = "a." + std::string(extension);
    EXPECT_EQ(written(small(), name), written(small(), name)) << name;
  }
}

TEST(WriteScene, TakesSceneWithoutParts) {
  scene::Scene empty;
  empty.materials = {{}};
  for (const std::string_view extension : writableExtensions())
    EXPECT_FALSE(written(empty, "a." + std::string(extension)).empty());
}

TEST(WriteGlb, SharesMeshesAndKeepsTheHierarchy) {
  const Glb glb = parsed(written(small(), "a.glb"));
  const Json& nodes = glb.json["nodes"];
  EXPECT_EQ(glb.json["scenes"][0]["nodes"], Json::array({0}));
  EXPECT_EQ(nodes[0]["matrix"], Json::parse("[1,0,0,0, 0,0,-1,0, 0,1,0,0, 0,0,0,1]"));
  const Json& house = nodes[nodes[0]["children"][0].get<std::size_t>()];
  EXPECT_EQ(house["name"], "House");
  ASSERT_EQ(house["children"].size(), 3u);
  const Json& body = nodes[house["children"][0].get<std::size_t>()];
  const Json& annex = nodes[house["children"][1].get<std::size_t>()];
  const Json& other = nodes[annex["children"][0].get<std::size_t>()];
  const Json& roof = nodes[house["children"][2].get<std::size_t>()];
  EXPECT_EQ(body["name"], "Body");
  EXPECT_EQ(annex["name"], "Annex");
  EXPECT_EQ(body["mesh"], other["mesh"]);
  EXPECT_EQ(roof["extras"]["casts"], false);
  EXPECT_EQ(glb.json["meshes"].size(), 2u);
  EXPECT_EQ(glb.json["meshes"][0]["primitives"].size(), 2u) << "one for each material";
  EXPECT_EQ(glb.json["materials"][1]["alphaMode"], "BLEND");
  EXPECT_EQ(glb.json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"], Json::parse("[0.2, 0.3, 0.4, 0.25]"));
  EXPECT_FALSE(glb.json["materials"][0].contains("alphaMode"));
}

TEST(WriteGlb, DescribesItsNumbersTruly) {
  const Glb glb = parsed(written(*samples::make("courtyard"), "a.glb"));
  EXPECT_EQ(glb.json["buffers"][0]["byteLength"].get<std::size_t>(), glb.binary.size());
  for (const Json& accessor : glb.json["accessors"]) {
    const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const auto offset = view["byteOffset"].get<std::size_t>(), length = view["byteLength"].get<std::size_t>();
    const auto count = accessor["count"].get<std::size_t>();
    ASSERT_LE(offset + length, glb.binary.size());
    ASSERT_EQ(offset % 4, 0u);
    if (accessor["type"] == "SCALAR") {
      ASSERT_EQ(length, 4 * count);
      continue;
    }
    ASSERT_EQ(length, 12 * count);
    Box3 box;
    for (std::size_t i = 0; i < count; ++i) {
      Vec3f p;
      std::memcpy(&p, glb.binary.data() + offset + 12 * i, 12);
      box.add(Vec3(p));
    }
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(accessor["min"][static_cast<std::size_t>(k)].get<double>(), box.min[k]);
      EXPECT_EQ(accessor["max"][static_cast<std::size_t>(k)].get<double>(), box.max[k]);
    }
  }
  for (const Json& mesh : glb.json["meshes"])
    for (const Json& primitive : mesh["primitives"])
      EXPECT_LT(primitive["material"].get<std::size_t>(), glb.json["materials"].size());
}

TEST(WriteGlb, ConvertsTheUnitInTheRoot) {
  scene::Scene s = small();
  s.up = scene::UpAxis::y;
  s.metresPerUnit = 0.001;
  EXPECT_EQ(parsed(written(s, "a.glb")).json["nodes"][0]["matrix"],
            Json::parse("[0.001,0,0,0, 0,0.001,0,0, 0,0,0.001,0, 0,0,0,1]"));
}

TEST(WriteCityJson, GivesSolidsForClosedPartsAndSurfacesForOthers) {
  const Json city = Json::parse(written(small(), "a.city.json"));
  EXPECT_EQ(city["type"], "CityJSON");
  EXPECT_EQ(city["version"], "2.0");
  const Json& objects = city["CityObjects"];
  EXPECT_EQ(objects["House"]["type"], "Building");
  EXPECT_EQ(objects["House"]["children"], Json::parse(R"json(["Body", "Annex", "Roof"])json"));
  EXPECT_EQ(objects["Annex"]["children"], Json::parse(R"json(["Body (2)"])json"));
  EXPECT_EQ(objects["Body (2)"]["parents"], Json::parse(R"json(["Annex"])json"));
  EXPECT_EQ(objects["Body"]["geometry"][0]["type"], "Solid");
  EXPECT_EQ(objects["Body (2)"]["geometry"][0]["type"], "Solid") << "mirrored, yet wound outwards";
  EXPECT_EQ(objects["Roof"]["geometry"][0]["type"], "MultiSurface");
  EXPECT_EQ(objects["Body"]["geometry"][0]["material"]["default"]["values"], Json::parse("[[0,0,1,1]]"));
  EXPECT_EQ(objects["Roof"]["geometry"][0]["material"]["default"]["value"], 0);
  EXPECT_EQ(city["transform"]["scale"], Json::parse("[1.0,1.0,1.0]")) << "whole metres need no digits";
}

/// Every ring's indices exist; parents and children agree.
TEST(WriteCityJson, IsConsistentForEverySample) {
  for (const samples::SampleInfo& info : samples::list()) {
    const scene::Scene s = *samples::make(info.name);
    const Json city = Json::parse(written(s, "a.city.json"));
    const std::size_t vertices = city["vertices"].size();
    std::size_t triangles = 0;
    for (const auto& [id, object] : city["CityObjects"].items()) {
      if (object.contains("parents")) {
        const Json& siblings = city["CityObjects"][object["parents"][0].get<std::string>()]["children"];
        EXPECT_EQ(std::count(siblings.begin(), siblings.end(), Json(id)), 1);
      }
      for (const Json& geometry : object["geometry"]) {
        const Json& surfaces = geometry["type"] == "Solid" ? geometry["boundaries"][0] : geometry["boundaries"];
        triangles += surfaces.size();
        for (const Json& surface : surfaces) {
          ASSERT_EQ(surface[0].size(), 3u);
          for (const Json& corner : surface[0]) ASSERT_LT(corner.get<std::size_t>(), vertices);
        }
      }
    }
    EXPECT_EQ(triangles, scene::triangleCount(s)) << info.name;
  }
}

TEST(WriteInventor, NamesLevelsAndSharesMeshes) {
  const std::string text = written(small(), "a.iv");
  EXPECT_TRUE(text.starts_with("#Inventor V2.1 ascii\n"));
  for (const char* wanted :
       {"DEF red_brick", "DEF House Separator", "DEF Annex Separator", "DEF +0 Separator", "USE +0"})
    EXPECT_THAT(text, testing::HasSubstr(wanted));
  std::size_t coordinates = 0;
  for (auto at = text.find("Coordinate3"); at != std::string::npos; at = text.find("Coordinate3", at + 1))
    ++coordinates;
  EXPECT_EQ(coordinates, 2u);
}

TEST(WriteObj, PutsMaterialsBesideIt) {
  const test::Folder folder;
  ASSERT_TRUE(writeScene(small(), folder.path() / "my house.obj"));
  const auto library = readFile(folder.path() / "my house.mtl");
  ASSERT_TRUE(library);
  const std::string text(reinterpret_cast<const char*>(library->data()), library->size());
  EXPECT_THAT(text, testing::HasSubstr("newmtl red_brick\nKd 0.7"));
  EXPECT_THAT(text, testing::HasSubstr("newmtl glass"));
  EXPECT_THAT(text, testing::HasSubstr("\nd 0.25\n"));
}

}  // namespace
}  // namespace umbrage::io
