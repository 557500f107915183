#pragma once

#include <vector>

namespace umbrage::benchmarks {

/// The middle one (of two, the greater); 0 of none.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace umbrage::benchmarks
