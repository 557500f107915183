#include "umbrage/techniques/gl/zfail.hpp"

namespace umbrage::techniques {

shadow::Traits zFailTraits() {
  return {.name = "zfail",
          .summary = "Stencil shadow volumes with caps, counted behind the picture; right for every eye",
          .needsGraphics = true,
          .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makeZFail(std::shared_ptr<gl::Context> context,
                                               const render::VolumeOptions& options) {
  return render::makeStencilTechnique(zFailTraits(), render::Counting::zFail, std::move(context), options);
}

}  // namespace umbrage::techniques
