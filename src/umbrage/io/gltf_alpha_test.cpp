#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"
#include "umbrage/io/test_gltf.hpp"
#include "umbrage/png/png.hpp"

// What textures let through, from files to geometry. How triangles are cut: alpha_cut_test.
namespace umbrage::io {
namespace {

using test::base64;
using test::bytesOf;

/// '#': wholly there, '-': a quarter, ' ': nothing.
image::RgbaImage picture(int width, int height, const std::string& rows) {
  image::RgbaImage out(width, height);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint8_t value = rows[i] == '#' ? 255 : rows[i] == '-' ? 64 : 0;
    out.pixels()[i] = {value, 0, 0, value};
  }
  return out;
}

struct Sheet {
  std::string material = R"("alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";
  std::string image = R"("uri":"a.png")";
  std::string sampler = "{}";
  std::vector<float> first = {0, 0, 1, 0, 1, 1, 0, 1}, second = {0.5, 0, 1, 0, 1, 1, 0.5, 1};
  std::string attributes = R"("POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2)";
  std::string nodes = R"("nodes":[{"mesh":0}])";
  std::string more;  ///< bytes behind the numbers: buffer view 4
};

// A square of side 1, x to the right and y down as its texture.
std::string gltfOf(const Sheet& sheet) {
  const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<std::uint16_t> indices = {0, 1, 2, 0, 2, 3};
  const std::string bytes =
      bytesOf(corners) + bytesOf(sheet.first) + bytesOf(sheet.second) + bytesOf(indices) + sheet.more;
  std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
                     R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + R"("}],)";
  text += R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
    {"buffer":0,"byteOffset":80,"byteLength":32},{"buffer":0,"byteOffset":112,"byteLength":12},{"buffer":0,"byteOffset":124,"byteLength":)" +
          std::to_string(std::max<std::size_t>(1, sheet.more.size())) + R"(}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
      {"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"},
      {"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}],)";
  text += R"("images":[{)" + sheet.image + R"(}],"samplers":[)" + sheet.sampler +
          R"(],"textures":[{"source":0,"sampler":0}],"materials":[{)" + sheet.material + R"(}],)";
  return text + R"("meshes":[{"primitives":[{"attributes":{)" + sheet.attributes +
         R"(},"indices":3,"material":0}]}],)" + sheet.nodes + "}";
}

scene::Scene loaded(const Sheet& sheet, const image::RgbaImage& alpha, const LoadOptions& options = {}) {
  const test::Folder folder;
  EXPECT_TRUE(png::write(folder.path() / "a.png", alpha));
  const auto scene = loadScene(folder.write("sheet.gltf", gltfOf(sheet)), options);
  EXPECT_TRUE(scene) << scene.error().text();
  return scene ? *scene : scene::Scene{};
}

/// Area of the triangles whose middle lies in a box, each times its opacity.
double thereIn(const scene::Scene& scene, const Vec2& low, const Vec2& high) {
  double sum = 0.0;
  for (const auto& mesh : scene.meshes)
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
      const Vec3 a = mesh->positions[mesh->triangles[t][0]], b = mesh->positions[mesh->triangles[t][1]],
                 c = mesh->positions[mesh->triangles[t][2]], middle = (a + b + c) / 3.0;
      if (middle.x < low.x || middle.y < low.y || middle.x > high.x || middle.y > high.y) continue;
      sum += glm::length(glm::cross(b - a, c - a)) / 2 * scene.materials[mesh->materials[t]].opacity;
    }
  return sum;
}
double thereIn(const scene::Scene& scene) { return thereIn(scene, Vec2(-9), Vec2(9)); }

bool mentions(const scene::Scene& scene, const std::string& text) {
  return std::any_of(scene.warnings.begin(), scene.warnings.end(),
                     [&](const std::string& w) { return w.find(text) != w.npos; });
}

TEST(GltfAlpha, MaskCutsHoles) {
  const auto scene = loaded({}, picture(2, 2, "#  #"));
  EXPECT_NEAR(thereIn(scene), 0.5, 1e-12);
  EXPECT_NEAR(thereIn(scene, {0, 0}, {0.5, 0.5}), 0.25, 1e-12);
  EXPECT_NEAR(thereIn(scene, {0.5, 0.5}, {1, 1}), 0.25, 1e-12);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], std::string(kAlphaNote) + "2 triangles cut into 4 pieces along texels");
}

TEST(GltfAlpha, TheCutoffCountsWithTheFactor) {
  const auto with = [](const std::string& cutoff, const std::string& alpha) {
    Sheet sheet;
    sheet.material = R"("alphaMode":"MASK","alphaCutoff":)" + cutoff +
                     R"(,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,)" + alpha +
                     R"(],"baseColorTexture":{"index":0}})";
    return thereIn(loaded(sheet, picture(4, 1, "#-  ")));
  };
  EXPECT_NEAR(with("0.5", "1"), 0.25, 1e-12);
  EXPECT_NEAR(with("0.25", "1"), 0.5, 1e-12);
  EXPECT_NEAR(with("0.25", "0.5"), 0.25, 1e-12);
  EXPECT_NEAR(with("0.6", "0.5"), 0.0, 1e-12);
  EXPECT_NEAR(with("0", "1"), 1.0, 1e-12);
}

TEST(GltfAlpha, BlendIsThereInPart) {
  Sheet sheet;
  sheet.material =
      R"("alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,0.5],"baseColorTexture":{"index":0}})";
  const auto scene = loaded(sheet, picture(4, 1, "##- "));
  EXPECT_NEAR(thereIn(scene, {0, 0}, {0.5, 1}), 0.5 * 0.5, 1e-12);
  EXPECT_NEAR(thereIn(scene, {0.5, 0}, {0.75, 1}), 0.25 * 8 / 64, 1e-12);
  EXPECT_EQ(thereIn(scene, {0.75, 0}, {1, 1}), 0.0);
  const auto eighth = std::find_if(scene.materials.begin(), scene.materials.end(),
                                   [](const scene::Material& material) { return material.opacity == 0.125; });
  ASSERT_NE(eighth, scene.materials.end());
  EXPECT_LT(glm::length(scene::transmittance(*eighth) - 0.875 * Vec3(1, 0.5, 0)), 1e-12);
}

TEST(GltfAlpha, TransmissionIsReadWhereItsTextureSays) {
  Sheet sheet;
  sheet.material =
      R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5,"transmissionTexture":{"index":0}}})";
  const auto scene = loaded(sheet, picture(2, 1, "# "));
  EXPECT_NEAR(thereIn(scene, {0, 0}, {0.5, 1}), 0.25, 1e-12);
  EXPECT_NEAR(thereIn(scene, {0.5, 0}, {1, 1}), 0.5, 1e-12);
}

TEST(GltfAlpha, SecondCoordinatesWrapsAndTransforms) {
  const auto mask = [](const std::string& info) {
    return R"("alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0)" + info + "}}";
  };
  const auto left = picture(2, 1, "# ");
  Sheet sheet;
  sheet.material = mask(R"(,"texCoord":1)");
  EXPECT_EQ(thereIn(loaded(sheet, left)), 0.0) << "the right half of the texture all over";
  const auto transformed = [&](const std::string& transform, const std::string& sampler = "{}") {
    sheet.material = mask(R"(,"extensions":{"KHR_texture_transform":{)" + transform + "}}");
    sheet.sampler = sampler;
    return loaded(sheet, left);
  };
  EXPECT_NEAR(thereIn(transformed(R"("offset":[0.5,0])"), {0.5, 0}, {1, 1}), 0.5, 1e-12);
  EXPECT_NEAR(thereIn(transformed(R"("scale":[2,1])")), 0.5, 1e-12);
  EXPECT_NEAR(thereIn(transformed(R"("scale":[2,1])"), {0.25, 0}, {0.5, 1}), 0.0, 1e-12);
  EXPECT_NEAR(thereIn(transformed(R"("scale":[2,1])", R"({"wrapS":33071})")), 0.25, 1e-12);
  EXPECT_NEAR(thereIn(transformed(R"("scale":[2,1])", R"({"wrapS":33648})"), {0.75, 0}, {1, 1}), 0.25, 1e-12);
  // A quarter turn counter-clockwise as one sees it: (u, v) becomes (v, -u), so the texture's left is the square's upper half.
  EXPECT_NEAR(thereIn(transformed(R"("rotation":1.5707963267948966)"), {0, 0}, {1, 0.5}), 0.5, 1e-9);
  EXPECT_NEAR(thereIn(transformed(R"("texCoord":1)")), 0.0, 1e-12);
}

TEST(GltfAlpha, PicturesInBuffersAndInTheText) {
  const test::Folder folder;
  ASSERT_TRUE(png::write(folder.path() / "b.png", picture(2, 1, "# ")));
  std::ifstream file(folder.path() / "b.png", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  Sheet sheet;
  sheet.image = R"("mimeType":"image/png","bufferView":4)", sheet.more = bytes;
  EXPECT_NEAR(thereIn(loaded(sheet, picture(1, 1, "#"))), 0.5, 1e-12);
  sheet.image = R"("uri":"data:image/png;base64,)" + base64(bytes) + "\"", sheet.more.clear();
  EXPECT_NEAR(thereIn(loaded(sheet, picture(1, 1, "#"))), 0.5, 1e-12);
}

TEST(GltfAlpha, WhatIsOpaqueStaysAsItIs) {
  const auto scene = loaded({}, picture(2, 2, "####"));
  EXPECT_EQ(scene::triangleCount(scene), 2u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfAlpha, BrokenPicturesAreAWarning) {
  for (const std::string image :
       {R"("uri":"absent.png")", R"("uri":"../a.png")", R"("uri":"sheet.gltf")",
        R"("bufferView":4,"mimeType":"image/png")", R"("uri":"data:image/png;base64,AAAA")"}) {
    Sheet sheet;
    sheet.image = image;
    const auto scene = loaded(sheet, picture(1, 1, " "));
    EXPECT_EQ(scene::triangleCount(scene), 2u) << image;
    EXPECT_TRUE(mentions(scene, "count as a whole")) << image;
  }
}

TEST(GltfAlpha, LimitsAndWholeTriangles) {
  image::RgbaImage noise(64, 64);
  unsigned state = 1;
  for (auto& texel : noise.pixels()) texel.a = (state = state * 1664525u + 1013904223u) >> 31 != 0 ? 255 : 0;
  LoadOptions options;
  const auto fine = loaded({}, noise, options);
  options.alphaTexels = 4;
  const auto coarser = loaded({}, noise, options);
  options.alphaTexels = 1, options.alphaTriangles = 500;
  const auto limited = loaded({}, noise, options);
  options.alphaTriangles = 0;
  const auto whole = loaded({}, noise, options);
  EXPECT_GT(scene::triangleCount(fine), 2000u);
  EXPECT_LT(scene::triangleCount(coarser), scene::triangleCount(fine) / 4);
  EXPECT_TRUE(mentions(coarser, "cells of up to 4 x 4 texels"));
  EXPECT_LE(scene::triangleCount(limited), 502u);
  EXPECT_TRUE(mentions(limited, "% of a triangle's area"));
  EXPECT_LE(scene::triangleCount(whole), 2u);
  EXPECT_TRUE(mentions(whole, "left whole"));
  // All placings count together.
  Sheet many;
  many.nodes = R"("nodes":[{"mesh":0},{"mesh":0,"translation":[2,0,0]},{"mesh":0,"translation":[4,0,0]}])";
  options.alphaTriangles = 1500;
  EXPECT_LE(scene::triangleCount(loaded(many, noise, options)), 1506u);
  options.alphaTexels = 3;
  EXPECT_FALSE(loadScene("absent.gltf", options));
}

// Hundreds of meshes, each of noise that asks for a million pieces.
TEST(GltfAlpha, NoiseAllOverIsReadInTimeAndWithinTheLimit) {
  image::RgbaImage noise(512, 512);
  unsigned state = 1;
  for (auto& texel : noise.pixels()) texel.a = (state = state * 1664525u + 1013904223u) >> 31 != 0 ? 255 : 0;
  Sheet sheet;
  sheet.first = {0, 0, 9, 0, 9, 9, 0, 9};
  std::string meshes = R"("meshes":[)", nodes = R"("nodes":[)";
  for (int i = 0; i < 300; ++i) {
    const char* comma = i == 0 ? "" : ",";
    meshes += comma +
              std::string(R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":3,"material":0}]})");
    nodes += comma + fmt::format(R"({{"mesh":{}}})", i);
  }
  sheet.nodes = nodes + "]";
  std::string text = gltfOf(sheet);
  const auto begin = text.find(R"("meshes":[)"), end = text.find(R"("nodes":[)");
  text.replace(begin, end - begin, meshes + "],");
  const test::Folder folder;
  ASSERT_TRUE(png::write(folder.path() / "a.png", noise));
  const auto scene = loadScene(folder.write("noise.gltf", text));
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_LE(scene::triangleCount(*scene), 250'600u);
  EXPECT_FALSE(scene->warnings.empty());
}

TEST(GltfAlpha, CoordinatesThatAreNoneOrHuge) {
  Sheet sheet;
  sheet.attributes = R"("POSITION":0)";
  EXPECT_NEAR(thereIn(loaded(sheet, picture(2, 2, "### "))), 1.0, 1e-12);
  EXPECT_TRUE(mentions(loaded(sheet, picture(2, 2, "### ")), "mean"));
  sheet.attributes = R"("POSITION":0,"TEXCOORD_0":1)";
  sheet.first = {0, 0, 3e7f, 0, 3e7f, 3e7f, 0, 3e7f};
  EXPECT_LE(scene::triangleCount(loaded(sheet, picture(2, 2, "#  #"))), 2u);
  sheet.first = {0, 0, NAN, 0, 1, INFINITY, 0, 1};
  EXPECT_NEAR(thereIn(loaded(sheet, picture(2, 2, "### "))), 1.0, 1e-12);
}

TEST(GltfAlpha, RealModels) {
  if (test::testData().empty()) GTEST_SKIP() << "no test data";
  // Of each the whole area of what is there, and whether that is less than all.
  for (const char* name :
       {"gltf/AlphaBlendModeTest.glb", "gltf/blender-io/01_alpha_mask.gltf", "gltf/blender-io/01_alpha_blend.gltf",
        "gltf/blender-io/15_transmission.gltf", "gltf/asset-generator/Material_AlphaBlend_03.gltf"}) {
    const auto path = test::testData() / name;
    if (!std::filesystem::exists(path)) continue;
    LoadOptions whole;
    whole.alphaTriangles = 0;
    const auto cut = loadScene(path), uncut = loadScene(path, whole);
    ASSERT_TRUE(cut && uncut) << name;
    std::printf("%s: %zu triangles cut, %zu whole\n", name, scene::triangleCount(*cut), scene::triangleCount(*uncut));
    for (const auto& warning : cut->warnings) std::printf("  %s\n", warning.c_str());
  }
}

}  // namespace
}  // namespace umbrage::io
