#include "umbrage/coin/detail/engine.hpp"

#include <Inventor/C/glue/gl.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/caches/SoGLRenderCache.h>
#include <Inventor/elements/SoCacheElement.h>
#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/elements/SoModelMatrixElement.h>
#include <Inventor/elements/SoProjectionMatrixElement.h>
#include <Inventor/elements/SoShapeStyleElement.h>
#include <Inventor/elements/SoViewingMatrixElement.h>
#include <Inventor/elements/SoViewportRegionElement.h>
#include <Inventor/misc/SoState.h>
#include <Inventor/nodes/SoLight.h>
#include <Inventor/nodes/SoSeparator.h>

#include <algorithm>

#include "umbrage/coin/detail/context_share.hpp"
#include "umbrage/coin/detail/lights.hpp"
#include "umbrage/coin/detail/lights_off.hpp"
#include "umbrage/coin/detail/ray_masks.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/gl/stencil_pixels.hpp"
#include "umbrage/gl/stencil_window.hpp"
#include "umbrage/math/box.hpp"

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
    SoCacheElement::invalidate(
        state);  // also where none is open: separators above count the frames until they open one
    running().push_back(state);
    SoGLCacheContextElement::shouldAutoCache(state, SoGLCacheContextElement::DONT_AUTO_CACHE);
    state->push();
    SoGLCacheContextElement::set(state, static_cast<int>(cacheContext), FALSE, remote);
    SoCacheElement::set(state, new SoGLRenderCache(state));  // Coin takes every open cache for one of these
  }
  ManyPasses(const ManyPasses&) = delete;
  ManyPasses& operator=(const ManyPasses&) = delete;
  ~ManyPasses() {
    state_->pop();
    running().pop_back();
  }
  /// Whether what draws now stands inside another group that draws its passes.
  static bool isInside(const SoState* state) { return std::ranges::find(running(), state) != running().end(); }

 private:
  static std::vector<const SoState*>& running() {
    static std::vector<const SoState*> states;
    return states;
  }
  SoState* state_;
};

// How many lights OpenGL has at once. Coin's element of that name complains about being asked.
std::size_t lightLimit(const SoGLRenderAction& action) {
  const int most = cc_glglue_get_max_lights(cc_glglue_instance(static_cast<int>(action.getCacheContext())));
  return static_cast<std::size_t>(std::max(1, most));
}

void drawPass(SoGLRenderAction* action, const Engine::Draw& draw, Delayed delayed) {
  SoState* state = action->getState();
  const SoAction::PathCode code = action->getCurPathCode();
  state->push();
  if (delayed == Delayed::astray) action->pushCurPath(kNoChild, nobody());
  draw(action);
  if (delayed == Delayed::astray) action->popCurPath(code);
  state->pop();
}

// As Coin's own drawing has it, where the camera stands before: stereo and jitter are in it. A camera inside was told by the scan.
std::optional<Sight> sightOf(SoState* state, const Scan& scan) {
  const auto before = sightAt(state, scan.cameraToWorld);
  return scan.ownCamera || !before ? scan.sight : before;
}

std::vector<Vec4> placesOf(const std::vector<PlacedLight>& lights) {
  std::vector<Vec4> places;
  for (const PlacedLight& light : lights) places.push_back(scene::homogeneous(light.light, Vec3(0.0)));
  return places;
}

// The lights whose shadows a shape shows, as bits.
std::uint64_t shadowsOn(const Receiver& receiver, const std::vector<PlacedLight>& lights) {
  std::uint64_t on = 0;
  for (std::size_t k = 0; k < lights.size() && receiver.shadowed; ++k) {
    const bool told = lights[k].node->isOfType(SoLight::getClassTypeId()) != FALSE;
    const bool shines = !told || std::ranges::find(receiver.lights, lights[k].node) != receiver.lights.end();
    on |= std::uint64_t{shines} << k;
  }
  return on;
}

// Per triangle the lights that may light it, and whose shadows it shows; empty where all are before all shapes.
std::vector<std::uint64_t> shiningOn(const Scan& scan, const World& world) {
  std::vector<std::uint64_t> on;
  const std::size_t lights = scan.lights.size();
  if (lights == 0 || world.geometry == nullptr) return on;
  std::vector<std::uint64_t> onShape;
  std::uint64_t common = ~std::uint64_t{0};
  for (const Receiver& receiver : scan.receivers) {
    onShape.push_back(shadowsOn(receiver, scan.lights));
    common &= onShape.back();
  }
  if (common == ~std::uint64_t{0} >> (kMostLights - lights)) return on;
  for (const std::uint32_t instance : world.geometry->surfaces.instances)
    on.push_back(onShape[world.shapeOf[instance]]);
  return on;
}

// Writes the stencil of a round. Outside the box of all subsets the whole is 0, or, after the first round, not drawn.
Result<void> stamp(const Subsets& subsets, std::size_t round, const gl::Rect& whole) {
  gl::HostScope scope;
  gl::fillStencil(scope, round == 0 ? std::uint8_t{0} : kNotNow, whole);
  const gl::Rect box = boxOf(subsets);
  const auto stencil = stencilOf(subsets, round, box);
  if (!stencil) return tl::unexpected(stencil.error());
  return gl::writeStencil(scope, *stencil, {whole.x + box.x, whole.y + box.y, box.width, box.height});
}

}  // namespace

SoNode* nobody() {
  static SoNode* const node = [] {
    auto* made = new SoSeparator;
    made->ref();
    return made;
  }();
  return node;
}

void Engine::render(SoGLRenderAction* action, const Settings& settings, const Draw& draw) {
  error_.reset();
  SoState* state = action->getState();
  Result<void> can;
  if (settings.sceneType == SceneType::withoutShadows)
    can = fail(ErrorCode::usage, "shadows are switched off");
  else if (ManyPasses::isInside(state))
    can = fail(ErrorCode::usage, "no shadows of its own: it stands inside another group or manager that makes them");
  else
    can = checkTarget();
  if (can) {
    if (auto done = drawShadowed(action, settings, draw); !done) error_ = done.error();
    return;
  }
  if (settings.sceneType != SceneType::withoutShadows) error_ = can.error();
  SoCacheElement::invalidate(state);
  state->push();
  draw(action);
  state->pop();
}

Result<void> Engine::drawShadowed(SoGLRenderAction* action, const Settings& settings, const Draw& draw) {
  SoState* state = action->getState();
  phases_.clear();
  shadow::PhaseClock clock(phases_);
  const ManyPasses passes(state, ownCacheContext(static_cast<std::uint32_t>(action->getCacheContext())));
  const Scan scan =
      extractor_.scan({action->getCurPath(), SoViewportRegionElement::get(state), &registry_, !gl::currentIsEgl(),
                       SoShapeStyleElement::getTransparencyType(state), lightLimit(*action)});
  work_.extractions = extractor_.extractions();
  clock.end("scene");
  ++work_.frames;
  passes_ = 0;
  const auto sight = sightOf(state, scan);
  const auto view = sight ? viewOf(*sight) : std::nullopt;
  const auto shadows = shadowsOf(scan, view, settings, clock);
  if (auto done = compose(action, view, draw, clock); !done) return done;
  if (!shadows) return shadows;
  if (settings.sceneType == SceneType::visibleVolumes && view) drawVolumes(action, scan, *sight, settings);
  return complaints(scan);
}

Result<void> Engine::shadowsOf(const Scan& scan, const std::optional<View>& view, const Settings& settings,
                               shadow::PhaseClock& clock) {
  if (scan.shapes.empty() || !view || scan.ownStereo || scan.lights.size() > kMostLights) forgetShadows();
  if (scan.shapes.empty()) return {};
  if (scan.ownStereo) return fail(ErrorCode::unsupported, "no shadows: stereo needs its camera before the group");
  if (!view) return fail(ErrorCode::usage, "no shadows: there is no camera");
  if (scan.lights.size() > kMostLights) return fail(ErrorCode::unsupported, "no shadows: more than 64 lights");
  if (auto done = shade(scan, *view, settings, clock); !done) return done;
  auto shining = shiningOn(scan, builder_.world());
  if (subsets_ && shining == shining_) return {};
  subsets_.reset();
  Result<const image::Image<std::uint32_t>*> seen = nullptr;
  if (!shining.empty()) seen = masks_.seen(builder_.world(), *view);
  if (!seen) return tl::unexpected(seen.error());
  auto subsets = subsetsOf(reach_, {*seen, shining});
  if (!subsets) return tl::unexpected(subsets.error());
  subsets_ = std::move(*subsets);
  shining_ = std::move(shining);
  clock.end("sets");
  return {};
}

Result<void> Engine::complaints(const Scan& scan) {
  if (!scan.manifold.empty())
    return fail(ErrorCode::unsupported, "a light that stands at several places casts no shadows",
                scan.manifold.front()->getName().getString());
  if (scan.broken > 0)
    return fail(ErrorCode::input,
                std::to_string(scan.broken) + " shapes cast nothing: they name points they do not have");
  if (scan.beyond > 0)
    return fail(ErrorCode::input, std::to_string(scan.beyond) + " shapes cast nothing: they reach beyond all measure");
  if (scan.lightsDropped > 0)
    return fail(ErrorCode::unsupported,
                "OpenGL has too few lights: Coin drops the last " + std::to_string(scan.lightsDropped) + " of a shape");
  if (scan.otherwiseSeen > 0)
    return fail(ErrorCode::unsupported,
                std::to_string(scan.otherwiseSeen) +
                    " lit shapes under another camera cast nothing and show the shadows of what is behind them");
  return {};
}

void Engine::drawVolumes(SoGLRenderAction* action, const Scan& scan, const Sight& sight, const Settings& settings) {
  SoSeparator* volumes = volumes_.build(scan, settings, Caps::none, work_);
  if (volumes == nullptr) return;
  SoState* state = action->getState();
  state->push();
  SoViewingMatrixElement::set(state, volumes, sight.viewing);
  SoProjectionMatrixElement::set(state, volumes, sight.projection);
  SoModelMatrixElement::makeIdentity(state, volumes);
  volumes->GLRender(action);
  state->pop();
}

namespace {

// Written volumes without a depth end here, of the scene's diameter: points at infinity leave viewers nothing to aim at.
constexpr double kWrittenDepth = 3.0;

double diameterOf(const std::vector<PlacedShape>& shapes) {
  Box3 box;
  for (const PlacedShape& shape : shapes)
    for (const auto& mesh : {shape.triangles->opaque, shape.triangles->veiled})
      if (mesh != nullptr)
        for (const Vec3& p : mesh->positions) box.add(transformPoint(shape.toWorld, p));
  return 2.0 * box.radius();
}

}  // namespace

SoSeparator* Engine::volumesOf(const SoPath& path, const Settings& settings) {
  const Scan scan =
      extractor_.scan({&path, SbViewportRegion(640, 480), &registry_, false, SoGLRenderAction::SORTED_OBJECT_BLEND});
  work_.extractions = extractor_.extractions();
  Settings written = settings;
  if (!written.volumeDepth) written.volumeDepth = kWrittenDepth * diameterOf(scan.shapes);
  return volumes_.build(scan, written, Caps::both, work_);
}

Result<void> Engine::shade(const Scan& scan, const View& view, const Settings& settings, shadow::PhaseClock& clock) {
  const World& world = builder_.build(scan.shapes, settings.transparentCasters, work_);
  clock.end("geometry");
  reportIsOld_ = true;
  auto places = placesOf(scan.lights);
  const bool same = geometry_ == world.geometry && view_ == view && method_ == settings.method && places_ == places;
  if (same) {
    lights_ = scan.lights;  // their colours may be others
    return {};
  }
  forgetShadows();  // nothing is known until it is there
  lights_ = scan.lights;
  geometry_ = world.geometry;
  places_ = std::move(places);
  if (world.geometry != nullptr && !scan.lights.empty()) {
    std::vector<scene::Light> lights;
    for (const PlacedLight& light : scan.lights) lights.push_back(withoutCone(light.light));
    ++work_.shades;
    if (auto done = masks_.prepare(world, view, settings.method); !done) return done;
    clock.end("prepare");
    auto reach = masks_.masks(world, view, lights);
    work_.views = masks_.views();
    if (!reach) return tl::unexpected(reach.error());
    reach_ = std::move(*reach);
    clock.end("shadows");
  }
  view_ = view;
  method_ = settings.method;
  return {};
}

// Every pixel is drawn by exactly one pass, the one whose lights reach it.
Result<void> Engine::compose(SoGLRenderAction* action, const std::optional<View>& view, const Draw& draw,
                             shadow::PhaseClock& clock) {
  if (!subsets_ || subsets_->all.empty()) {
    ++passes_;
    drawPass(action, draw, Delayed::noted);
    clock.end("drawing");
    return {};
  }
  const Subsets& subsets = *subsets_;
  const gl::Rect whole{view->x, view->y, view->width, view->height};
  Delayed delayed = Delayed::noted;
  for (std::size_t round = 0; round < roundsOf(subsets); ++round) {
    if (auto done = stamp(subsets, round, whole); !done) {
      if (delayed == Delayed::noted) drawPass(action, draw, delayed);
      return done;
    }
    clock.end("stencil");
    const std::size_t first = round * kPerRound, end = std::min(first + kPerRound, subsets.all.size());
    for (std::size_t i = round == 0 ? 0 : first + 1; i <= end; ++i) {
      const Subset* subset = i > 0 ? &subsets.all[i - 1] : nullptr;
      drawSubset(action, subset, static_cast<std::uint8_t>(i - first), whole, draw, delayed);
      delayed = Delayed::astray;
    }
    clock.end("drawing");
  }
  gl::HostScope scope;
  gl::fillStencil(scope, 0, whole);
  clock.end("stencil");
  return {};
}

void Engine::drawSubset(SoGLRenderAction* action, const Subset* subset, std::uint8_t stencil, const gl::Rect& whole,
                        const Draw& draw, Delayed delayed) {
  std::vector<SoNode*> off;
  gl::Rect box = whole;
  if (subset != nullptr) {
    for (const std::size_t light : subset->off) off.push_back(lights_[light].node);
    box = {whole.x + subset->box.x, whole.y + subset->box.y, subset->box.width, subset->box.height};
  }
  const LightsOff dark(off);
  const gl::StencilWindow window(stencil, box);
  drawPass(action, draw, delayed);
  ++passes_;
}

void Engine::forgetShadows() {
  geometry_.reset();
  view_.reset();
  reach_.clear();
  subsets_.reset();
  lights_.clear();
  reportIsOld_ = true;
}

const ShadowReport& Engine::report() {
  if (!reportIsOld_) return report_;
  reportIsOld_ = false;
  report_ = {geometry_, {}, view_ ? view_->pinhole : std::nullopt, {}, passes_, phases_, masks_.used()};
  if (view_ && geometry_ == builder_.world().geometry) report_.unseen = Unseen(builder_.world(), *view_).all();
  for (std::size_t i = 0; i < reach_.size(); ++i) {
    const scene::Light& light = lights_[i].light;
    report_.lights.push_back({lights_[i].node, light, reach_[i], reach_[i]});
    if (!std::holds_alternative<scene::SpotLight>(light.shape)) continue;
    if (const auto seen = masks_.seen(builder_.world(), *view_))
      cutCone(report_.lights.back().mask, light, *view_, geometry_->surfaces, **seen);
  }
  return report_;
}

}  // namespace umbrage::coin::detail
