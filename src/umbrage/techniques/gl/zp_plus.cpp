#include "umbrage/techniques/gl/zp_plus.hpp"

namespace umbrage::techniques {

shadow::Traits zPassPlusTraits() {
  return {.name = "zp_plus",
          .summary = "Stencil shadow volumes without caps, counted from what the light sees through the near rectangle",
          .needsGraphics = true,
          .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makeZPassPlus(std::shared_ptr<gl::Context> context,
                                                   const render::VolumeOptions& options) {
  return render::makeStencilTechnique(zPassPlusTraits(), render::Counting::zPassPlus, std::move(context), options);
}

}  // namespace umbrage::techniques
