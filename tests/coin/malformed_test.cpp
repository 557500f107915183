#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "support/test_data.hpp"

// Broken files through the manager: no worse than through Coin, and better where what is wrong can be told.
namespace umbrage::coin::test {
namespace {

constexpr int kDied = -1;

std::filesystem::path dataFolder() { return support::testData() / "malformed"; }

/// The exit code of a process of its own, or kDied: a signal, or more than 10 seconds.
int drawn(const std::filesystem::path& file, const char* how) {
  const std::string command = "timeout 10 '" UMBRAGE_COIN_DRAW "' '" + file.string() + "' " + how + " >/dev/null 2>&1";
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return code < 100 ? code : kDied;
}

TEST(Malformed, FilesThatCoinLivesThroughAreDrawnOrRefused) {
  const auto files = support::filesBelow(dataFolder(), {".iv", ".wrl"});
  if (files.empty()) GTEST_SKIP() << "no test data at " << dataFolder();
  std::size_t lived = 0, saved = 0;
  for (const auto& file : files) {
    const int plain = drawn(file, "plain"), shadows = drawn(file, "shadows");
    if (plain == 4) GTEST_SKIP() << "no OpenGL here";
    lived += plain != kDied;
    saved += plain == kDied && shadows != kDied;
    EXPECT_TRUE(plain == kDied || shadows != kDied) << file;
  }
  std::printf("%zu files: Coin lives through %zu, and through the manager %zu more\n", files.size(), lived, saved);
  EXPECT_GT(lived, files.size() / 2);
}

TEST(Malformed, GraphsThatNeverEndAreRefused) {
  const auto folder = dataFolder() / "generated";
  for (const char* name : {"iv_self_use.iv", "iv_billion_laughs.iv"}) {
    if (!std::filesystem::exists(folder / name)) GTEST_SKIP() << "no test data at " << folder;
    const int code = drawn(folder / name, "shadows");
    if (code == 4) GTEST_SKIP() << "no OpenGL here";
    EXPECT_EQ(code, 3) << name;
  }
}

}  // namespace
}  // namespace umbrage::coin::test
