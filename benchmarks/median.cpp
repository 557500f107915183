#include "median.hpp"

#include <algorithm>

namespace umbrage::benchmarks {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace umbrage::benchmarks
