#pragma once

#include <string>
#include <vector>

namespace umbrage::cli {

/// What `--ground` without a height means, spelled out.
inline constexpr const char* kLowestGround = "lowest";

/// The words of the command line with every `--ground` given its value: `--ground -2` becomes `--ground=-2`, and
/// `--ground` before anything that is not a number becomes `--ground=lowest`. An optional value that may start with a
/// minus, before a positional word that is never its value, is more than an option parser can guess. Words after `--`
/// stay as they are.
[[nodiscard]] std::vector<std::string> completeGround(const std::vector<std::string>& words);

}  // namespace umbrage::cli
