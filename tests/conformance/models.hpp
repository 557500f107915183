#pragma once

#include <filesystem>
#include <vector>

#include "conformance/scenes/scenes.hpp"
#include "umbrage/base/error.hpp"

namespace umbrage::conformance {

/// The files below a folder whose extensions umbrage::io knows, sorted.
[[nodiscard]] std::vector<std::filesystem::path> modelFiles(const std::filesystem::path& folder);

/// A model on a ground, with a sun and a lamp, seen as a whole and from close by.
/// Errors: those of loading; a model without triangles.
[[nodiscard]] Result<Case> modelCase(const std::filesystem::path& path);

}  // namespace umbrage::conformance
