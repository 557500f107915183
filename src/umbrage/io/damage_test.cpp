// Damaged copies of small files of every format: each is a lawful scene or an error, never a crash of this process and never
// more than the time allowed. The seeds are fixed. scripts/sweep broken does the same with more and with larger files.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <random>

#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"

namespace umbrage::io {
namespace {

struct Sample {
  const char* name;
  std::string text;
};

std::vector<Sample> samples() {
  return {
      {"a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no part\nusemtl m\nf 1 2 3 4\ng other\nf -4 -3 -2\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.stl",
       "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\nendsolid\n"},
      {"a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"},
      {"a.iv",
       "#Inventor V2.1 ascii\nDEF A Separator { Material { diffuseColor [ 1 0 0, 0 1 0 ] } Coordinate3 { point [ 0 0 "
       "0, 1 0 0, "
       "1 1 0 ] } IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] } FaceSet { numVertices 3 } Cube { } }"},
      {"a.wrl",
       "#VRML V2.0 utf8\nTransform { translation 1 0 0 children [ Shape { geometry IndexedFaceSet { coord Coordinate { "
       "point [ "
       "0 0 0, 1 0 0, 1 1 0 ] } coordIndex [ 0 1 2 -1 ] } } ] }"},
      {"a.gltf",
       R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0},{"children":[0]}],"scenes":[{"nodes":[1]}]})"},
      {"a.city.json",
       R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.1,0.1,0.1],"translate":[1,2,3]},"CityObjects":{"b":{"type":"Building","geometry":[{"type":"Solid","lod":"2","boundaries":[[[[0,1,2]],[[0,2,3],[1,2,3]]]],"semantics":{"surfaces":[{"type":"RoofSurface"}],"values":[[0,null]]}}]}},"vertices":[[0,0,0],[9,0,0],[9,9,0],[0,9,0]]})"},
  };
}

using Random = std::mt19937;  // the same numbers everywhere, unlike the standard distributions

std::string damaged(std::string text, Random& random) {
  const auto at = [&] { return static_cast<std::size_t>(random()) % (text.size() + 1); };
  switch (random() % 4) {
    case 0:
      for (auto i = 1 + random() % 6; i > 0; --i) text[at() % text.size()] = static_cast<char>(random());
      break;
    case 1: text.resize(at()); break;
    case 2: {
      const std::string stretch = text.substr(at(), random() % 40);
      text.insert(at(), stretch);
      break;
    }
    default: {
      static const char* const kNumbers[] = {"-1", "4294967296", "1e999", "nan", "99999999999999999999",
                                             "0",  "2147483647"};
      const auto digit = text.find_first_of("0123456789", at() % text.size());
      if (digit != std::string::npos) text.replace(digit, 1, kNumbers[random() % 7]);
    }
  }
  return text;
}

TEST(Damage, everyDamagedFileIsALawfulSceneOrAnError) {
  const char* asked = std::getenv("UMBRAGE_DAMAGE_CASES");
  const unsigned cases = asked != nullptr ? static_cast<unsigned>(std::atoi(asked)) : 12;
  const test::Folder folder;
  LoadOptions options;
  options.timeLimit = std::chrono::milliseconds(1500);
  std::size_t scenes = 0, errors = 0;
  for (const Sample& sample : samples())
    for (unsigned seed = 0; seed < cases; ++seed) {
      Random random(seed);
      const std::string text = damaged(sample.text, random);
      const auto start = std::chrono::steady_clock::now();
      const auto scene = loadScene(folder.write(sample.name, text), options);
      const bool lawful = scene ? !scene::findFault(*scene) : exitCode(scene.error().code) == 3;
      EXPECT_TRUE(lawful) << sample.name << " seed " << seed << (scene ? "" : ": " + scene.error().text());
      EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10)) << sample.name << " seed " << seed;
      ++(scene ? scenes : errors);
    }
  EXPECT_GT(scenes, 0U);
  EXPECT_GT(errors, 0U);
}

}  // namespace
}  // namespace umbrage::io
