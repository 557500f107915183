#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage::benchmarks {

/// Pairs of pictures of one size (.png or .ppm) side by side at half their size, one pair under the other, as a PNG. Pairs of which a
/// file is missing are left out. Nothing is written where no pair is left: false.
[[nodiscard]] Result<bool> writeSideBySide(
    const std::vector<std::pair<std::filesystem::path, std::filesystem::path>>& pairs,
    const std::filesystem::path& path);

}  // namespace umbrage::benchmarks
