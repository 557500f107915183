#include "all_techniques.hpp"

#include <algorithm>

#include "umbrage/techniques/cpu/registry.hpp"
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
#include "umbrage/techniques/gl/registry.hpp"
#endif

namespace umbrage::benchmarks {

std::vector<shadow::TechniqueEntry> allTechniques() {
  auto all = techniques::cpuTechniques();
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
  for (auto& entry : techniques::openGlTechniques()) all.push_back(std::move(entry));
#endif
  return all;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace umbrage::benchmarks
