#include "umbrage/techniques/gl/transparent.hpp"

namespace umbrage::techniques {

shadow::Traits transparentTraits() {
  return {.name = "transparent",
          .summary =
              "Coloured light through any number of transparent casters by shadow volumes without caps; self-shadows "
              "in every layer",
          .tinted = true,
          .needsGraphics = true,
          .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makeTransparent(std::shared_ptr<gl::Context> context,
                                                     const render::VolumeOptions& options) {
  return render::makeTintedTechnique(transparentTraits(), render::Counting::zPass, std::move(context), options);
}

shadow::Traits transparentZFailTraits() {
  return {.name = "transparent_zfail",
          .summary = "The same with caps, summed up behind the picture; right for every eye",
          .tinted = true,
          .needsGraphics = true,
          .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makeTransparentZFail(std::shared_ptr<gl::Context> context,
                                                          const render::VolumeOptions& options) {
  return render::makeTintedTechnique(transparentZFailTraits(), render::Counting::zFail, std::move(context), options);
}

}  // namespace umbrage::techniques
