#pragma once

#include <filesystem>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/base/progress.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::report {

/// Writes the figures of a profile: for "out.png" the shadows to out.png, the hours in shadow to out-hours.png and the animation
/// of the steps to out.gif, each whole or not at all, out.png last. Returns the paths, out.png first.
/// REQUIRES: `scene` is the one the profile was made of. Errors: usage (another extension), output, cancelled.
[[nodiscard]] Result<std::vector<std::filesystem::path>> writeProfile(const study::Profile& profile,
                                                                      const scene::Scene& scene,
                                                                      const std::filesystem::path& path,
                                                                      const ProgressSink& progress = {});

}  // namespace umbrage::report
