// The hand-over from a reader that may be anything.
#include "umbrage/io/detail/handover.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstring>
#include <limits>

#include "umbrage/io/detail/printable.hpp"
#include "umbrage/io/load.hpp"

namespace umbrage::io::detail {
namespace {

std::shared_ptr<const mesh::Mesh> triangle() {
  auto m = std::make_shared<mesh::Mesh>();
  m->name = "triangle";
  m->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}};
  m->triangles = {{0, 1, 2}};
  m->materials = {1};
  return m;
}

scene::Scene sample() {
  scene::Scene s;
  s.up = scene::UpAxis::y;
  s.metresPerUnit = 0.3048;
  s.northOffset = Angle::degrees(12);
  s.crs = "EPSG:7415";
  s.warnings = {"a", ""};
  s.materials = {{"brick", Vec3(0.1, 0.2, 0.3), 1.0}, {"", Vec3(1.0), 0.5}};
  s.materials[0].emission = Vec3(3.0, 2.0, 1.0), s.materials[0].mirror = 0.25, s.materials[0].ior = 1.5;
  s.meshes = {triangle()};
  s.instances = {{"A/B", 0, Mat4(2.0), true, "A"}, {"", 0, Mat4(1.0), false}};
  s.lights = {{scene::PointLight{Vec3(1, 2, 3)}, Vec3(1, 0, 0), 2.0, "lamp"},
              {scene::DirectionalLight{Vec3(0, -1, 0)}, Vec3(1.0), 1.0, ""},
              {scene::SpotLight{Vec3(0.0), Vec3(0, 0, -1), Angle::degrees(30)}, Vec3(1.0), 1.0, "spot"}};
  return s;
}

TEST(Handover, bringsEverythingAcross) {
  const auto bytes = pack(sample());
  const auto scene = unpack(bytes);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(pack(*scene), bytes);
  EXPECT_EQ(scene->up, scene::UpAxis::y);
  EXPECT_EQ(scene->crs, "EPSG:7415");
  EXPECT_EQ(scene->materials[1].opacity, 0.5);
  EXPECT_EQ(scene->materials[0].emission, Vec3(3.0, 2.0, 1.0));
  EXPECT_EQ(scene->materials[0].mirror, 0.25);
  EXPECT_EQ(scene->materials[0].ior, 1.5);
  EXPECT_EQ(scene->meshes[0]->positions[2], Vec3(0, 1, 0.1));
  EXPECT_EQ(scene->instances[0].name, "A/B");
  EXPECT_EQ(scene->instances[0].group, "A");
  EXPECT_EQ(scene->instances[1].group, "");
  EXPECT_FALSE(scene->instances[1].casts);
  EXPECT_EQ(std::get<scene::SpotLight>(scene->lights[2].shape).cutoff, Angle::degrees(30));
}

TEST(Handover, bringsErrorsAcrossButOnlyTheReadersOwn) {
  const auto unsupported = unpack(pack(Error{ErrorCode::unsupported, "no", "there"}));
  ASSERT_FALSE(unsupported);
  EXPECT_EQ(unsupported.error().code, ErrorCode::unsupported);
  EXPECT_EQ(unsupported.error().message, "no");
  EXPECT_EQ(unsupported.error().where, "there");
  EXPECT_EQ(unpack(pack(Error{ErrorCode::device, "no", ""})).error().code, ErrorCode::input);
}

TEST(Handover, everyShorterOneIsRefused) {
  const auto bytes = pack(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(unpack(std::span(bytes).first(size))) << size;
  auto longer = bytes;
  longer.push_back({});
  EXPECT_FALSE(unpack(longer));
}

// Wherever a size may stand: no size is believed beyond the bytes there are, so memory stays within a few times of them.
TEST(Handover, hugeNumbersAnywhereAreHarmless) {
  const auto bytes = pack(sample());
  for (const std::uint64_t huge :
       {std::uint64_t{1} << 60, ~std::uint64_t{0}, std::uint64_t{1} << 32, std::uint64_t{0xffffffff}})
    for (std::size_t at = 0; at + sizeof huge <= bytes.size(); ++at) {
      auto broken = bytes;
      std::memcpy(broken.data() + at, &huge, sizeof huge);
      const auto scene = unpack(broken);
      EXPECT_TRUE(!scene || !scene::findFault(*scene)) << at;
    }
}

TEST(Handover, anyDamageGivesALawfulSceneOrAnError) {
  const auto bytes = pack(sample());
  rc::check("lawful", [&] {
    auto broken = bytes;
    const auto changes = *rc::gen::inRange(1, 8);
    for (int i = 0; i < changes; ++i)
      broken[*rc::gen::inRange<std::size_t>(0, broken.size())] = static_cast<std::byte>(*rc::gen::inRange(0, 256));
    const auto scene = unpack(broken);
    if (scene) RC_ASSERT(!scene::findFault(*scene));
  });
}

TEST(Handover, unlawfulScenesAreRefused) {
  const auto refused = [](auto change) {
    scene::Scene s = sample();
    change(s);
    return !unpack(pack(s));
  };
  EXPECT_FALSE(refused([](scene::Scene&) {}));
  EXPECT_TRUE(refused([](scene::Scene& s) { s.instances[0].mesh = 1; }));
  EXPECT_TRUE(
      refused([](scene::Scene& s) { s.instances[0].toWorld[3][0] = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](scene::Scene& s) { s.materials.clear(); }));
  EXPECT_TRUE(refused([](scene::Scene& s) { s.metresPerUnit = 0.0; }));
  EXPECT_TRUE(refused([](scene::Scene& s) { s.lights[1].shape = scene::DirectionalLight{Vec3(0.0)}; }));
  EXPECT_TRUE(refused([](scene::Scene& s) {
    auto m = *s.meshes[0];
    m.triangles[0][2] = 3;
    s.meshes[0] = std::make_shared<const mesh::Mesh>(m);
  }));
}

TEST(Handover, instancesCountFully) {
  scene::Scene s = sample();
  auto m = std::make_shared<mesh::Mesh>(*triangle());
  m->triangles.assign(21'000, {0, 1, 2});
  m->materials.clear();
  s.meshes = {m};
  s.instances.assign(1000, {"i", 0, Mat4(1.0), true});
  const auto scene = unpack(pack(s));
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message.find("too large"), std::string::npos);
}

TEST(Printable, isUtf8WithoutControlCharacters) {
  EXPECT_EQ(printable("plain", 99), "plain");
  EXPECT_EQ(printable("\xc3\xa4 \xe2\x82\xac \xf0\x9f\x8f\xa0", 99), "\xc3\xa4 \xe2\x82\xac \xf0\x9f\x8f\xa0");
  EXPECT_EQ(printable("\xe4", 99), "\xc3\xa4");                   // Latin-1
  EXPECT_EQ(printable("a\x1b[2Jb\x7f\n", 99), "a [2Jb  ");        // terminal commands
  EXPECT_EQ(printable("\xc2\x9b", 99), " ");                      // the other kind of them
  EXPECT_EQ(printable("\xed\xa0\x80", 99), "\xc3\xad\xc2\xa0 ");  // a surrogate is not UTF-8
  EXPECT_EQ(printable("abcdef", 3), "abc...");
}

}  // namespace
}  // namespace umbrage::io::detail
