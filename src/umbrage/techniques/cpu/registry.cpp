#include "umbrage/techniques/cpu/registry.hpp"

#include "umbrage/techniques/cpu/detail/hybrid_cpu.hpp"
#include "umbrage/techniques/cpu/detail/ray_traced.hpp"
#include "umbrage/techniques/cpu/detail/transparent_cpu.hpp"
#include "umbrage/techniques/cpu/detail/transparent_rays.hpp"
#include "umbrage/techniques/cpu/detail/zpass_cpu.hpp"

namespace umbrage::techniques {

std::vector<shadow::TechniqueEntry> cpuTechniques() {
  return {{detail::rayTracedTraits(), detail::makeRayTraced},
          {detail::zpassCpuTraits(), detail::makeZPassCpu},
          {detail::hybridCpuTraits(), detail::makeHybridCpu},
          {detail::transparentCpuTraits(), detail::makeTransparentCpu},
          {detail::transparentRaysTraits(), detail::makeTransparentRays}};
}

}  // namespace umbrage::techniques
