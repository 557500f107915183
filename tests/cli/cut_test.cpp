#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

// Surfaces cut into lit and shadowed parts: their areas, and what the files hold.
namespace umbrage::cli_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;

class Cutting : public CliTest {};

// The ground under the box, which is 64 times as large, and of the box the roof and one wall.
TEST_F(Cutting, OfABoxHasTheAreasOfItsShadow) {
  const Ran ran = umbrage({"cut", writeBox(), "--ground", "--light", "directional:1,0,-1", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json json = Json::parse(ran.out);
  ASSERT_EQ(json.at("lights").size(), 1u);
  double ground = 0.0, box = 0.0;
  for (const Json& m : json.at("materials")) {
    const Json& light = m.at("lights").at(0);
    const double lit = light.at("lit_m2"), shadowed = light.at("shadowed_m2"), surface = m.at("surface_m2");
    EXPECT_NEAR(lit + shadowed, surface, 1e-9 * surface);
    (m.at("name") == "ground" ? ground : box) += m.at("name") == "ground" ? shadowed : lit;
  }
  EXPECT_NEAR(ground, 4.0 + 4.0, 1e-6);
  EXPECT_NEAR(box, 4.0 + 4.0, 1e-6);
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(Cutting, IsReadBackFromEveryFormatWithTheSameAreas) {
  const std::string box = writeBox();
  for (const char* name : {"out.glb", "out.iv", "out.obj"}) {
    const Ran ran = umbrage({"cut", box, "--ground", "0", "--light", "directional:1,0.25,-1", "-o", file(name)});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, AllOf(StartsWith(file(name)), HasSubstr("in shadow"), HasSubstr("all together")));
    const Ran info = umbrage({"info", file(name), "--json"});
    ASSERT_EQ(info.code, 0) << info.err;
    const Json json = Json::parse(info.out);
    std::string parts, materials;
    for (const Json& part : json.at("parts")) parts += part.at("name").get<std::string>() + "\n";
    for (const Json& m : json.at("materials")) materials += m.at("name").get<std::string>() + "\n";
    EXPECT_THAT(parts, AllOf(HasSubstr("lit"), HasSubstr("shadow"))) << name;
    EXPECT_THAT(materials, AllOf(HasSubstr("lit"), HasSubstr("shadow"))) << name;
    // 14 triangles, whose pieces are as large together: 16 of the box, and the ground.
    EXPECT_GT(json.at("triangles"), 14) << name;
    const double side = 2.0 * 64.0 * std::sqrt(3.0);
    const Ran again = umbrage({"cut", file(name), "--json"});
    ASSERT_EQ(again.code, 0) << again.err;
    const double surface = Json::parse(again.out).at("total").at("surface_m2");
    EXPECT_NEAR(surface, 24.0 + side * side, 1e-6 * side * side) << name;
  }
}

TEST_F(Cutting, BySunsOfADayAndBySeveralLights) {
  const std::string box = writeBox();
  const Ran day = umbrage({"cut", box, "--lat", "48.2", "--lon", "16.37", "--date", "2026-09-18", "--tz",
                           "Europe/Vienna", "--at", "12:00", "--at", "15:00", "--json"});
  ASSERT_EQ(day.code, 0) << day.err;
  const Json json = Json::parse(day.out);
  ASSERT_EQ(json.at("lights").size(), 2u);
  EXPECT_THAT(json.at("lights").at(0).get<std::string>(), HasSubstr("12:00"));
  // Two walls and the roof of a box of 2 x 2 x 2 see the sun; nothing stands in their way.
  for (const Json& light : json.at("total").at("lights")) EXPECT_NEAR(light.at("lit_m2").get<double>(), 12.0, 1e-9);
  const Ran lamps = umbrage({"cut", box, "--light", "point:0,0,9", "--light", "spot:0,0,9,0,0,-1,2", "--json"});
  ASSERT_EQ(lamps.code, 0) << lamps.err;
  const Json lights = Json::parse(lamps.out).at("total").at("lights");
  EXPECT_NEAR(lights.at(0).at("lit_m2").get<double>(), 4.0, 1e-9);
  const double radius = 7.0 * std::tan(2.0 * M_PI / 180);
  EXPECT_NEAR(lights.at(1).at("lit_m2").get<double>(), M_PI * radius * radius, 1e-5);
}

TEST_F(Cutting, RefusesWhatMakesNoSense) {
  const std::string box = writeBox();
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& says) {
    words.insert(words.begin(), {"cut", box});
    const Ran ran = umbrage(words);
    EXPECT_EQ(ran.code, code) << ran.err;
    EXPECT_THAT(ran.err, AllOf(StartsWith("error: "), HasSubstr(says)));
  };
  refused({"-o", file("out.png")}, 2, ".glb");
  refused({"-o", box}, 2, ".glb");
  refused({"--at", "12:00"}, 2, "--date");
  refused({"--at", "12:00", "--date", "2026-09-18", "--tz", "Europe/Vienna"}, 2, "--lat");
  refused({"--at", "12:00", "--light", "point:0,0,9"}, 2, "--light");
  refused({"--date", "2026-09-18"}, 2, "--at");
  refused({"--at", "23:00", "--date", "2026-09-18", "--tz", "Europe/Vienna", "--lat", "48", "--lon", "16"}, 2,
          "horizon");
  refused({"--ambient", "2"}, 2, "--ambient");
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(Cutting, AnObjWritesNoMaterialsOfOthers) {
  const auto box = writeBox();
  write("house.mtl", "newmtl mine\n");
  const Ran refused = umbrage({"cut", box, "-o", file("house.obj")});
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_THAT(refused.err, testing::HasSubstr("house.mtl"));
  EXPECT_EQ(read("house.mtl"), "newmtl mine\n");
  // Nor what the scene itself is read with, also where an .obj of that name is there.
  write("scene.obj", "mtllib my look.mtl  other.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("other.mtl", "newmtl mine\n");
  write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Ran named = umbrage({"cut", file("scene.obj"), "-o", file("other.obj")});
  EXPECT_EQ(named.code, 2) << named.err;
  EXPECT_THAT(named.err, HasSubstr("other.mtl, which scene.obj is read with"));
  EXPECT_EQ(read("other.mtl"), "newmtl mine\n");
  write("spaced.obj", "mtllib my look.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("my look.mtl", "newmtl mine\n");
  write("my look.obj", "v 0 0 0\n");
  EXPECT_EQ(umbrage({"cut", file("spaced.obj"), "-o", file("my look.obj")}).code, 2);
  std::filesystem::remove(file("other.obj"));
  std::filesystem::remove(file("other.mtl"));
  // What came with an .obj goes with it.
  EXPECT_EQ(umbrage({"cut", box, "-o", file("other.obj")}).code, 0);
  EXPECT_EQ(umbrage({"cut", box, "-o", file("other.obj")}).code, 0);
}

}  // namespace
}  // namespace umbrage::cli_test
