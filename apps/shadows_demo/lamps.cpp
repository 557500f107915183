#include "lamps.hpp"

#include <Inventor/manips/SoDirectionalLightManip.h>
#include <Inventor/manips/SoPointLightManip.h>
#include <Inventor/manips/SoSpotLightManip.h>
#include <Inventor/nodes/SoGroup.h>
#include <Inventor/nodes/SoTransform.h>
#include <Inventor/nodes/SoTransformSeparator.h>

#include "umbrage/coin/shadow_manager.hpp"

namespace umbrage::demo {
namespace {

constexpr float kHandleSize = 0.25f;

SoLight* point() {
  auto* light = new SoPointLightManip;
  light->location.setValue(0, 0, 0);
  return light;
}

SoLight* directional(const SbVec3f& direction) {
  auto* light = new SoDirectionalLightManip;
  light->direction = direction;
  return light;
}

SoLight* spot(const SbVec3f& direction) {
  auto* light = new SoSpotLightManip;
  light->location.setValue(0, 0, 0);
  light->direction = direction;
  light->cutOffAngle = 0.5f;
  light->dropOffRate = 0.1f;
  return light;
}

}  // namespace

// What comes after the stand has the light, but not its transformation, which makes the handle small.
Lamps::Lamp Lamps::stood(const char* name, SoLight* light, const SbVec3f& at, const SbColor& colour, float intensity) {
  light->color = colour;
  light->intensity = intensity;
  auto* place = new SoTransform;
  place->translation = at;
  place->scaleFactor.setValue(kHandleSize, kHandleSize, kHandleSize);
  auto* stand = new SoTransformSeparator;
  stand->addChild(place);
  stand->addChild(light);
  return {name, hold(light), hold<SoNode>(stand)};
}

Lamps::Lamps(SoGroup& where)
    : where_(where),
      all_{stood("point light 1", point(), {5, 7, 5}, {1, 1, 1}, 0.8f),
           stood("point light 2", point(), {-4, 7, 5}, {1, 0.75f, 0.5f}, 0.3f),
           stood("point light 3", point(), {6, 6, -3}, {0.6f, 1, 0.6f}, 0.3f),
           stood("point light 4", point(), {0, 7.5f, 6}, {0.6f, 0.7f, 1}, 0.3f),
           stood("the directional light", directional({-0.5f, -1, -0.3f}), {-2, 7, -4}, {1, 1, 0.9f}, 0.3f),
           stood("the spot light", spot({-0.7f, -1, -0.2f}), {4, 7, 1}, {1, 0.9f, 0.6f}, 0.5f)} {}

Result<void> Lamps::toggle(std::size_t index, coin::ShadowManager& shadows) {
  Lamp& lamp = all_[index];
  const auto done = lamp.there ? shadows.removeLight(lamp.light.get()) : shadows.addLight(lamp.light.get());
  if (!done) return done;
  lamp.there ? where_.removeChild(lamp.stand.get()) : where_.addChild(lamp.stand.get());
  lamp.there = !lamp.there;
  return {};
}

std::string Lamps::listed() const {
  std::string keys;
  for (std::size_t i = 0; i < kCount; ++i)
    if (all_[i].there) keys += (keys.empty() ? "" : " ") + std::to_string(i + 1);
  return keys.empty() ? "none" : keys;
}

}  // namespace umbrage::demo
