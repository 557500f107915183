#pragma once

#include "umbrage/radiosity/seen_light.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

[[nodiscard]] shadow::Traits radiosityTraits();
/// `options`: but for the samples, which are the frame's.
[[nodiscard]] Result<std::unique_ptr<shadow::Technique>> makeRadiosity(const radiosity::SeenOptions& options = {});

}  // namespace umbrage::techniques::detail
