#pragma once

#include <filesystem>
#include <string>

#include "umbrage/base/error.hpp"

namespace umbrage::finders {

/// What a model's silhouettes were.
struct Verdict {
  std::size_t triangles = 0, edges = 0, lights = 0, found = 0;
  std::string disagreement;  ///< the first finder, light and edge that differ; empty when all agree
};

/// Every finder against findSilhouette on one model, for suns and lamps around it, at its corners, in the planes of its faces.
/// Errors: those of loading; a model without triangles.
[[nodiscard]] Result<Verdict> judge(const std::filesystem::path& path);

}  // namespace umbrage::finders
