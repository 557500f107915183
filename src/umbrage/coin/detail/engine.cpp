#include "umbrage/coin/detail/engine.hpp"

#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/caches/SoCache.h>
#include <Inventor/elements/SoCacheElement.h>
#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/elements/SoModelMatrixElement.h>
#include <Inventor/elements/SoProjectionMatrixElement.h>
#include <Inventor/elements/SoShapeStyleElement.h>
#include <Inventor/elements/SoViewingMatrixElement.h>
#include <Inventor/elements/SoViewportRegionElement.h>
#include <Inventor/misc/SoState.h>
#include <Inventor/nodes/SoSeparator.h>

#include "umbrage/coin/detail/context_share.hpp"
#include "umbrage/coin/detail/lights.hpp"
#include "umbrage/coin/detail/lights_off.hpp"
#include "umbrage/coin/detail/ray_masks.hpp"
#include "umbrage/gl/stencil_window.hpp"

namespace umbrage::coin::detail {
namespace {

/// The part of Coin's state under which a scene is drawn several times.
///
/// Render caches below would hold lights as they were when the cache was made, so none is used (another cache context) and none is made (a cache
/// counts as open); those above would hold our own drawing.
class ManyPasses {
 public:
  ManyPasses(SoState* state, std::uint32_t cacheContext) : state_(state) {
    const SbBool remote = SoGLCacheContextElement::getIsRemoteRendering(state);
    if (state->isCacheOpen()) SoCacheElement::invalidate(state);
    SoGLCacheContextElement::shouldAutoCache(state, SoGLCacheContextElement::DONT_AUTO_CACHE);
    state->push();
    SoGLCacheContextElement::set(state, static_cast<int>(cacheContext), FALSE, remote);
    auto* never = new SoCache(state);
    SoCacheElement::set(state, never);
    delayTransparency();
  }
  ManyPasses(const ManyPasses&) = delete;
  ManyPasses& operator=(const ManyPasses&) = delete;
  ~ManyPasses() { state_->pop(); }

 private:
  // What is blended at once would be overdrawn by the passes that follow.
  void delayTransparency() {
    switch (SoShapeStyleElement::getTransparencyType(state_)) {
      case SoGLRenderAction::BLEND:
        SoShapeStyleElement::setTransparencyType(state_, SoGLRenderAction::DELAYED_BLEND);
        break;
      case SoGLRenderAction::ADD:
        SoShapeStyleElement::setTransparencyType(state_, SoGLRenderAction::DELAYED_ADD);
        break;
      default: break;
    }
  }
  SoState* state_;
};

bool drawsTransparent(SoState* state) {
  return SoShapeStyleElement::getTransparencyType(state) != SoGLRenderAction::NONE;
}

// Draws only what Coin holds for opaque: transparent shapes come once, after all else, and shapes that Coin puts off must not be put off again.
void drawOpaque(SoGLRenderAction* action, const Engine::Draw& draw) {
  SoState* state = action->getState();
  state->push();
  if (drawsTransparent(state)) SoShapeStyleElement::setShadowMapRendering(state, TRUE);
  draw(action);
  state->pop();
}

// Draws all, and tells how it is seen, as Coin's own drawing has it where that can be told here: stereo and jitter are in it. A camera below another
// separator was told by the scan.
std::optional<Sight> drawAll(SoGLRenderAction* action, const Scan& scan, const Engine::Draw& draw) {
  SoState* state = action->getState();
  state->push();
  draw(action);
  std::optional<Sight> sight = scan.sight;
  if (const SbMatrix& projection = SoProjectionMatrixElement::get(state); projection != SbMatrix::identity())
    sight = Sight{SoViewingMatrixElement::get(state), projection, SoViewportRegionElement::get(state)};
  state->pop();
  return sight;
}

std::vector<Vec4> placesOf(const std::vector<PlacedLight>& lights) {
  std::vector<Vec4> places;
  for (const PlacedLight& light : lights) places.push_back(scene::homogeneous(light.light, Vec3(0.0)));
  return places;
}

}  // namespace

void Engine::note(Error error) { error_ = std::move(error); }

void Engine::render(SoGLRenderAction* action, const Settings& settings, const Draw& draw) {
  error_.reset();
  SoState* state = action->getState();
  Result<void> can;
  if (settings.sceneType == SceneType::withoutShadows)
    can = fail(ErrorCode::usage, "shadows are switched off");
  else if (state->isCacheOpen())
    can = fail(ErrorCode::device, "no shadows: a node above has renderCaching ON");
  else
    can = checkTarget();
  if (can) {
    if (auto done = drawShadowed(action, settings, draw); !done) note(done.error());
    return;
  }
  if (settings.sceneType != SceneType::withoutShadows) note(can.error());
  SoCacheElement::invalidate(state);
  state->push();
  draw(action);
  state->pop();
}

Result<void> Engine::drawShadowed(SoGLRenderAction* action, const Settings& settings, const Draw& draw) {
  SoState* state = action->getState();
  const ManyPasses passes(state, shareOf(static_cast<std::uint32_t>(action->getCacheContext())).cacheContext);
  const Scan scan = extractor_.scan(
      {action->getCurPath(), SoViewportRegionElement::get(state), &registry_, true, drawsTransparent(state)});
  work_.extractions = extractor_.extractions();
  const auto sight = drawAll(action, scan, draw);
  passes_ = 1;
  ++work_.frames;
  if (!scan.manifold.empty())
    note(Error{ErrorCode::unsupported, "a light that stands at several places casts no shadows",
               scan.manifold.front()->getName().getString()});
  const auto view = sight ? viewOf(*sight) : std::nullopt;
  if (!view) return scan.shapes.empty() ? Result<void>{} : fail(ErrorCode::usage, "no shadows: there is no camera");
  if (auto done = shade(scan, *view, settings); !done) return done;
  if (auto done = compose(action, *view, draw); !done) return done;
  if (settings.sceneType == SceneType::visibleVolumes) drawVolumes(action, scan, *sight, settings);
  return {};
}

void Engine::drawVolumes(SoGLRenderAction* action, const Scan& scan, const Sight& sight, const Settings& settings) {
  SoSeparator* volumes = volumes_.build(scan, settings, work_);
  if (volumes == nullptr) return;
  SoState* state = action->getState();
  state->push();
  SoViewingMatrixElement::set(state, volumes, sight.viewing);
  SoProjectionMatrixElement::set(state, volumes, sight.projection);
  SoModelMatrixElement::makeIdentity(state, volumes);
  volumes->GLRender(action);
  state->pop();
}

SoSeparator* Engine::volumesOf(const SoPath& path, const Settings& settings) {
  const Scan scan = extractor_.scan({&path, SbViewportRegion(640, 480), &registry_, false, true});
  work_.extractions = extractor_.extractions();
  return volumes_.build(scan, settings, work_);
}

Result<void> Engine::shade(const Scan& scan, const View& view, const Settings& settings) {
  const World& world = builder_.build(scan.shapes, settings.transparentCasters, work_);
  reportIsOld_ = true;
  auto places = placesOf(scan.lights);
  const bool same = geometry_ == world.geometry && view_ == view && method_ == settings.method && places_ == places;
  lights_ = scan.lights;
  if (same) return {};
  view_.reset();  // nothing is known until it is there
  reach_ = {};
  geometry_ = world.geometry;
  places_ = std::move(places);
  if (world.geometry != nullptr && !scan.lights.empty()) {
    std::vector<scene::Light> lights;
    for (const PlacedLight& light : scan.lights) lights.push_back(withoutCone(light.light));
    ++work_.shades;
    auto reach = masks_.masks(world, view, lights, settings.method);
    if (!reach) return tl::unexpected(reach.error());
    reach_ = std::move(*reach);
  }
  view_ = view;
  method_ = settings.method;
  return {};
}

Result<void> Engine::compose(SoGLRenderAction* action, const View& view, const Draw& draw) {
  const Subsets subsets = subsetsOf(reach_.masks);
  if (subsets.all.empty()) return {};
  ContextShare& share = shareOf(static_cast<std::uint32_t>(action->getCacheContext()));
  if (auto done = share.stamp.write(subsets, view.x, view.y); !done) return done;
  for (std::size_t i = 0; i < subsets.all.size(); ++i) {
    const Subset& subset = subsets.all[i];
    std::vector<SoNode*> off;
    for (const std::size_t light : subset.off) off.push_back(lights_[light].node);
    const LightsOff dark(off);
    const gl::Rect box{view.x + subset.box.x, view.y + subset.box.y, subset.box.width, subset.box.height};
    const gl::StencilWindow window(static_cast<std::uint8_t>(i + 1), box);
    drawOpaque(action, draw);
    ++passes_;
  }
  Stamp::clear({view.x, view.y, view.width, view.height});
  if (subsets.left > 0) return fail(ErrorCode::unsupported, "more than 255 sets of lights in one picture");
  return {};
}

const ShadowReport& Engine::report() const {
  if (!reportIsOld_) return report_;
  reportIsOld_ = false;
  report_ = {geometry_, view_ ? view_->pinhole : std::nullopt, {}, passes_, masks_.used()};
  for (std::size_t i = 0; i < reach_.masks.size(); ++i) {
    report_.lights.push_back({lights_[i].node, lights_[i].light, reach_.masks[i], reach_.masks[i]});
    cutCone(report_.lights.back().mask, lights_[i].light, *view_, geometry_->surfaces, reach_.triangle);
  }
  return report_;
}

}  // namespace umbrage::coin::detail
