#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

#include <nlohmann/json.hpp>

#include "program.hpp"
#include "umbrage/png/png.hpp"

// Pictures and masks against what the contract says they are, through files alone.
namespace umbrage::cli_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

using Words = std::vector<std::string>;
using Json = nlohmann::json;

Json readJson(const std::string& path) {
  std::ifstream in(path);
  return Json::parse(in, nullptr, false);
}

/// The grey values of a mask file.
class Mask {
 public:
  explicit Mask(const std::string& path) {
    auto picture = png::read(path);
    EXPECT_TRUE(picture) << path;
    if (picture) picture_ = *picture;
  }
  [[nodiscard]] int at(int x, int y) const { return picture_(x, y).r; }
  [[nodiscard]] int width() const { return picture_.width(); }
  [[nodiscard]] int height() const { return picture_.height(); }
  [[nodiscard]] std::set<int> values() const {
    std::set<int> found;
    for (const auto& pixel : picture_.pixels()) {
      EXPECT_TRUE(pixel.r == pixel.g && pixel.g == pixel.b && pixel.a == 255);
      found.insert(pixel.r);
    }
    return found;
  }

 private:
  image::RgbaImage picture_;
};

class RenderCommand : public CliTest {
 protected:
  /// Looks straight down from z = 200; on the plane z = 0 the picture shows x and y in [-8, 8].
  [[nodiscard]] Words overhead(const std::string& scene, const std::string& light, const std::string& ground) const {
    const double fov = 2.0 * std::atan(8.0 / 200.0) * 180.0 / std::numbers::pi;
    return {
        "render", scene,     "--eye",   "0,0,200", "--target",           "0,0,0",  "--fov",         std::to_string(fov),
        "--size", "400x400", "--light", light,     "--ground=" + ground, "--mask", file("mask.png")};
  }
  /// First and last pixel column with value 0 right of the box in the middle row, as x on the plane at depth `depth`.
  [[nodiscard]] std::pair<double, double> shadow(double ground) const {
    const Mask mask(file("mask.png"));
    const double half = 8.0 * (200.0 - ground) / 200.0;
    const auto x = [&](double column) { return half * (2.0 * column / mask.width() - 1.0); };
    int first = mask.width(), last = -1;
    for (int i = mask.width() / 2; i < mask.width(); ++i)
      if (mask.at(i, mask.height() / 2) == 0) {
        first = std::min(first, i);
        last = i;
      }
    return {x(first), x(last + 1)};
  }
};

// The one number nobody can argue with: a box of height h under a sun at elevation a casts h / tan a.
TEST_F(RenderCommand, ShadowLengthIsHeightOverTangent) {
  const auto box = writeBox("box.off", 2.0);
  for (const auto* technique : {"ray_traced", "auto"})
    for (const double degrees : {25.0, 35.0, 45.0, 60.0, 75.0}) {
      const double a = degrees * std::numbers::pi / 180.0;
      auto words =
          overhead(box, "directional:" + std::to_string(std::cos(a)) + ",0," + std::to_string(-std::sin(a)), "0");
      words.insert(words.end(), {"--technique", technique});
      const Ran ran = umbrage(words);
      ASSERT_EQ(ran.code, 0) << ran.err;
      // One pixel is 0.04 wide; the top of the box hides a hundredth of its own size of the ground beside it.
      EXPECT_NEAR(shadow(0.0).second, 1.0 + 2.0 / std::tan(a), 0.04) << technique << " " << degrees;
      EXPECT_NEAR(shadow(0.0).first, 1.0, 0.04 + 0.02) << technique << " " << degrees;
    }
}

TEST_F(RenderCommand, TheGroundLiesWhereItIsAsked) {
  const auto box = writeBox("box.off", 2.0);
  const Ran ran = umbrage(overhead(box, "directional:1,0,-1", "-2"));
  ASSERT_EQ(ran.code, 0) << ran.err;
  // The box floats 2 above the ground: its shadow is shifted by 2 to 4.
  EXPECT_NEAR(shadow(-2.0).second, 5.0, 0.05);
  EXPECT_NEAR(shadow(-2.0).first, 1.02, 0.06);
}

TEST_F(RenderCommand, PixelsLookThroughTheirCentres) {
  // A square x, z in [0, 1] in the plane y = 0, seen along +y from 10 away with half height 10: a pixel is 0.5 wide.
  const auto scene = write("square.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 0 1\n0 0 1\n4 0 1 2 3\n");
  const Ran ran = umbrage({"render", scene, "--eye", "0,-10,0", "--target", "0,0,0", "--fov", "90", "--size", "40x40",
                           "--mask", file("mask.png"), "--light", "point:0,-10,0"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Mask mask(file("mask.png"));
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      EXPECT_EQ(mask.at(x, y), (x == 20 || x == 21) && (y == 18 || y == 19) ? 255 : 128) << x << "," << y;
}

TEST_F(RenderCommand, MaskValuesAreThree) {
  const auto box = writeBox();
  ASSERT_EQ(umbrage({"render", box, "--mask", file("mask.png"), "--size", "120x80"}).code, 0);
  EXPECT_THAT(Mask(file("mask.png")).values(), ElementsAre(0, 128, 255));
}

TEST_F(RenderCommand, ASpotLightsItsConeOnly) {
  // A ground alone, seen from above; the spot 10 above the middle reaches a circle of radius 10 tan 20.
  const auto scene = write("square.off", "OFF\n4 1 0\n-50 -50 0\n50 -50 0\n50 50 0\n-50 50 0\n4 0 1 2 3\n");
  auto words = overhead(scene, "spot:0,0,10,0,0,-1,20", "-60");
  ASSERT_EQ(umbrage(words).code, 0);
  const Mask mask(file("mask.png"));
  const double radius = 10.0 * std::tan(20.0 * std::numbers::pi / 180.0);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) {
      const double r = 0.04 * std::hypot(x + 0.5 - 200.0, y + 0.5 - 200.0);
      if (std::abs(r - radius) > 0.04) {
        ASSERT_EQ(mask.at(x, y), r < radius ? 255 : 0) << x << "," << y;
      }
    }
}

TEST_F(RenderCommand, SeveralLightsGiveSeveralMasks) {
  const auto box = writeBox();
  const Ran ran =
      umbrage({"render", box, "--ground", "-o", file("out.png"), "--mask", file("mask.png"), "--stats", file("s.json"),
               "--light", "point:4,0,5,#ff8000", "--light", "directional:1,0,-1", "--size", "160x90"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(files(), ElementsAre("box.off", "mask-0.png", "mask-1.png", "out.png", "s.json"));
  const auto stats = readJson(file("s.json"));
  ASSERT_TRUE(stats.is_object());
  EXPECT_THAT(stats["lights"], SizeIs(2));
  EXPECT_EQ(stats["casters"]["triangles"], 12);
  EXPECT_EQ(stats["casters"]["edges"], 18);
  for (const auto& light : stats["lights"]) {
    EXPECT_FALSE(light["technique"].get<std::string>().empty());
    EXPECT_FALSE(light["reason"].get<std::string>().empty());
  }
  EXPECT_FALSE(stats["reason"].get<std::string>().empty());
  EXPECT_GT(stats["total_ms"].get<double>(), 0.0);
}

TEST_F(RenderCommand, SameInputSameBytes) {
  const auto box = writeBox();
  for (const auto* name : {"a", "b"})
    ASSERT_EQ(umbrage({"render", box, "--ground", "-o", file(std::string(name) + ".png"), "--mask",
                       file(std::string(name) + "-mask.png"), "--size", "200x150"})
                  .code,
              0);
  EXPECT_FALSE(read("a.png").empty());
  EXPECT_TRUE(read("a.png") == read("b.png"));
  EXPECT_TRUE(read("a-mask.png") == read("b-mask.png"));
}

// Where nothing is in shadow, shadows leave no trace: a lone square lit from the front.
TEST_F(RenderCommand, OnlyNamedPartsCast) {
  const auto scene = write("two.obj",
                           "o wall\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\nf 1 2 3 4\no roof\nv -1 3 -1\nv 1 3 -1\nv 1 "
                           "3 1\nv -1 3 1\nf 5 6 7 8\n");
  const auto lit = [&](const Words& more) {
    Words words{"render",  scene,          "--ground", "--light", "directional:0.3,-1,0.2",
                "--stats", file("s.json"), "--size",   "200x150"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = umbrage(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return readJson(file("s.json"))["lights"][0]["lit_pixels"].get<int>();
  };
  const int both = lit({});
  const int wall = lit({"--casters", "wall*"});
  const int roof = lit({"--casters", "roof*"});
  EXPECT_LT(both, wall);
  EXPECT_LT(both, roof);
  EXPECT_EQ(lit({"--casters", "wall*", "--casters", "roof*"}), both);
}

// Every caster has its choice and the reason, and filling has its price; a picture without --stats pays for neither.
TEST_F(RenderCommand, StatsTellTheChoiceForEveryCaster) {
  for (const std::string technique : {"zpass", "zfail", "zmixed", "zp_plus"}) {
    const Ran ran = umbrage({"render", "sample:industrial", "--technique", technique, "--stats", file("s.json"),
                             "--light", "point:20,-30,60", "--light", "directional:1,1,-2", "--size", "200x150"});
    if (ran.code == 4) GTEST_SKIP() << "no graphics here: " << ran.err;
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto stats = readJson(file("s.json"));
    ASSERT_THAT(stats["lights"], SizeIs(2));
    for (const auto& light : stats["lights"]) {
      int sum = 0;
      for (const auto& choice : light["casters"]) {
        sum += choice["count"].get<int>();
        EXPECT_FALSE(choice["reason"].get<std::string>().empty());
        EXPECT_GE(choice["count"].get<std::size_t>(), choice["first"].size());
        ASSERT_FALSE(choice["first"].empty());
        EXPECT_FALSE(choice["first"][0]["part"].get<std::string>().empty());
      }
      EXPECT_EQ(sum, stats["casters"]["components"].get<int>()) << technique;
      EXPECT_GT(light["volume_fragments"].get<int>(), 1000);
    }
  }
}

// Glass lets light through in its colour: auto sees that, says so, and the mask is RGB.
TEST_F(RenderCommand, LightThroughGlassIsColoured) {
  const Words view{
      "sample:pavilion", "--eye",  "-7.5,-7,5.5", "--target", "-0.8,-0.6,0.9", "--light", "directional:-0.75,0.5,-0.62",
      "--size",          "200x150"};
  const auto render = [&](const Words& more) {
    Words words{"render"};
    words.insert(words.end(), view.begin(), view.end());
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = umbrage(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  render({"--mask", file("m.png"), "--stats", file("s.json"), "-o", file("p.png")});
  EXPECT_EQ(readJson(file("s.json"))["technique"], "transparent_cpu");
  EXPECT_THAT(readJson(file("s.json"))["approximated"], SizeIs(0));
  const auto mask = png::read(file("m.png"));
  ASSERT_TRUE(mask);
  EXPECT_TRUE(
      std::ranges::any_of(mask->pixels(), [](const image::Rgba8& p) { return p.r > 60 && p.g < 20 && p.b < 20; }));
  render({"--veil-layers", "0", "-o", file("flat.png"), "--stats", file("s.json")});
  EXPECT_FALSE(read("p.png") == read("flat.png"));
  EXPECT_THAT(readJson(file("s.json"))["approximated"], SizeIs(1));
  render({"--veil-layers", "auto", "-o", file("auto.png")});
  EXPECT_TRUE(read("p.png") == read("auto.png")) << "so few surfaces of glass all matter";
  render({"--see-through", "0.3", "-o", file("through.png")});
  EXPECT_FALSE(read("p.png") == read("through.png"));
  Words compare{"compare"};
  compare.insert(compare.end(), view.begin(), view.end());
  compare.insert(compare.end(), {"--technique", "auto"});
  const Ran compared = umbrage(compare);
  EXPECT_EQ(compared.code, 0);
  EXPECT_NE(compared.out.find("surfaces that let light through"), std::string::npos);
  compare.insert(compare.end(), {"--against", "zpass_cpu"});
  EXPECT_EQ(umbrage(compare).code, 2);  // they show different things
}

TEST_F(RenderCommand, LightsWithAnExtentHaveSoftShadows) {
  const auto box = writeBox();
  const Ran ran = umbrage({"render", box, "--ground", "--light", "sphere:3,8,5,1", "--samples", "32", "--mask",
                           file("m.png"), "--stats", file("s.json"), "--size", "200x150"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(readJson(file("s.json"))["approximated"], SizeIs(1));
  const auto soft = readJson(file("s.json"))["lights"][0]["soft"];
  EXPECT_EQ(soft["samples"], 32);
  EXPECT_GT(soft["penumbra_pixels"].get<int>(), 50);
  EXPECT_GT(soft["umbra_pixels"].get<int>(), 50);
  EXPECT_LT(soft["estimated_error"].get<double>(), 0.05);
}

// Which finder runs is said, and changes no byte of the mask.
TEST_F(RenderCommand, EverySilhouetteFinderGivesTheSameMask) {
  std::string mask;
  for (const std::string finder :
       {"brute_force", "brute_force_simd", "hextree", "hough", "potentially_visible", "gpu", "auto"}) {
    const Ran ran =
        umbrage({"render", "sample:tower", "--technique", "zpass", "--silhouette", finder, "--mask", file("mask.png"),
                 "--stats", file("s.json"), "--light", "point:20,-30,60", "--size", "200x150"});
    if (ran.code == 4) GTEST_SKIP() << "no graphics here: " << ran.err;
    ASSERT_EQ(ran.code, 0) << ran.err;
    if (mask.empty()) mask = read("mask.png");
    EXPECT_TRUE(read("mask.png") == mask) << finder;
    const auto light = readJson(file("s.json"))["lights"][0];
    if (finder != "auto") {
      EXPECT_EQ(light["silhouette_finder"], finder);
    }
    EXPECT_GT(light["edges_tested"].get<int>(), 0);
  }
}

// On one machine, not a byte.
TEST_F(RenderCommand, WhoExtrudesChangesNoPixel) {
  std::string mask;
  for (const std::string who : {"cpu", "vertex", "geometry"}) {
    const Ran ran = umbrage({"render", "sample:tower", "--technique", "zfail", "--extrude", who, "--mask",
                             file("mask.png"), "--light", "point:20,-30,60", "--size", "200x150"});
    if (ran.code == 4) GTEST_SKIP() << "no graphics here: " << ran.err;
    ASSERT_EQ(ran.code, 0) << ran.err;
    if (mask.empty()) mask = read("mask.png");
    EXPECT_TRUE(read("mask.png") == mask) << who;
  }
}

// A side of every triangle is more than 8 bits count on the way; a silhouette's are not.
TEST_F(RenderCommand, CountersThatSaturateLoseShadowsOfSingleTriangles) {
  const auto compare = [&](const std::string& technique, const std::string& counter) {
    return umbrage({"compare", "sample:courtyard", "--technique", technique, "--against", "ray_traced", "--volume-fill",
                    "plain", "--stencil-counter", counter, "--size", "320x180"});
  };
  if (compare("zfail", "exact").code == 4) GTEST_SKIP() << "no graphics here";
  EXPECT_EQ(compare("zfail", "saturate").code, 0);
  EXPECT_EQ(compare("volumes_brute", "exact").code, 0);
  EXPECT_EQ(compare("volumes_brute", "saturate").code, 1);
}

TEST_F(RenderCommand, CompareAgreesAndSaysSo) {
  const auto box = writeBox();
  const Ran ran = umbrage({"compare", box, "--ground", "--technique", "ray_traced", "--against", "ray_traced", "--size",
                           "100x80", "-o", file("difference.png"), "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto json = Json::parse(ran.out);
  EXPECT_EQ(json["agree"], true);
  EXPECT_EQ(json["lights"][0]["differing"], 0);
  EXPECT_TRUE(exists("difference.png"));
}

TEST_F(RenderCommand, EveryTechniqueOfThisMachineAgreesWithTheTruth) {
  const auto box = writeBox();
  const Ran listed = umbrage({"techniques", "--json"});
  ASSERT_EQ(listed.code, 0) << listed.err;
  for (const auto& technique : Json::parse(listed.out)) {
    const auto name = technique["name"].get<std::string>();
    const Ran ran =
        umbrage({"compare", box, "--ground", "--technique", name, "--size", "320x200", "--light", "point:3,2,5"});
    const bool available = technique["available"], approximate = technique["approximate"];
    if (available && approximate)
      EXPECT_LE(ran.code, 1) << name << "\n" << ran.out << ran.err;
    else
      EXPECT_EQ(ran.code, available ? 0 : 4) << name << "\n" << ran.out << ran.err;
  }
}

// What single techniques are asked for reaches them, and they tell what came of it.
TEST_F(RenderCommand, PlanesAndShadowMapsAreAsAskedFor) {
  const auto stats = [&](Words words) {
    for (const char* word : {"--size", "200x150", "--light", "directional:1,1,-2", "--stats"}) words.push_back(word);
    words.push_back(file("s.json"));
    words.insert(words.begin(), {"render", "sample:courtyard", "--ground", "--technique"});
    const Ran ran = umbrage(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.code == 0 ? readJson(file("s.json")) : Json();
  };
  if (umbrage({"render", "sample:courtyard", "--technique", "planar", "--size", "8x8", "--mask", file("m.png")}).code ==
      4)
    GTEST_SKIP() << "no graphics here";
  const auto ground = stats({"planar", "--plane", "0,0,0,0,0,1"}), many = stats({"planar", "--planes", "60"});
  EXPECT_EQ(ground["lights"][0]["planes"], 1);
  EXPECT_GT(ground["unshadowed_pixels"], many["unshadowed_pixels"]);
  EXPECT_EQ(stats({"shadow_map", "--map-size", "512", "--map-filter", "0", "--map-bias",
                   "0.0001,0.1"})["lights"][0]["shadow_map_texels"],
            512 * 512);
  EXPECT_EQ(stats({"shadow_map_perspective", "--map-size", "auto"})["lights"][0]["shadow_maps"], 1);
}

}  // namespace
}  // namespace umbrage::cli_test
