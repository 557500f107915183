#pragma once

#include <vector>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::benchmarks {

/// Every technique of this build, CPU and GPU.
[[nodiscard]] std::vector<shadow::TechniqueEntry> allTechniques();

}  // namespace umbrage::benchmarks
