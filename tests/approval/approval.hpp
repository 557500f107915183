#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace umbrage::approval {

/// Holds `text` against the approved file tests/approval/<name>.txt, which was read by a person before it was committed.
/// A difference leaves the new text in the build folder and says how to look at it; UMBRAGE_APPROVE=1 in the environment
/// writes the approved file instead of comparing.
inline testing::AssertionResult approved(const std::string& name, const std::string& text) {
  namespace fs = std::filesystem;
  const fs::path expected = fs::path(UMBRAGE_SOURCE_DIR) / "tests/approval" / (name + ".txt");
  const fs::path received = fs::path(UMBRAGE_BINARY_DIR) / "approval" / (name + ".txt");
  const auto write = [&](const fs::path& path) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  };
  if (const char* approve = std::getenv("UMBRAGE_APPROVE"); approve && *approve == '1') write(expected);
  std::ifstream file(expected, std::ios::binary);
  const std::string wanted{std::istreambuf_iterator<char>(file), {}};
  if (file && wanted == text) return testing::AssertionSuccess();
  write(received);
  return testing::AssertionFailure() << (file ? "differs from the approved text" : "nothing was approved yet")
                                     << "\n  diff " << expected << " " << received
                                     << "\nwhen the new text is right, run the test again with UMBRAGE_APPROVE=1";
}

}  // namespace umbrage::approval
