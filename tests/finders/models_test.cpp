#include <gtest/gtest.h>

#include <cstdlib>

#include "conformance/models.hpp"
#include "finders/agreement.hpp"
#include "support/test_data.hpp"

namespace umbrage::finders {
namespace {

// The whole collection is for scripts/sweep; here every so many files of a folder, the same ones every time.
constexpr std::size_t kFilesPerFolder = 8;
constexpr std::size_t kLargestFile = 4u << 20u;

class RealSilhouettes : public testing::TestWithParam<std::string> {};

TEST_P(RealSilhouettes, AreTheSameByEveryFinder) {
  const auto folder = support::testData() / GetParam();
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no test data at " << folder;
  std::size_t loaded = 0;
  const auto files = conformance::modelFiles(folder);
  for (std::size_t i = 0; i < files.size(); i += files.size() / kFilesPerFolder + 1) {
    if (std::filesystem::file_size(files[i]) > kLargestFile) continue;
    const auto verdict = judge(files[i]);
    if (!verdict) continue;
    ++loaded;
    EXPECT_EQ(verdict->disagreement, "") << files[i];
  }
  EXPECT_GT(loaded, 0u);
}

INSTANTIATE_TEST_SUITE_P(Folders, RealSilhouettes, testing::Values("mesh", "architecture", "inventor", "gltf", "city"),
                         [](const testing::TestParamInfo<std::string>& row) { return row.param; });

}  // namespace
}  // namespace umbrage::finders
