#include <gmock/gmock.h>

#include <algorithm>

#include "program.hpp"

// Command lines that make no sense: exit code 2, the option's name and a remedy on standard error, nothing written.
namespace umbrage::cli_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

using Words = std::vector<std::string>;

struct Wrong {
  std::string name;
  Words words;  ///< "BOX" stands for the box, "OUT" for a picture
  std::string says;
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

class Usage : public CliTest, public testing::WithParamInterface<Wrong> {};

TEST_P(Usage, IsRefusedByName) {
  const auto box = writeBox();
  Words words = GetParam().words;
  for (auto& word : words) {
    if (word == "BOX") word = box;
    if (word == "OUT") word = file("out.png");
  }
  const Ran ran = umbrage(words);
  EXPECT_EQ(ran.code, 2) << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, AllOf(StartsWith("error: "), HasSubstr(GetParam().says)));
  EXPECT_THAT(files(), ElementsAre("box.off"));
}

Wrong render(const std::string& name, const Words& more, const std::string& says) {
  Words words{"render", "BOX", "-o", "OUT"};
  words.insert(words.end(), more.begin(), more.end());
  return {name, words, says};
}

Wrong profile(const std::string& name, const Words& more, const std::string& says) {
  Words words{"profile", "BOX",    "-o",         "OUT",  "--lat",         "48.2",   "--lon",
              "16.37",   "--date", "2026-09-18", "--tz", "Europe/Vienna", "--from", "09:00"};
  if (std::find(more.begin(), more.end(), "--to") == more.end()) words.insert(words.end(), {"--to", "17:00"});
  words.insert(words.end(), more.begin(), more.end());
  return {name, words, says};
}

INSTANTIATE_TEST_SUITE_P(
    CommandLines, Usage,
    testing::Values(
        Wrong{"NoCommand", {}, "a command is missing"}, Wrong{"UnknownCommand", {"rendre", "BOX"}, "rendre"},
        Wrong{"NoScene", {"info"}, "SCENE"}, Wrong{"TwoScenes", {"info", "BOX", "BOX"}, "box.off"},
        Wrong{"EmptyScene", {"info", ""}, "SCENE"}, Wrong{"UnknownOption", {"info", "BOX", "--jsn"}, "--jsn"},
        Wrong{"NothingToWrite", {"render", "BOX"}, "-o OUT.png"}, render("EyeOfTwo", {"--eye", "1,2"}, "--eye"),
        render("EyeNotANumber", {"--eye", "nan,0,0"}, "--eye"), render("EyeInfinite", {"--eye", "inf,0,0"}, "--eye"),
        render("EyeTooFar", {"--eye", "1e300,0,0"}, "--eye"), render("EyeWithoutValue", {"--eye"}, "--eye"),
        render("EyeTakesAnOption", {"--eye", "--target", "0,0,0"}, "--eye"),
        render("EyeTwice", {"--eye", "1,2,3", "--eye", "1,2,3"}, "--eye"),
        render("EyeIsTarget", {"--eye", "1,2,3", "--target", "1,2,3"}, "--target"),
        render("FovZero", {"--fov", "0"}, "--fov"), render("FovHuge", {"--fov", "180"}, "--fov"),
        render("FovNan", {"--fov", "nan"}, "--fov"), render("SizeWord", {"--size", "big"}, "--size"),
        render("SizeZero", {"--size", "0x10"}, "--size"), render("SizeNegative", {"--size", "-5x10"}, "--size"),
        render("SizeHuge", {"--size", "20000x10"}, "16384"),
        render("SizeTooMany", {"--size", "16384x16384"}, "8192x8192"),
        render("Ambient", {"--ambient", "2"}, "--ambient"), render("GroundNan", {"--ground", "nan"}, "--ground"),
        render("GroundOverflow", {"--ground", "1e999"}, "--ground"),
        render("GroundWord", {"--ground=high"}, "--ground"), render("LightWord", {"--light", "lamp"}, "--light"),
        render("LightZero", {"--light", "directional:0,0,0"}, "--light"),
        render("LightNan", {"--light", "point:nan,0,0"}, "--light"),
        render("LightColour", {"--light", "point:1,2,3,#12345"}, "#rrggbb"),
        render("SpotCutoff", {"--light", "spot:0,0,5,0,0,-1,200"}, "--light"),
        render("DiscOfNoSize", {"--light", "disc:0,0,5,0,0,-1,0"}, "no extent"),
        render("DiscOfNoDirection", {"--light", "disc:0,0,5,0,0,0,1"}, "points nowhere"),
        render("RectangleOnALine", {"--light", "rect:0,0,5,1,0,0,2,0,0"}, "no extent"),
        render("SunOfHalfTheSky", {"--light", "sun:0,0,-1,180"}, "no extent"),
        render("SphereShort", {"--light", "sphere:0,0,5"}, "sphere:x,y,z,RADIUS"),
        render("AreaLightForHard", {"--light", "sphere:0,0,5,1", "--technique", "zpass_cpu"}, "soft_cpu"),
        render("TerminatorOfFlatShading", {"--hide-terminator"}, "--smooth"),
        render("SmoothTooFar", {"--smooth", "120"}, "--smooth"), render("NoSamples", {"--samples", "0"}, "--samples"),
        render("HalfASample", {"--samples", "1.5"}, "--samples"),
        render("SoftErrorNegative", {"--soft-error", "-1"}, "--soft-error"),
        render("VeilLayersNegative", {"--veil-layers", "-1"}, "--veil-layers"),
        render("VeilLayersWord", {"--veil-layers", "many"}, "--veil-layers"),
        render("MapSize", {"--map-size", "1.5"}, "--map-size"), render("MapBias", {"--map-bias", "0.1"}, "--map-bias"),
        render("PlaneWithoutNormal", {"--plane", "0,0,0,0,0,0"}, "--plane"),
        render("TooManyPlanes", {"--planes", "128"}, "--planes"),
        render("Technique", {"--technique", "magic"}, "ray_traced"), render("Up", {"--up", "x"}, "--up"),
        render("Unit", {"--unit", "km"}, "--unit"), render("North", {"--north", "400"}, "--north"),
        render("Casters", {"--casters", "no-such-part"}, "no-such-part"),
        render("OneNameTwice", {"--mask", "OUT"}, "two outputs"),
        Wrong{"OverTheScene", {"render", "BOX", "--stats", "BOX"}, "what the command reads"},
        Wrong{"OneNameForPictureAndMask",
              {"render", "BOX", "-o", "m-1.png", "--mask", "m.png", "--light", "point:1,1,9", "--light", "point:2,1,9"},
              "two outputs"},
        Wrong{"NotPng", {"render", "BOX", "-o", "picture.jpg"}, ".png"},
        render("TooManySamples", {"--size", "8192x8192", "--antialias", "8"}, "--antialias"),
        render("AntialiasHalf", {"--antialias", "1.5"}, "--antialias"),
        render("AntialiasZero", {"--antialias", "0"}, "--antialias"),
        render("ShowUnknown", {"--show", "volume"}, "volumes, silhouette"),
        render("ExtrudeUnknown", {"--extrude", "gpu"}, "cpu, vertex, geometry"),
        render("StencilCounterUnknown", {"--stencil-counter", "clamp"}, "exact, wrap, saturate"),
        Wrong{"ShowWithoutPicture", {"render", "BOX", "--mask", "OUT", "--show", "volumes"}, "--show"},
        profile("ProfileStepZero", {"--step", "0"}, "--step"),
        profile("ProfileStepWord", {"--step", "often"}, "--step"),
        profile("ProfileBackwards", {"--step", "60", "--to", "05:00"}, "05:00"),
        profile("ProfileWithoutStep", {}, "--step"),
        Wrong{"CompareWithoutTechnique", {"compare", "BOX"}, "--technique"},
        Wrong{"SampleName", {"sample", "castle", "-o", "castle.glb"}, "castle"},
        Wrong{"SampleWithoutFile", {"sample", "courtyard"}, "-o"}, Wrong{"SampleWithoutName", {"sample"}, "--list"},
        Wrong{"SampleScene", {"info", "sample:castle"}, "castle"},
        Wrong{"SunWithoutDate", {"sun", "--lat", "0", "--lon", "0", "--at", "12:00", "--tz", "solar"}, "--date"},
        Wrong{"SunLatitude",
              {"sun", "--lat", "91", "--lon", "0", "--date", "2026-01-01", "--at", "12:00", "--tz", "solar"},
              "--lat"},
        Wrong{"SunDate",
              {"sun", "--lat", "0", "--lon", "0", "--date", "2026-02-30", "--at", "12:00", "--tz", "solar"},
              "--date"},
        Wrong{"SunTime",
              {"sun", "--lat", "0", "--lon", "0", "--date", "2026-02-20", "--at", "25:00", "--tz", "solar"},
              "--at"},
        Wrong{"SunZone",
              {"sun", "--lat", "0", "--lon", "0", "--date", "2026-02-20", "--at", "12:00", "--tz", "Mars/Base"},
              "--tz"}),
    [](const auto& parameter) { return parameter.param.name; });

TEST_F(CliTest, HelpAndVersionAreNoErrors) {
  const Ran help = umbrage({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const auto* command : {"info", "techniques", "sun", "render", "radiosity", "compare", "gallery", "cut",
                              "profile", "outline", "envelope", "isochrones", "terrain", "sample", "verify"})
    EXPECT_THAT(help.out, HasSubstr(command));
  // What later versions bring is not pretended.
  EXPECT_THAT(help.out, Not(HasSubstr("  view")));
  EXPECT_EQ(umbrage({"render", "--help"}).code, 0);
  EXPECT_THAT(umbrage({"render", "--help"}).out, HasSubstr("--light"));
  const Ran version = umbrage({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.out, StartsWith("umbrage "));
}

TEST_F(CliTest, ValuesMayStartWithAMinusInEveryPosition) {
  const auto box = writeBox();
  const auto out = file("a.png");
  for (const Words& words : std::vector<Words>{
           {"render", "--eye", "-4,-2,1", "--target", "-1,0,1", box, "-o", out, "--size", "16x16"},
           {"render", box, "--light", "directional:-1,-1,-1", "--eye=-4,2,1", "-o", out, "--size", "16x16"},
           {"render", "--ground", "-2", box, "-o", out, "--size", "16x16"},
           {"render", box, "-o", out, "--size", "16x16", "--ground", "-2"},
           {"render", box, "-o", out, "--size", "16x16", "--ground"},
           {"render", "--ground", box, "-o", out, "--size", "16x16"},
           {"render", box, "--ground", "0", "-o", out, "--size", "16x16"},
           {"render", box, "--ground", "-o", out, "--size", "16x16"},
           {"render", box, "--north", "-10", "-o", out, "--size", "16x16"},
           {"--quiet", "render", box, "-o", out, "--size", "16x16"},
           {"render", box, "-o", out, "--size", "16x16", "--quiet"},
       }) {
    std::filesystem::remove(out);
    const Ran ran = umbrage(words);
    EXPECT_EQ(ran.code, 0) << testing::PrintToString(words) << ran.err;
    EXPECT_TRUE(exists("a.png")) << testing::PrintToString(words);
    EXPECT_THAT(ran.err, IsEmpty());
  }
}

}  // namespace
}  // namespace umbrage::cli_test
