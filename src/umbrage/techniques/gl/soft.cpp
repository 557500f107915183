#include "umbrage/techniques/gl/soft.hpp"

namespace umbrage::techniques {

shadow::Traits softTraits() {
  return {.name = "soft",
          .summary =
              "Soft shadows of lights with an extent, coloured ones too: the mean of exact hard ones by shadow "
              "volumes, summed up on the graphics card",
          .soft = true,
          .tinted = true,
          .needsGraphics = true,
          .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makeSoft(std::shared_ptr<gl::Context> context,
                                              const render::VolumeOptions& options) {
  return render::makeTintedTechnique(softTraits(), render::Counting::zPass, std::move(context), options);
}

}  // namespace umbrage::techniques
