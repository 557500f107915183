#include "prop.hpp"

#include <Inventor/SbViewportRegion.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoTransform.h>

#include <algorithm>

namespace umbrage::demo {
namespace {

constexpr float kMostScale = 64.0f;

// Carries the shape's box to a cube of edge 1 around the origin.
SoTransform* fit(SoNode* shape) {
  SoGetBoundingBoxAction measure(SbViewportRegion(640, 480));
  measure.apply(shape);
  auto* transform = new SoTransform;
  const SbBox3f box = measure.getBoundingBox();
  if (box.isEmpty()) return transform;
  float x = 0, y = 0, z = 0;
  box.getSize(x, y, z);
  const float largest = std::max({x, y, z});
  if (!(largest > 0.0f)) return transform;
  transform->scaleFactor.setValue(1 / largest, 1 / largest, 1 / largest);
  transform->translation = box.getCenter() * (-1 / largest);
  return transform;
}

}  // namespace

Prop::Prop(SoNode* shape, float size, const SbVec3f& middle) : node_(hold(new SoSeparator)), pose_(new SoTransform) {
  const Ref<SoNode> held = hold(shape);
  pose_->translation = middle;
  pose_->scaleFactor.setValue(1, 1, 1);
  auto* sized = new SoTransform;
  sized->scaleFactor.setValue(size, size, size);
  node_->addChild(pose_);
  node_->addChild(sized);
  node_->addChild(fit(shape));
  node_->addChild(shape);
}

void Prop::move(const SbVec3f& by) { pose_->translation = pose_->translation.getValue() + by; }

bool Prop::scale(float factor) {
  const float now = pose_->scaleFactor.getValue()[0] * factor;
  if (now > kMostScale || now < 1 / kMostScale) return false;
  pose_->scaleFactor.setValue(now, now, now);
  return true;
}

void Prop::setSensed(bool on) {
  pose_->enableNotify(on);
  if (on) pose_->touch();
}

}  // namespace umbrage::demo
