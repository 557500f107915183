#include "umbrage/techniques/cpu/registry.hpp"

#include "umbrage/techniques/cpu/detail/ray_traced.hpp"

namespace umbrage::techniques {

std::vector<shadow::TechniqueEntry> cpuTechniques() { return {{detail::rayTracedTraits(), detail::makeRayTraced}}; }

}  // namespace umbrage::techniques
