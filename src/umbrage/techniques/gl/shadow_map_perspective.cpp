#include "umbrage/techniques/gl/shadow_map_perspective.hpp"

#include "umbrage/render/map_painter.hpp"

namespace umbrage::techniques {

shadow::Traits perspectiveShadowMapTraits() {
  return {.name = "shadow_map_perspective",
          .summary = "Shadow maps of the scene in the camera's perspective, finer near the eye; approximate",
          .soft = true,
          .needsGraphics = true,
          .approximate = true};
}

std::unique_ptr<render::GlTechnique> makePerspectiveShadowMap(std::shared_ptr<gl::Context> context,
                                                              const render::ShadowMapOptions& options) {
  return render::makeMaskTechnique(
      perspectiveShadowMapTraits(),
      [options] { return render::makeMapPainter(perspectiveShadowMapTraits().name, render::perspectiveMaps, options); },
      std::move(context));
}

}  // namespace umbrage::techniques
