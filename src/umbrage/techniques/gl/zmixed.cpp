#include "umbrage/techniques/gl/zmixed.hpp"

namespace umbrage::techniques {

shadow::Traits zMixedTraits() {
  return {
      .name = "zmixed",
      .summary =
          "Stencil shadow volumes without caps, but with caps for casters that may lie between the eye and the light",
      .needsGraphics = true,
      .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makeZMixed(std::shared_ptr<gl::Context> context,
                                                const render::VolumeOptions& options) {
  return render::makeStencilTechnique(zMixedTraits(), render::Counting::zMixed, std::move(context), options);
}

}  // namespace umbrage::techniques
