#include "umbrage/techniques/gl/shadow_map.hpp"

#include "umbrage/render/map_painter.hpp"

namespace umbrage::techniques {

shadow::Traits shadowMapTraits() {
  return {.name = "shadow_map",
          .summary = "Depths of the casters as the light sees them; approximate, as fine as its texels",
          .soft = true,
          .needsGraphics = true,
          .approximate = true};
}

std::unique_ptr<render::GlTechnique> makeShadowMap(std::shared_ptr<gl::Context> context,
                                                   const render::ShadowMapOptions& options) {
  return render::makeMaskTechnique(
      shadowMapTraits(),
      [options] { return render::makeMapPainter(shadowMapTraits().name, render::uniformMaps, options); },
      std::move(context));
}

}  // namespace umbrage::techniques
