#include "umbrage/techniques/gl/volumes_brute.hpp"

namespace umbrage::techniques {

shadow::Traits volumesBruteTraits() {
  return {
      .name = "volumes_brute",
      .summary =
          "A stencil shadow volume for every triangle, with no silhouette, as the first engines had; for comparison",
      .needsGraphics = true,
      .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makeVolumesBrute(std::shared_ptr<gl::Context> context,
                                                      const render::VolumeOptions& options) {
  return render::makeStencilTechnique(volumesBruteTraits(), render::Counting::eachTriangle, std::move(context),
                                      options);
}

}  // namespace umbrage::techniques
