#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "keys.hpp"
#include "umbrage/coin/settings.hpp"

namespace umbrage::demo {

struct Options {
  std::filesystem::path file;  ///< the model; empty: the built-in one
  int width = 900, height = 700;
  coin::Method method = coin::Method::automatic;
  int windows = 1;
  std::filesystem::path folder = ".";  ///< where the keys V and X write
  std::filesystem::path picture;       ///< a picture of the window is written there and the program ends
  std::vector<const Key*> keys;        ///< pressed at the beginning
  bool verbose = false;
};

/// What the command line asks for: options, or the exit code with which to end at once (help is printed, a mistake is told).
struct Request {
  std::optional<Options> options;
  int exitCode = 0;
};
[[nodiscard]] Request parse(std::vector<std::string> words);

}  // namespace umbrage::demo
