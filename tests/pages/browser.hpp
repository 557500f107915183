#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace umbrage::pages_test {

/// What a page is once a browser has read it.
struct Opened {
  std::string dom;                      ///< as its scripts left it
  std::vector<std::string> complaints;  ///< what the browser says of it: errors of scripts, files that are not there
};

/// Whether Chromium is here.
[[nodiscard]] bool browserIsHere();

/// Opens a page in Chromium, without a screen and without a network. `script` runs after the page's own, when all is loaded; REQUIRES: the page ends with
/// "</body>\n</html>\n" where there is one. `scratch`: a folder for the browser's own files.
[[nodiscard]] Opened open(const std::filesystem::path& page, const std::filesystem::path& scratch,
                          const std::string& script = {});

/// How often `what` stands in `text`.
[[nodiscard]] std::size_t count(const std::string& text, const std::string& what);

/// A folder of its own for every test, removed at the end; skips aloud where there is no browser.
class PageTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  /// Runs the program and gives back its exit code; what it says stands in "said".
  [[nodiscard]] int umbrage(const std::string& words) const;
  [[nodiscard]] Opened opened(const std::string& page, const std::string& script = {}) const {
    return open(file(page), file("browser"), script);
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace umbrage::pages_test
