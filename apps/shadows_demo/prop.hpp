#pragma once

#include <Inventor/SbVec3f.h>
#include <Inventor/nodes/SoSeparator.h>

#include "ref.hpp"

class SoTransform;

namespace umbrage::demo {

/// An object of the scene that keys move and scale.
class Prop {
 public:
  /// Makes `shape` as large as `size` units and stands its middle at `middle`.
  /// REQUIRES: inventor::checkGraph has nothing against the shape.
  Prop(SoNode* shape, float size, const SbVec3f& middle);

  [[nodiscard]] SoSeparator* node() const { return node_.get(); }
  void move(const SbVec3f& by);
  /// Between 1/64 and 64 times the size at the beginning; false where the factor leads beyond.
  [[nodiscard]] bool scale(float factor);
  /// Off: Coin is not told what move and scale do. On: it is, and of what happened meanwhile, too.
  void setSensed(bool on);

 private:
  Ref<SoSeparator> node_;
  SoTransform* pose_;
};

}  // namespace umbrage::demo
