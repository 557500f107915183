#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "cli/program.hpp"
#include "console_page.hpp"

// What pages of the documentation say that the program prints, it prints.
namespace umbrage::docs_test {
namespace {

namespace fs = std::filesystem;

const fs::path kDocs = fs::path(UMBRAGE_SOURCE_DIR) / "docs";

std::string ranInFolder(const std::vector<std::string>& words, const fs::path& folder) {
  const auto ran = cli_test::umbrage(words, {.limit = std::chrono::minutes(4), .workingFolder = folder});
  return ran.err + ran.out + (ran.code != 0 ? "(exit code " + std::to_string(ran.code) + ")\n" : "");
}

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Page : public testing::TestWithParam<fs::path> {};

TEST_P(Page, TellsWhatTheProgramPrints) {
  const std::string now = withCommandsRun(GetParam(), ranInFolder);
  if (const char* approve = std::getenv("UMBRAGE_APPROVE"); approve && *approve == '1')
    std::ofstream(GetParam(), std::ios::binary) << now;
  EXPECT_EQ(bytesOf(GetParam()), now) << "\nwhen the new text is right, run the test again with UMBRAGE_APPROVE=1";
}

INSTANTIATE_TEST_SUITE_P(Docs, Page, testing::ValuesIn(pagesWithCommands(kDocs)), [](const auto& page) {
  std::string name = page.param.stem().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return page.param.parent_path().stem().string() + "_" + name;
});

TEST(ConsolePage, RunsTheCommandsOfItsBlocksAndNothingElse) {
  const fs::path page = fs::path(testing::TempDir()) / "umbrage_console_page.md";
  std::ofstream(page)
      << "Text\n```\n$ umbrage no\n```\n```console\n$ umbrage sun --tz 'a b'\nold\n\n$ umbrage info\n```\nEnd\n";
  std::vector<std::vector<std::string>> seen;
  const auto text = withCommandsRun(page, [&](const auto& words, const auto&) {
    seen.push_back(words);
    return "new\n";
  });
  EXPECT_EQ(
      text,
      "Text\n```\n$ umbrage no\n```\n```console\n$ umbrage sun --tz 'a b'\nnew\n\n$ umbrage info\nnew\n```\nEnd\n");
  EXPECT_THAT(seen, testing::ElementsAre(testing::ElementsAre("sun", "--tz", "a b"), testing::ElementsAre("info")));
  fs::remove(page);
}

// Of every preset there is an example that is run.
TEST(Docs, ShowEveryPresetAtWork) {
  std::string all;
  for (const auto& page : pagesWithCommands(kDocs)) all += bytesOf(page);
  const auto list = cli_test::umbrage({"verify", "--list-presets"});
  ASSERT_EQ(list.code, 0);
  std::istringstream lines(list.out);
  for (std::string line; std::getline(lines, line);)
    EXPECT_THAT(all, testing::HasSubstr("--preset " + line.substr(0, line.find(' ')) + " "));
}

}  // namespace
}  // namespace umbrage::docs_test
