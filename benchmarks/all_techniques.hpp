#pragma once

#include <vector>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::benchmarks {

/// Every technique of this build, CPU and GPU.
[[nodiscard]] std::vector<shadow::TechniqueEntry> allTechniques();

/// The middle one (of two, the greater); 0 of none.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace umbrage::benchmarks
