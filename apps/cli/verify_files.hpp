#pragma once

#include "console.hpp"
#include "options.hpp"
#include "place.hpp"
#include "verify_output.hpp"

namespace umbrage::cli {

/// Where a verdict is written, and what its files must know.
struct VerdictFiles {
  std::string output;         ///< .csv, .geojson, .dxf, .svg or .html
  const scene::Scene& scene;  ///< that was judged
  const PlaceOptions& place;
  const std::vector<std::string>& casters;
  double plane = 0.0;  ///< of maps
};

/// All files that an output makes: beside OUT.csv its ledger; beside OUT.html, which is a page by itself, OUT.csv, its ledger, OUT.geojson and OUT.gif, the
/// day that decides as an animation. Errors: usage (another extension).
[[nodiscard]] Result<std::vector<std::string>> verdictFiles(const std::string& output);

/// Errors: those of the writers, and of study::profile for the day's pictures.
[[nodiscard]] Result<void> writeVerdict(const VerdictFiles& files, const VerdictReport& report, const Console& console);

}  // namespace umbrage::cli
