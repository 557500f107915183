#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "viewer.hpp"

// Command lines.
namespace umbrage::demo_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Ended {
  int code;
  std::string said;
};

Ended run(std::vector<std::string> words, std::vector<std::string> environment) {
  const Folder folder;
  words.insert(words.begin(), UMBRAGE_DEMO);
  Process demo(words, environment, folder / "said");
  const int code = demo.wait();
  return {code, demo.said()};
}

const std::vector<std::string> kNoDisplay{"DISPLAY=", "WAYLAND_DISPLAY=", "QT_QPA_PLATFORM="};

TEST(Usage, HelpHasEveryOptionAndKeyAndNeedsNoDisplay) {
  const Ended help = run({"-h"}, kNoDisplay);
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--file",     "--size",    "--method",
                           "--windows",  "--folder",  "--picture",
                           "--press",    "--verbose", "ESC",
                           "F1 ",        "F2 ",       "F3 ",
                           "F4 ",        "F5 F6",     "F7 F8",
                           "F9",         "F11 F12",   "{ }",
                           "1 2 3 4",    "5 ",        "6 ",
                           "O ",         "V ",        "X ",
                           "Left Right", "Up Down",   "PageUp PageDown"})
    EXPECT_THAT(help.said, HasSubstr(word));
}

TEST(Usage, TheDocumentationHasTheKeysOfTheHelp) {
  const std::string help = run({"-h"}, kNoDisplay).said;
  const std::string page = textOf(UMBRAGE_SOURCE_DIR "/docs/shadows_demo.md");
  std::istringstream lines(help.substr(help.find("Keys:\n") + 6));
  int rows = 0;
  for (std::string line; std::getline(lines, line) && line.size() > 19; ++rows)
    EXPECT_THAT(page, HasSubstr("| " + line.substr(19) + " |")) << line;
  EXPECT_EQ(rows, 18);
}

TEST(Usage, MistakesAreToldWithExitCodes) {
  EXPECT_EQ(run({"--method", "magic"}, kNoDisplay).code, 2);
  EXPECT_THAT(run({"--method", "magic"}, kNoDisplay).said, AllOf(HasSubstr("error: "), HasSubstr("zfail")));
  EXPECT_EQ(run({"--size", "800"}, kNoDisplay).code, 2);
  EXPECT_EQ(run({"--size", "800x600x2"}, kNoDisplay).code, 2);
  EXPECT_EQ(run({"--windows", "9"}, kNoDisplay).code, 2);
  EXPECT_EQ(run({"--press", "F1,F99"}, kNoDisplay).code, 2);
  EXPECT_EQ(run({"--nonsense"}, kNoDisplay).code, 2);
  EXPECT_EQ(run({}, kNoDisplay).code, 4);
  EXPECT_THAT(run({}, kNoDisplay).said, HasSubstr("DISPLAY"));
}

using Files = ViewerTest;

TEST_F(Files, ThatCannotBeReadAreRefused) {
  const auto refused = [&](const std::string& file) {
    const Ended ended = run({"-f", file}, display().environment());
    EXPECT_EQ(ended.code, 3) << ended.said;
    EXPECT_THAT(ended.said, AllOf(HasSubstr("error: "), HasSubstr(file)));
  };
  refused((folder() / "absent.iv").string());
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder() / name) << text;
    return (folder() / name).string();
  };
  refused(write("noise.iv", "this is no scene"));
  refused(write("cut.iv", "#Inventor V2.1 ascii\nSeparator { Cube { width "));
  refused(write("circle.iv", "#Inventor V2.1 ascii\nDEF A Separator { Cube { } USE A }"));
}

}  // namespace
}  // namespace umbrage::demo_test
