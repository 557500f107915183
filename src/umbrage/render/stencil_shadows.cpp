#include "umbrage/render/stencil_shadows.hpp"

#include "umbrage/gl/context.hpp"
#include "umbrage/render/uniforms.hpp"

namespace umbrage::render {

Result<StencilShadows> StencilShadows::make(shadow::CasterSet casters) {
  if (auto good = gl::checkCurrentContext(); !good) return tl::unexpected(good.error());
  StencilShadows shadows;
  shadows.light_.emplace_back();
  if (auto done = shadows.setCasters(std::move(casters)); !done) return tl::unexpected(done.error());
  return shadows;
}

Result<void> StencilShadows::setCasters(shadow::CasterSet casters) {
  if (auto done = setStorage(positions_, std::as_bytes(std::span(casters.positions)), "positions"); !done) return done;
  finder_ = shadow::makeFinder(shadow::FinderKind::automatic,
                               std::make_shared<const shadow::CasterSet>(std::move(casters)));
  return {};
}

Result<shadow::LightStats> StencilShadows::mark(const scene::Light& light, const HostView& hostView,
                                                const StencilShadowOptions& options) {
  gl::HostScope scope;
  if (scope.hostStencilBits() < 8) return fail(ErrorCode::device, "the framebuffer has fewer than 8 bits of stencil");
  if (scope.hostDepthBits() == 0) return fail(ErrorCode::device, "the framebuffer has no depth");
  const View view = viewOf(hostView.view, hostView.projection, hostView.reversed);
  gl::PassState placement = scope.hostPlacement();
  placement.frontIsClockwise = mirrors(view);

  shadow::LightStats stats;
  const shadow::CasterSet& casters = finder_->casters();
  const Vec4 homogeneous = scene::homogeneous(light, casters.origin);
  // A ray may enter a volume through a caster that the depth buffer does not hold; without caps nobody would count that.
  const Counting counting = options.castersInDepth ? options.counting : Counting::zFail;
  const LightVolume volume = prepareVolume(*finder_, homogeneous, view.eye - casters.origin, counting, stats);
  stats.reason = options.castersInDepth ? "chosen by the host" : "the casters are not in the depth buffer";
  GpuLight& gpu = light_.front();
  for (const auto& done :
       {gpu.view.setOne(viewBlock(view, casters.origin, homogeneous)), gpu.volume.setAll(volume.indices)})
    if (!done) return tl::unexpected(done.error());
  gpu.groups = volume.groups;

  const LightPlan plan{.groups = planGroups(volume),
                       .compareCaps = !options.castersInDepth,
                       .volumeArea = volumeArea(view, casters.bounds, {}, homogeneous, casters.origin, placement),
                       .litArea = litArea(view, light, placement)};
  run(scope, planPasses(placement, view.reversed, {plan}, Product::hostStencil),
      {.programs = programs_, .positions = positions_, .lights = light_});
  return stats;
}

}  // namespace umbrage::render
