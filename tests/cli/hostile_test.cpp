#include <gmock/gmock.h>

#include <algorithm>

#include "program.hpp"
#include "umbrage/png/png.hpp"

// Every broken or hostile file of the public collection: an exit code of the contract within 10 seconds, no signal,
// nothing half written.
namespace umbrage::cli_test {
namespace {

class Hostile : public CliTest, public testing::WithParamInterface<const char*> {
 protected:
  void survives(const std::filesystem::path& model, const std::vector<std::string>& words) const {
    RunOptions options;
    options.limit = std::chrono::milliseconds(10000);
    const Ran ran = umbrage(words, options);
    EXPECT_FALSE(ran.timedOut) << model;
    EXPECT_EQ(ran.signal, 0) << model;
    EXPECT_TRUE(ran.timedOut || (ran.code >= 0 && ran.code <= 4)) << model << " " << ran.code;
    if (ran.code != 0) {
      EXPECT_THAT(ran.err, testing::StartsWith("error: ")) << model;
    }
    for (const auto& name : files()) {
      EXPECT_EQ(name, "out.png") << model;
      EXPECT_TRUE(ran.code == 0 && png::read(file(name))) << model;
      std::filesystem::remove(file(name));
    }
  }
};

TEST_P(Hostile, FilesAreErrorsOrPictures) {
  const auto folder = testData() / "malformed" / GetParam();
  if (testData().empty() || !std::filesystem::exists(folder))
    GTEST_SKIP() << "the public models are absent (UMBRAGE_TEST_DATA)";
  std::vector<std::filesystem::path> models;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) models.push_back(entry.path());
  std::sort(models.begin(), models.end());
  EXPECT_FALSE(models.empty());
  for (const auto& model : models) {
    survives(model, {"info", model.string(), "--json"});
    survives(model, {"render", model.string(), "--ground", "-o", file("out.png"), "--size", "64x48", "--technique",
                     "ray_traced"});
  }
}

INSTANTIATE_TEST_SUITE_P(Malformed, Hostile,
                         testing::Values("assimp", "city", "generated", "gltf", "gltf-validator", "inventor", "json",
                                         "mesh"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace umbrage::cli_test
