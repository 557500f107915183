#include "graphics.hpp"

#include <algorithm>

#ifdef UMBRAGE_CLI_WITH_GL
#include "umbrage/gl/context.hpp"
#include "umbrage/render/overlay.hpp"
#include "umbrage/techniques/gl/registry.hpp"
#endif

namespace umbrage::cli {

#ifdef UMBRAGE_CLI_WITH_GL

Graphics findGraphics() {
  const auto context = gl::Context::createHeadless();
  if (!context) return {"", false, context.error().text()};
  return {(*context)->renderer(), (*context)->isSoftware(), ""};
}

std::vector<shadow::TechniqueEntry> graphicsTechniques(const TechniqueOptions& options) {
  render::VolumeOptions volumes;
  if (options.counter == StencilCounter::wrap) volumes.overflow = render::Overflow::wraps;
  if (options.counter == StencilCounter::saturate) volumes.overflow = render::Overflow::saturates;
  render::ShadowMapOptions maps;
  maps.texels = options.mapTexels;
  maps.filter = options.mapFilter;
  if (options.mapBias) maps.constantBias = options.mapBias->x, maps.slopeBias = options.mapBias->y;
  return techniques::openGlTechniques(volumes, options.planes, maps);
}

Result<image::RgbImage> drawOver(const image::RgbImage& picture, const std::vector<std::string>& what,
                                 const shadow::Geometry& geometry, const shadow::Frame& frame) {
  const auto asked = [&](const char* word) { return std::find(what.begin(), what.end(), word) != what.end(); };
  return render::drawOverlay(picture, geometry, frame.camera, frame.lights,
                             {.volumes = asked("volumes"), .silhouette = asked("silhouette")});
}

#else

Graphics findGraphics() { return {"", false, "this build has no OpenGL"}; }

std::vector<shadow::TechniqueEntry> graphicsTechniques(const TechniqueOptions&) { return {}; }

Result<image::RgbImage> drawOver(const image::RgbImage&, const std::vector<std::string>&, const shadow::Geometry&,
                                 const shadow::Frame&) {
  return fail(ErrorCode::device, "--show draws with OpenGL, which this build has not got");
}

#endif

}  // namespace umbrage::cli
