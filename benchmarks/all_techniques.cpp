#include "all_techniques.hpp"

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

}  // namespace umbrage::benchmarks
