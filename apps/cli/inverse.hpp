#pragma once

#include "rule_options.hpp"

namespace umbrage::cli {

/// envelope --inverse: the tallest volume on a site that a rule lets stand.
struct InverseVolume {
  SceneOptions scene;
  PlaceOptions place;
  RuleOptions rule;
  std::optional<double> cell, most;  ///< metres
  std::string output;
};
[[nodiscard]] Result<Outcome> inverseVolume(const InverseVolume& options, const Console& console);

/// The kinds of file it writes: maps, and models.
[[nodiscard]] const std::vector<std::string>& inverseKinds();

}  // namespace umbrage::cli
