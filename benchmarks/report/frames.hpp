#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage::benchmarks {

/// What umbrage_frames has measured.
struct FrameTimes {
  struct Shot {
    std::string scene, name;
    std::size_t triangles = 0;
    std::map<std::string, std::vector<double>> times;             ///< per contestant, milliseconds, one a round
    std::map<std::string, std::map<std::string, double>> phases;  ///< per contestant and phase, median milliseconds
  };
  std::vector<std::pair<std::string, std::string>> facts;  ///< machine, versions, date; in the order of the file
  int rounds = 0;
  std::vector<std::string> contestants;  ///< of all shots, in the order of the file
  std::vector<Shot> shots;
};

[[nodiscard]] Result<FrameTimes> readFrameTimes(const std::filesystem::path& path);

/// Median time of a contestant in a shot; NaN when it did not take part.
[[nodiscard]] double medianTime(const FrameTimes::Shot& shot, const std::string& contestant);

/// How many times as long `one` takes as `other`: the median over the rounds of the ratio within one round, so that what slowed both
/// down cancels. NaN when either did not take part.
[[nodiscard]] double ratio(const FrameTimes::Shot& shot, const std::string& one, const std::string& other);

}  // namespace umbrage::benchmarks
