#include <gmock/gmock.h>

#include <csignal>
#include <fstream>

#include <nlohmann/json.hpp>

#include "program.hpp"

// How the program behaves towards files, pipes and signals.
namespace umbrage::cli_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Behaviour : public CliTest {};

TEST_F(Behaviour, AMissingSceneIsTheInputsFault) {
  const Ran ran = umbrage({"render", file("none.obj"), "-o", file("out.png")});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, AllOf(StartsWith("error: "), HasSubstr("none.obj")));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Behaviour, AFolderOrAPipeIsNoScene) {
  EXPECT_EQ(umbrage({"info", folder().string()}).code, 3);
  EXPECT_EQ(umbrage({"info", "/dev/null"}).code, 3);
}

TEST_F(Behaviour, OutputsThatCannotBeWrittenAreSaidBeforeTheWork) {
  const auto box = writeBox();
  for (const auto& path : {file("no/such/folder/out.png"), folder().string() + "/sub.png/x.png"}) {
    const Ran ran = umbrage({"render", box, "-o", path});
    EXPECT_EQ(ran.code, 3) << path;
    EXPECT_THAT(ran.err, AllOf(StartsWith("error: "), HasSubstr("no folder")));
  }
  std::filesystem::create_directory(folder() / "folder.png");
  EXPECT_EQ(umbrage({"render", box, "-o", file("folder.png")}).code, 3);
  EXPECT_THAT(files(), ElementsAre("box.off", "folder.png"));
}

TEST_F(Behaviour, DevicesAreNotReplacedByFiles) {
  const Ran ran = umbrage({"render", writeBox(), "--stats", "/dev/null", "--size", "8x8"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(Behaviour, AnOutputIsReplacedWhole) {
  const auto box = writeBox();
  write("out.png", "old");
  ASSERT_EQ(umbrage({"render", box, "-o", file("out.png"), "--size", "8x8"}).code, 0);
  EXPECT_GT(std::filesystem::file_size(folder() / "out.png"), 50U);
  EXPECT_THAT(files(), ElementsAre("box.off", "out.png"));
}

TEST_F(Behaviour, TheSecondOutputsFailureNamesTheFirst) {
  // Nobody may make a file there, which only the attempt shows.
  const auto box = writeBox();
  const Ran ran = umbrage({"render", box, "-o", file("out.png"), "--mask", "/proc/umbrage-mask.png", "--size", "8x8"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, AllOf(HasSubstr("cannot be written"), HasSubstr("written before it: " + file("out.png"))));
  EXPECT_THAT(files(), ElementsAre("box.off", "out.png"));
}

TEST_F(Behaviour, AReaderThatGoesAwayIsHarmless) {
  RunOptions options;
  options.closeOutput = true;
  const Ran ran = umbrage({"info", writeBox(), "--json"}, options);
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.signal, 0);
}

TEST_F(Behaviour, AFullDeviceIsSaid) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "/dev/full is absent";
  RunOptions options;
  options.outputTo = "/dev/full";
  const Ran ran = umbrage({"info", writeBox()}, options);
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("standard output"));
}

TEST_F(Behaviour, AnInterruptLeavesNothingHalfWritten) {
  for (const int milliseconds : {20, 100, 300, 700}) {
    RunOptions options;
    options.interruptAfter = std::chrono::milliseconds(milliseconds);
    const Ran ran = umbrage({"render", "sample:building", "--ground", "-o", file("out.png"), "--mask", file("m.png"),
                             "--size", "3000x2000"},
                            options);
    EXPECT_TRUE(ran.signal == SIGINT || ran.code == 0) << ran.code << ran.err;
    for (const auto& name : files()) EXPECT_THAT(name, testing::Not(HasSubstr(".part"))) << milliseconds;
  }
}

TEST_F(Behaviour, QuietSaysNothingAndVerboseSaysWhy) {
  const auto box = writeBox();
  const Ran quiet = umbrage({"render", box, "-o", file("a.png"), "--size", "8x8", "--quiet"});
  EXPECT_EQ(quiet.out + quiet.err, "");
  const Ran verbose = umbrage({"render", box, "-o", file("a.png"), "--size", "8x8", "--verbose"});
  EXPECT_EQ(verbose.code, 0);
  EXPECT_THAT(verbose.err, AllOf(HasSubstr("south-west"), HasSubstr("no light given"), HasSubstr("auto")));
}

TEST_F(Behaviour, NamesFromFilesCannotSteerTheTerminal) {
  const auto scene = write("evil.obj", "o \033[31mred\007\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Ran ran = umbrage({"info", scene});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out.find('\033'), std::string::npos);
}

TEST_F(Behaviour, InfoCountsABox) {
  const Ran ran = umbrage({"info", writeBox(), "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto json = nlohmann::json::parse(ran.out);
  EXPECT_EQ(json["triangles"], 12);
  EXPECT_EQ(json["edges"], 18);
  EXPECT_EQ(json["border_edges"], 0);
  EXPECT_EQ(json["non_manifold_edges"], 0);
  EXPECT_EQ(json["topology"], "closed");
  EXPECT_EQ(json["up"], "z");
  EXPECT_EQ(json["bounds"]["max"], (nlohmann::json{1.0, 1.0, 2.0}));
  EXPECT_EQ(json["parts"].size(), 1U);
  EXPECT_GE(json["materials"].size(), 1U);
  EXPECT_TRUE(json["lights"].is_array());
  EXPECT_TRUE(json["warnings"].is_array());
}

TEST_F(Behaviour, SunMatchesTheAlmanac) {
  struct Expected {
    const char* time;
    double elevation, azimuth;
  };
  for (const auto& expected : {Expected{"09:00", 22.630, 114.483}, Expected{"12:00", 42.406, 163.413},
                               Expected{"13:00", 43.499, 183.900}, Expected{"17:00", 19.036, 250.193}}) {
    const Ran ran = umbrage({"sun", "--lat", "48.2", "--lon", "16.37", "--date", "2026-09-18", "--at", expected.time,
                             "--tz", "Europe/Vienna", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto json = nlohmann::json::parse(ran.out);
    EXPECT_NEAR(json["elevation"].get<double>(), expected.elevation, 0.01);
    EXPECT_NEAR(json["azimuth"].get<double>(), expected.azimuth, 0.01);
  }
}

TEST_F(Behaviour, AProfileIsThreePictures) {
  const std::vector<std::string> words{"profile", writeBox(), "-o",         file("p.png"), "--lat",  "-33.9",  "--lon",
                                       "151.2",   "--date",   "2026-06-21", "--tz",        "solar",  "--from", "10:00",
                                       "--to",    "14:00",    "--step",     "60",          "--size", "320x200"};
  const Ran ran = umbrage(words);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, file("p.png") + "\n" + file("p-hours.png") + "\n" + file("p.gif") + "\n");
  EXPECT_THAT(files(), ElementsAre("box.off", "p-hours.png", "p.gif", "p.png"));
  auto again = words;
  again[3] = file("q.png");
  ASSERT_EQ(umbrage(again).code, 0);
  for (const auto* suffix : {".png", "-hours.png", ".gif"})
    EXPECT_TRUE(read("p" + std::string(suffix)) == read("q" + std::string(suffix)));
  auto parts = words;
  parts.insert(parts.end(), {"--casters", "no-such-part"});
  EXPECT_EQ(umbrage(parts).code, 2);
}

TEST_F(Behaviour, VolumesAreShownWhereThereAreGraphics) {
  const auto box = writeBox();
  const Ran plain = umbrage({"render", box, "--ground", "-o", file("plain.png"), "--size", "160x120"});
  ASSERT_EQ(plain.code, 0) << plain.err;
  const Ran shown = umbrage(
      {"render", box, "--ground", "-o", file("shown.png"), "--size", "160x120", "--show", "volumes,silhouette"});
  ASSERT_TRUE(shown.code == 0 || shown.code == 4) << shown.err;
  EXPECT_EQ(exists("shown.png"), shown.code == 0);
  EXPECT_FALSE(read("plain.png") == read("shown.png"));
}

TEST_F(Behaviour, WithoutGraphicsOnlyWhatNeedsThemFails) {
  const auto box = writeBox();
  RunOptions options;
  options.hideGraphics = true;
  const std::vector<std::string> words{"render", box, "--ground", "-o", file("out.png"), "--size", "32x32"};
  for (const auto& more : std::vector<std::vector<std::string>>{{"--technique", "zfail"}, {"--show", "volumes"}}) {
    auto asked = words;
    asked.insert(asked.end(), more.begin(), more.end());
    const Ran ran = umbrage(asked, options);
    EXPECT_EQ(ran.code, 4) << more[0] << ran.err;
    EXPECT_THAT(ran.err, StartsWith("error: "));
    EXPECT_FALSE(exists("out.png"));
  }
  const Ran automatic = umbrage(words, options);
  EXPECT_EQ(automatic.code, 0) << automatic.err;
  EXPECT_EQ(umbrage({"techniques"}, options).code, 0);
}

TEST_F(Behaviour, SamplesAreListedAndWritten) {
  const Ran list = umbrage({"sample", "--list"});
  ASSERT_EQ(list.code, 0);
  for (const auto* name : {"courtyard", "tower", "industrial", "building"}) EXPECT_THAT(list.out, HasSubstr(name));
  // Files hold no lights, and say so in their own frame: the lamp hangs 7 m high.
  const Ran life = umbrage({"sample", "still_life", "-o", file("life.glb")});
  EXPECT_EQ(life.code, 0) << life.err;
  EXPECT_THAT(life.err, AllOf(StartsWith("warning: "), HasSubstr("'lamp' (--light point:-3.5,7,5.5,#ffffff,0.9)"),
                              HasSubstr("sample:still_life")));
  EXPECT_THAT(umbrage({"sample", "still_life", "-o", file("life.city.json")}).err, HasSubstr("point:-3.5,-5.5,7,"));
  ASSERT_EQ(umbrage({"sample", "courtyard", "-o", file("courtyard.glb")}).code, 0);
  const auto count = [&](const std::string& scene) {
    const Ran ran = umbrage({"info", scene, "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return nlohmann::json::parse(ran.out)["triangles"].get<int>();
  };
  EXPECT_EQ(count(file("courtyard.glb")), count("sample:courtyard"));
}

}  // namespace
}  // namespace umbrage::cli_test
