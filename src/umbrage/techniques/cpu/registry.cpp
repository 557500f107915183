#include "umbrage/techniques/cpu/registry.hpp"

#include "umbrage/techniques/cpu/detail/hybrid_cpu.hpp"
#include "umbrage/techniques/cpu/detail/radiosity.hpp"
#include "umbrage/techniques/cpu/detail/ray_traced.hpp"
#include "umbrage/techniques/cpu/detail/scanline.hpp"
#include "umbrage/techniques/cpu/detail/scanline_projected.hpp"
#include "umbrage/techniques/cpu/detail/soft.hpp"
#include "umbrage/techniques/cpu/detail/svbsp.hpp"
#include "umbrage/techniques/cpu/detail/transparent_cpu.hpp"
#include "umbrage/techniques/cpu/detail/transparent_rays.hpp"
#include "umbrage/techniques/cpu/detail/zpass_cpu.hpp"

namespace umbrage::techniques {

std::vector<shadow::TechniqueEntry> cpuTechniques() {
  return {{detail::rayTracedTraits(), detail::makeRayTraced},
          {detail::zpassCpuTraits(), detail::makeZPassCpu},
          {detail::hybridCpuTraits(), detail::makeHybridCpu},
          {detail::transparentCpuTraits(), detail::makeTransparentCpu},
          {detail::transparentRaysTraits(), detail::makeTransparentRays},
          detail::softTechnique({"soft_cpu",
                                 "Soft shadows of lights with an extent, coloured ones too: the mean of exact hard "
                                 "shadows, on the processor.",
                                 detail::makeHybridCpu, detail::makeTransparentCpu}),
          detail::softTechnique({"soft_rays", "The same by rays alone: the truth for soft_cpu, given samples enough.",
                                 detail::makeRayTraced, detail::makeTransparentRays}),
          {detail::svbspTraits(), detail::makeSvbsp},
          {detail::radiosityTraits(), [] { return detail::makeRadiosity(); }},
          {detail::scanlineTraits(), detail::makeScanline},
          {detail::scanlineProjectedTraits(), detail::makeScanlineProjected}};
}

}  // namespace umbrage::techniques
