#include "umbrage/render/frame_data.hpp"

#include "umbrage/gl/read_back.hpp"
#include "umbrage/render/uniforms.hpp"
#include "umbrage/shadow/facing.hpp"

namespace umbrage::render {

std::vector<MaterialRow> materialRows(std::span<const scene::Material> materials) {
  std::vector<MaterialRow> rows;
  for (const scene::Material& m : materials)
    rows.push_back({Vec4f(Vec3f(m.colour), static_cast<float>(m.opacity)), Vec4f(Vec3f(m.emission), 0.0f),
                    Vec4f(Vec3f(scene::transmittance(m)), 0.0f)});
  return rows;
}

Result<void> fit(std::optional<GpuFrame>& frame, int width, int height) {
  if (frame && frame->width() == width && frame->height() == height) return {};
  frame.reset();
  auto made = GpuFrame::make(width, height);
  if (!made) return tl::unexpected(made.error());
  frame.emplace(std::move(*made));
  return {};
}

Result<void> upload(FrameData& data, const View& view, const Vec3& origin, const scene::Camera& camera,
                    const PictureOptions* options) {
  ShadingBlock shading = shadingBlock(camera);
  if (options != nullptr) {
    shading.sky = Vec4f(Vec3f(options->up), static_cast<float>(options->light.ambient));
    shading.background = Vec4f(Vec3f(options->light.background), 1.0f);
    if (auto done = data.materials.setAll(materialRows(options->materials)); !done) return done;
  }
  const ViewBlock block = viewBlock(view, origin, Vec4(0.0));
  if (auto done = data.view.setOne(block); !done) return done;
  return data.shading.setOne(shading);
}

Result<std::vector<std::uint8_t>> upload(GpuLight& gpu, const scene::Surfaces& surfaces, const View& view,
                                         const scene::Camera& camera, const scene::Light& light) {
  const Vec4 homogeneous = scene::homogeneous(light, surfaces.origin);
  auto facing = shadow::visibleSideFacesLight(surfaces, Vec4(view.eye - surfaces.origin, 1.0), homogeneous);
  const ViewBlock viewData = viewBlock(view, surfaces.origin, homogeneous);
  const ShadingBlock shading = withLight(shadingBlock(camera), camera, light);
  for (const auto& done : {gpu.view.setOne(viewData), gpu.shading.setOne(shading), gpu.facing.setAll(packBits(facing))})
    if (!done) return tl::unexpected(done.error());
  return facing;
}

shadow::SurfaceBuffer readSurface(const gl::HostScope& scope, const GpuFrame& frame) {
  return {gl::readIds(scope, frame.surfaceTarget(), frame.width(), frame.height()),
          gl::readDepth(scope, frame.surfaceTarget(), frame.width(), frame.height())};
}

void readMasks(const gl::HostScope& scope, const GpuFrame& frame, const View& view, std::size_t lights,
               shadow::SurfaceBuffer seen, shadow::Shading& out) {
  const int width = frame.width(), height = frame.height();
  out.surface = std::move(seen);
  image::GreyImage covered(width, height);
  for (std::size_t i = 0; i < covered.size(); ++i) {
    out.surface.depth.pixels()[i] = depthToDistance(view, out.surface.depth.pixels()[i]);
    covered.pixels()[i] = out.surface.triangle.pixels()[i] != shadow::kNoTriangle ? 1 : 0;
  }
  for (std::size_t i = 0; i < lights; ++i)
    out.masks.push_back({gl::readGrey(scope, frame.maskTarget(i), width, height), {}, covered});
}

}  // namespace umbrage::render
