#pragma once

#include "options.hpp"

// The commands, each in a file of its own. `add...` declares its options on `app` and returns what to run.
namespace umbrage::cli {

[[nodiscard]] Run addInfo(CLI::App& app);
[[nodiscard]] Run addTechniques(CLI::App& app);
[[nodiscard]] Run addSun(CLI::App& app);
[[nodiscard]] Run addRender(CLI::App& app);
[[nodiscard]] Run addRadiosity(CLI::App& app);
[[nodiscard]] Run addCompare(CLI::App& app);
[[nodiscard]] Run addProfile(CLI::App& app);
[[nodiscard]] Run addOutline(CLI::App& app);
[[nodiscard]] Run addEnvelope(CLI::App& app);
[[nodiscard]] Run addGallery(CLI::App& app);
[[nodiscard]] Run addHours(CLI::App& app);
[[nodiscard]] Run addIsochrones(CLI::App& app);
[[nodiscard]] Run addVerify(CLI::App& app);
[[nodiscard]] Run addTerrain(CLI::App& app);
[[nodiscard]] Run addCut(CLI::App& app);
[[nodiscard]] Run addSample(CLI::App& app);

}  // namespace umbrage::cli
