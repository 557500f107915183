#pragma once

#include <vector>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques {

/// The techniques of this room; `ray_traced`, the truth all others are judged by, first.
[[nodiscard]] std::vector<shadow::TechniqueEntry> cpuTechniques();

}  // namespace umbrage::techniques
