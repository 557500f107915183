#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "program.hpp"
#include "umbrage/png/png.hpp"

namespace umbrage::cli_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RadiosityCommand : public CliTest {};

TEST_F(RadiosityCommand, WritesPicturesModelsAndTheEnergy) {
  const Ran ran = umbrage(
      {"radiosity", "sample:cornell", "-o",      file("a.png"), "-o",        file("a.glb"), "-o",      file("a.ply"),
       "--stats",   file("s.json"),   "--patch", "2",           "--element", "0.5",         "--error", "0.3",
       "--unshot",  "0.02",           "--size",  "60x40"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(files(), ElementsAre("a.glb", "a.ply", "a.png", "s.json"));
  for (const char* word : {"emitted", "absorbed", "escaped", "unshot", "error"}) EXPECT_THAT(ran.out, HasSubstr(word));
  const auto picture = png::read(file("a.png"));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width(), 60);
  const auto json = nlohmann::json::parse(read("s.json"));
  EXPECT_TRUE(json["converged"].get<bool>());
  EXPECT_LE(json["unshot_part"].get<double>(), 0.02);
  EXPECT_LT(std::abs(json["energy"]["relative_error"].get<double>()), 0.05);
  EXPECT_EQ(json["lights"], 0);  // the room has its own
  EXPECT_EQ(umbrage({"info", file("a.glb")}).code, 0);
}

TEST_F(RadiosityCommand, RefusesWhatItCannotWrite) {
  EXPECT_EQ(umbrage({"radiosity", "sample:cornell"}).code, 2);
  EXPECT_EQ(umbrage({"radiosity", "sample:cornell", "-o", file("a.jpg")}).code, 2);
  EXPECT_EQ(umbrage({"radiosity", "sample:cornell", "-o", file("a.png"), "--patch", "-1"}).code, 2);
  EXPECT_THAT(files(), ElementsAre());
}

TEST_F(RadiosityCommand, ReflectionsAreOfPicturesByRays) {
  const auto box = writeBox();
  EXPECT_EQ(umbrage({"render", box, "-o", file("a.png"), "--reflections", "2"}).code, 2);
  EXPECT_EQ(umbrage({"render", box, "-o", file("a.png"), "--technique", "ray_traced", "--ior", "1.5"}).code, 2);
  EXPECT_EQ(umbrage({"render", box, "-o", file("a.png"), "--technique", "ray_traced", "--reflections", "2",
                     "--refractions", "3", "--ior", "1.5", "--size", "30x20"})
                .code,
            0);
}

// Without anything that mirrors or bends light the picture is what it was.
TEST_F(RadiosityCommand, DepthChangesNothingWhereNothingMirrors) {
  const auto box = writeBox();
  const std::vector<std::string> words{"render", box, "--technique", "ray_traced", "--ground", "--size", "90x60", "-o"};
  auto plain = words, deep = words;
  plain.push_back(file("a.png"));
  deep.insert(deep.end(), {file("b.png"), "--reflections", "4", "--refractions", "4"});
  ASSERT_EQ(umbrage(plain).code, 0);
  ASSERT_EQ(umbrage(deep).code, 0);
  const auto a = png::read(file("a.png")), b = png::read(file("b.png"));
  ASSERT_TRUE(a && b);
  for (std::size_t i = 0; i < a->size(); ++i) {
    const auto &p = a->pixels()[i], &q = b->pixels()[i];
    EXPECT_LE(std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)}), 1) << i;
  }
}

}  // namespace
}  // namespace umbrage::cli_test
