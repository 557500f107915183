#include "umbrage/techniques/gl/zpass.hpp"

namespace umbrage::techniques {

shadow::Traits zPassTraits() {
  return {.name = "zpass",
          .summary = "Stencil shadow volumes without caps, counted before the picture from the count at the eye",
          .needsGraphics = true,
          .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makeZPass(std::shared_ptr<gl::Context> context,
                                               const render::VolumeOptions& options) {
  return render::makeStencilTechnique(zPassTraits(), render::Counting::zPass, std::move(context), options);
}

}  // namespace umbrage::techniques
