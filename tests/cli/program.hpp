#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/test_data.hpp"

namespace umbrage::cli_test {

/// How a run of the program ended.
struct Ran {
  int code = -1;          ///< exit code; -1 when a signal ended it
  int signal = 0;         ///< 0: it ended by itself
  bool timedOut = false;  ///< it was killed after the limit
  std::string out, err;
};

struct RunOptions {
  std::chrono::milliseconds limit{60000};
  std::filesystem::path workingFolder;
  bool hideGraphics = false;                    ///< as on a machine without any OpenGL driver
  bool closeOutput = false;                     ///< nobody reads its standard output
  std::string outputTo;                         ///< standard output goes to this file instead
  std::chrono::milliseconds interruptAfter{0};  ///< SIGINT after so long; 0: never
};

/// Runs the program under test.
[[nodiscard]] Ran umbrage(const std::vector<std::string>& words, const RunOptions& options = {});

/// A folder of its own for every test, removed at the end.
class CliTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  /// Names of all files in the folder, sorted; also hidden ones.
  [[nodiscard]] std::vector<std::string> files() const;
  /// The bytes of a file; empty when there is none.
  [[nodiscard]] std::string read(const std::string& name) const;
  std::string write(const std::string& name, const std::string& text) const;
  /// A box from (-1,-1,0) to (1,1,height), Z up.
  std::string writeBox(const std::string& name = "box.off", double height = 2.0) const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

using support::testData;

}  // namespace umbrage::cli_test
