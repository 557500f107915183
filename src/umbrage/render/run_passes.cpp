#include "umbrage/render/run_passes.hpp"

#include <umbrage_shaders/ambient_frag.hpp>
#include <umbrage_shaders/encode_frag.hpp>
#include <umbrage_shaders/light_frag.hpp>
#include <umbrage_shaders/light_mask_frag.hpp>
#include <umbrage_shaders/masked_light_frag.hpp>
#include <umbrage_shaders/receiver_tiles_frag.hpp>
#include <umbrage_shaders/screen_vert.hpp>
#include <umbrage_shaders/surface_frag.hpp>
#include <umbrage_shaders/surface_large_frag.hpp>
#include <umbrage_shaders/surface_vert.hpp>
#include <umbrage_shaders/volume_far_vert.hpp>
#include <umbrage_shaders/volume_frag.hpp>
#include <umbrage_shaders/volume_points_vert.hpp>
#include <umbrage_shaders/volume_sides_far_vert.hpp>
#include <umbrage_shaders/volume_sides_geom.hpp>
#include <umbrage_shaders/volume_sides_vert.hpp>
#include <umbrage_shaders/volume_vert.hpp>

#include "umbrage/base/check.hpp"
#include "umbrage/gl/sample_count.hpp"
#include "umbrage/shadow/surface_buffer.hpp"

namespace umbrage::render {
namespace {

gl::Program compile(Shader shader) {
  using namespace shaders;
  switch (shader) {
    case Shader::none: break;
    case Shader::surface: return {kSurfaceVert, kSurfaceFrag};
    case Shader::largeSurface: return {kSurfaceVert, kSurfaceLargeFrag};
    case Shader::receiverTiles: return {kScreenVert, kReceiverTilesFrag};
    case Shader::carriedVolume: return {kVolumePointsVert, kVolumeFrag};
    case Shader::volumeSides: return {kVolumeSidesVert, kVolumeSidesGeom, kVolumeFrag};
    case Shader::finiteVolumeSides: return {kVolumeSidesFarVert, kVolumeSidesGeom, kVolumeFrag};
    case Shader::finiteVolume: return {kVolumeFarVert, kVolumeFrag};
    case Shader::volume: return {kVolumeVert, kVolumeFrag};
    case Shader::keepShadow: return {kScreenVert, kVolumeFrag};
    case Shader::lightMask: return {kScreenVert, kLightMaskFrag};
    case Shader::ambient: return {kScreenVert, kAmbientFrag};
    case Shader::light: return {kScreenVert, kLightFrag};
    case Shader::maskedLight: return {kScreenVert, kMaskedLightFrag};
    case Shader::encode: return {kScreenVert, kEncodeFrag};
  }
  UMBRAGE_CHECK(false, "no shader");
  return {kScreenVert, kVolumeFrag};
}

unsigned targetOf(const PassStep& step, const gl::HostScope& scope, const RunInput& input) {
  switch (step.target) {
    case Target::surface: return input.frame->surfaceTarget().name();
    case Target::tiles: return input.frame->tilesTarget().name();
    case Target::stencil: return input.frame->stencilTarget().name();
    case Target::mask: return input.frame->maskTarget(static_cast<std::size_t>(step.light)).name();
    case Target::sum: return input.frame->sumTarget().name();
    case Target::picture: return input.frame->pictureTarget().name();
    case Target::host: return scope.hostFramebuffer();
  }
  return 0;
}

void clear(gl::Pass& pass, const PassStep& step) {
  if (step.clearColour) {
    if (step.target == Target::surface)
      pass.clearIds(shadow::kNoTriangle);
    else
      pass.clearColour({0.0f, 0.0f, 0.0f, 0.0f});
  }
  if (step.clearDepth) pass.clearDepth(*step.clearDepth);
  if (step.clearStencil) pass.clearStencil(*step.clearStencil);
}

void bindScreenInputs(gl::Pass& pass, const PassStep& step, const RunInput& input, const GpuLight* light) {
  pass.uniforms(1, light != nullptr ? light->shading : *input.shading);
  pass.storage(1, input.scene->triangles());
  pass.storage(2, input.scene->corners());
  if (light != nullptr) pass.storage(3, light->facing);
  if (input.materials != nullptr) pass.storage(4, *input.materials);
  pass.texture(0, input.frame->ids());
  if (step.shader == Shader::encode) pass.texture(1, input.frame->sum());
  if (step.shader == Shader::maskedLight) pass.texture(1, input.frame->mask(static_cast<std::size_t>(step.light)));
  if (step.shader == Shader::receiverTiles) pass.texture(1, input.frame->depthStencil());
}

void draw(gl::Pass& pass, const PassStep& step, const RunInput& input, const GpuLight* light) {
  if (step.draw == Draw::nothing) return;
  pass.use(input.programs.get(step.shader));
  const bool inPicture = step.draw == Draw::nearCasters;
  pass.uniforms(0, inPicture ? light->inPicture : light != nullptr ? light->view : *input.view);
  pass.storage(0, step.shader == Shader::carriedVolume ? light->points : input.positions);
  const bool fromEdges = step.shader == Shader::volumeSides || step.shader == Shader::finiteVolumeSides;
  const auto primitive = fromEdges ? gl::Primitive::lines : gl::Primitive::triangles;
  if (step.shader == Shader::finiteVolume || step.shader == Shader::finiteVolumeSides)
    pass.storage(1, inPicture ? light->nearPoints : light->farPoints);
  const auto volume = [&](const IndexRange& range) {
    pass.drawIndexed(light->vertices, range.first, range.count, primitive);
  };
  const auto part = [&](CardVolume::Part which, const IndexRange& range) {
    light->onCard ? pass.drawIndirect(light->card.vertices, light->card.draws, which, primitive) : volume(range);
  };
  const auto group = static_cast<std::size_t>(step.group);
  switch (step.draw) {
    case Draw::nothing: break;
    case Draw::surfaces:
      pass.storage(1, input.scene->drawn().ids());
      pass.drawIndexed(input.scene->drawn().vertices(), 0, input.scene->drawn().indexCount());
      break;
    case Draw::largeSurfaces:
      pass.uniforms(1, *input.shading);
      pass.storage(1, input.scene->drawn().largeTriangles());
      pass.drawIndexed(input.scene->drawn().largeVertices(), 0, input.scene->drawn().largeIndexCount());
      break;
    case Draw::nearCasters: volume(light->groups[group].nearCasters); break;
    case Draw::passSides: part(CardVolume::passSides, light->groups[group].passSides); break;
    case Draw::failSides: part(CardVolume::failSides, light->groups[group].failSides); break;
    case Draw::turnedSides: volume(light->groups[group].turnedSides); break;
    case Draw::failCaps: part(CardVolume::failCaps, light->groups[group].failCaps); break;
    case Draw::screen:
      if (step.shader != Shader::keepShadow) bindScreenInputs(pass, step, input, light);
      pass.draw(light != nullptr ? light->vertices : input.scene->drawn().vertices(), 3);
      break;
  }
}

}  // namespace

const gl::Program& Programs::get(Shader shader) {
  auto& slot = programs_[static_cast<std::size_t>(shader)];
  if (!slot) slot.emplace(compile(shader));
  return *slot;
}

void run(gl::HostScope& scope, const PassList& list, const RunInput& input, const PhaseEnd& ended) {
  for (std::size_t i = 0; i < list.steps.size(); ++i) {
    const PassStep& step = list.steps[i];
    {
      gl::Pass pass(scope, targetOf(step, scope, input), step.state);
      clear(pass, step);
      draw(pass, step, input, step.light >= 0 ? &input.lights[static_cast<std::size_t>(step.light)] : nullptr);
    }
    const bool last = i + 1 == list.steps.size() || list.steps[i + 1].phase != step.phase;
    if (!ended || !last) continue;
    gl::finish();
    ended(step.phase.c_str());
  }
}

std::vector<std::uint64_t> countFragments(gl::HostScope& scope, const PassList& list, const RunInput& input) {
  std::vector<std::uint64_t> fragments(input.lights.size(), 0);
  for (const PassStep& step : list.steps) {
    if (step.draw != Draw::passSides && step.draw != Draw::failSides && step.draw != Draw::turnedSides &&
        step.draw != Draw::failCaps)
      continue;
    const auto light = static_cast<std::size_t>(step.light);
    gl::PassState state = step.state;
    state.depth.test = state.stencil.test = false;
    state.depthBounds.reset();
    gl::SampleCount count(scope);
    {
      gl::Pass pass(scope, targetOf(step, scope, input), state);
      draw(pass, step, input, &input.lights[light]);
    }
    fragments[light] += count.stop();
  }
  return fragments;
}

}  // namespace umbrage::render
