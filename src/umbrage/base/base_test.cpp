#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "umbrage/base/angle.hpp"
#include "umbrage/base/check.hpp"
#include "umbrage/base/error.hpp"
#include "umbrage/base/file.hpp"

namespace umbrage {
namespace {

std::filesystem::path freshFolder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("umbrage_base_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

std::string textOf(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path).rdbuf();
  return out.str();
}

TEST(Angle, KeepsItsUnit) {
  EXPECT_DOUBLE_EQ(Angle::degrees(180).radians(), std::numbers::pi);
  EXPECT_NEAR(Angle::degrees(-30).wrapped().degrees(), 330, 1e-12);
  EXPECT_NEAR(Angle::degrees(750).wrapped().degrees(), 30, 1e-12);
}

TEST(ErrorText, NamesThePlaceFirst) {
  const Error error = fail(ErrorCode::input, "no faces", "a.obj").value();
  EXPECT_EQ(error.text(), "a.obj: no faces");
  EXPECT_EQ(exitCode(ErrorCode::usage), 2);
  EXPECT_EQ(exitCode(ErrorCode::device), 4);
}

TEST(WriteFile, ReplacesWholeAndLeavesNothingBeside) {
  const auto folder = freshFolder("write");
  ASSERT_TRUE(writeFile(folder / "a.txt", "first"));
  ASSERT_TRUE(writeFile(folder / "a.txt", "second"));
  EXPECT_EQ(textOf(folder / "a.txt"), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(WriteFile, AFailedWriterLeavesTheOldFile) {
  const auto folder = freshFolder("failed");
  ASSERT_TRUE(writeFile(folder / "a.txt", "old"));
  const auto done = writeFileWith(folder / "a.txt", [](const std::filesystem::path& temporary) -> Result<void> {
    std::ofstream(temporary) << "half";
    return fail(ErrorCode::output, "disk full");
  });
  EXPECT_FALSE(done);
  EXPECT_EQ(textOf(folder / "a.txt"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(WriteFile, DevicesAreNotReplaced) {
  EXPECT_EQ(writeFile("/dev/null", "x").error().code, ErrorCode::output);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteFile, AMissingFolderIsAnErrorThatNamesTheFile) {
  const auto done = writeFile("/nonexistent/folder/a.txt", "x");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::output);
  EXPECT_EQ(done.error().where, "/nonexistent/folder/a.txt");
}

TEST(ReadFile, RefusesWhatIsNoRegularFileOrTooLarge) {
  const auto folder = freshFolder("read");
  EXPECT_FALSE(readFile(folder));
  EXPECT_FALSE(readFile(folder / "absent"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(readFile(folder / "pipe"));
  ASSERT_TRUE(writeFile(folder / "five", "12345"));
  EXPECT_FALSE(readFile(folder / "five", 4));
  EXPECT_EQ(readFile(folder / "five").value().size(), 5u);
}

TEST(CheckDeathTest, PrintsTheCondition) {
  EXPECT_DEATH(UMBRAGE_CHECK(1 + 1 == 3, "arithmetic"), "1 \\+ 1 == 3 \\(arithmetic\\)");
}

}  // namespace
}  // namespace umbrage
