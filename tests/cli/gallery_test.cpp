#include <gmock/gmock.h>

#include <map>

#include <nlohmann/json.hpp>

#include "program.hpp"

// The gallery through its files: what is judged by what, and what it leaves in its folder.
namespace umbrage::cli_test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using Words = std::vector<std::string>;
using Json = nlohmann::json;

class GalleryCommand : public CliTest {
 protected:
  [[nodiscard]] Ran gallery(Words more = {}, const RunOptions& options = {}) const {
    Words words{"gallery", writeBox(), "--ground", "--size", "96x64", "--frames", "1", "-o", file("out")};
    words.insert(words.end(), more.begin(), more.end());
    return umbrage(words, options);
  }
  /// By the technique's name.
  [[nodiscard]] std::map<std::string, Json> techniques() const {
    std::map<std::string, Json> all;
    const Json told = Json::parse(read("out/gallery.json"), nullptr, false);
    for (const auto& technique : told["techniques"]) all[technique["name"]] = technique;
    return all;
  }
};

TEST_F(GalleryCommand, EveryTechniqueIsThereAndJudged) {
  ASSERT_EQ(gallery().code, 0);
  const auto listed = Json::parse(umbrage({"techniques", "--json"}).out);
  const auto shown = techniques();
  EXPECT_EQ(shown.size(), listed.size());
  for (const auto& technique : listed) {
    const auto found = shown.find(technique["name"]);
    ASSERT_NE(found, shown.end()) << technique;
    const Json& entry = found->second;
    if (!technique["available"]) continue;
    for (const auto& [what, picture] : entry["files"].items())
      EXPECT_TRUE(exists("out/" + picture.get<std::string>())) << what;
  }
  EXPECT_TRUE(shown.at("ray_traced")["error"].is_null()) << "the truth is not judged";
  for (const auto* exact : {"zpass_cpu", "hybrid_cpu"}) {
    EXPECT_EQ(shown.at(exact)["error"]["truth"], "ray_traced");
    EXPECT_EQ(shown.at(exact)["error"]["far_from_edge"], 0);
  }
  EXPECT_EQ(shown.at("transparent_cpu")["error"]["truth"], "transparent_rays");
}

TEST_F(GalleryCommand, TakesSomeTechniquesAndTheirTruths) {
  ASSERT_EQ(gallery({"--technique", "zpass_cpu"}).code, 0);
  std::vector<std::string> names;
  for (const auto& [name, entry] : techniques()) names.push_back(name);
  EXPECT_THAT(names, ElementsAre("ray_traced", "zpass_cpu"));
}

TEST_F(GalleryCommand, ALightWithAnExtentIsItsCentreToHardTechniques) {
  ASSERT_EQ(gallery({"--technique", "zpass_cpu", "--technique", "soft_cpu", "--light", "disc:3,2,5,-3,-2,-4,1"}).code,
            0);
  const auto shown = techniques();
  EXPECT_EQ(shown.at("zpass_cpu")["error"]["truth"], "ray_traced");
  EXPECT_EQ(shown.at("zpass_cpu")["error"]["far_from_edge"], 0);
  EXPECT_EQ(shown.at("soft_cpu")["error"]["truth"], "soft_rays");
  EXPECT_LT(shown.at("soft_cpu")["error"]["rms"], 0.01);
}

TEST_F(GalleryCommand, SaysWhatCannotRun) {
  ASSERT_EQ(gallery({}, {.hideGraphics = true}).code, 0);
  const auto shown = techniques();
  EXPECT_TRUE(shown.at("zpass_cpu")["obstacle"].is_null());
  if (shown.contains("zfail")) {
    EXPECT_FALSE(shown.at("zfail")["obstacle"].is_null());
  }
}

TEST_F(GalleryCommand, ReplacesAnEarlierOneWhole) {
  ASSERT_EQ(gallery({"--technique", "soft_cpu"}).code, 0);
  ASSERT_TRUE(exists("out/soft_cpu.png"));
  ASSERT_EQ(gallery({"--technique", "zpass_cpu"}).code, 0);
  EXPECT_FALSE(exists("out/soft_cpu.png"));
  EXPECT_TRUE(exists("out/zpass_cpu.png"));
  EXPECT_THAT(files(), Each(Not(StartsWith(".")))) << "and nothing beside it";
}

TEST_F(GalleryCommand, KeepsFoldersThatHoldOtherThings) {
  std::filesystem::create_directory(folder() / "out");
  write("out/mine.txt", "mine");
  const auto refused = gallery();
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("holds other files"));
  EXPECT_EQ(read("out/mine.txt"), "mine");
  EXPECT_FALSE(exists("out/index.html"));
}

TEST_F(GalleryCommand, KeepsWhatWasPutBesideAnEarlierOne) {
  ASSERT_EQ(gallery({"--technique", "zpass_cpu"}).code, 0);
  write("out/house.obj", "v 0 0 0\n");
  EXPECT_EQ(gallery({"--technique", "zpass_cpu"}).code, 2);
  EXPECT_EQ(read("out/house.obj"), "v 0 0 0\n");
}

TEST_F(GalleryCommand, RefusesPlacesThatAreNone) {
  write("out", "a file");
  EXPECT_EQ(gallery().code, 3);
  EXPECT_EQ(read("out"), "a file");
  const auto absent = umbrage({"gallery", writeBox(), "-o", file("no/such/folder")});
  EXPECT_EQ(absent.code, 3);
  EXPECT_THAT(absent.err, HasSubstr("there is no folder"));
}

TEST_F(GalleryCommand, RefusesWordsThatMeanNothing) {
  EXPECT_EQ(gallery({"--technique", "auto"}).code, 2);
  EXPECT_EQ(gallery({"--technique", "zpas"}).code, 2);
  EXPECT_EQ(gallery({"--frames", "0"}).code, 2);
  EXPECT_EQ(gallery({"--size", "16384x4096"}).code, 2) << "more memory than is sensible";
  EXPECT_THAT(files(), ElementsAre("box.off"));
}

TEST_F(GalleryCommand, AFailureLeavesNothingBehind) {
  const auto failed = umbrage({"gallery", file("absent.off"), "-o", file("out")});
  EXPECT_EQ(failed.code, 3);
  EXPECT_THAT(files(), IsEmpty());
}

}  // namespace
}  // namespace umbrage::cli_test
