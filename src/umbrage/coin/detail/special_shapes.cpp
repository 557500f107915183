#include "umbrage/coin/detail/special_shapes.hpp"

#include <Inventor/SoPath.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/draggers/SoDragger.h>
#include <Inventor/elements/SoViewportRegionElement.h>
#include <Inventor/nodes/SoAnnotation.h>
#include <Inventor/nodes/SoText3.h>

#include "umbrage/inventor/full_path.hpp"

namespace umbrage::coin::detail {
namespace {

bool isBelow(const SoPath& path, SoType type) {
  const inventor::FullPath full(path);
  for (int i = 0; i < full.length(); ++i)
    if (full.node(i)->isOfType(type)) return true;
  return false;
}

}  // namespace

// Programs may do without draggers: their type is bad then, and no node's.
bool isHandle(const SoPath& path) { return isBelow(path, SoDragger::getClassTypeId()); }

bool isAnnotation(const SoPath& path) { return isBelow(path, SoAnnotation::getClassTypeId()); }

std::optional<SbXfBox3f> letterSpace(SoCallbackAction& action, const SoNode& shape) {
  if (!shape.isOfType(SoText3::getClassTypeId())) return std::nullopt;
  SoPath* path = action.getCurPath()->copy();
  path->ref();
  SoGetBoundingBoxAction bounds(SoViewportRegionElement::get(action.getState()));
  bounds.apply(path);
  path->unref();
  SbXfBox3f space = bounds.getXfBoundingBox();
  const SbBox3f box = static_cast<const SbBox3f&>(space);  // SbXfBox3f hides its own corners
  const SbVec3f margin = (box.getMax() - box.getMin()) * 0.01f + SbVec3f(1e-6f, 1e-6f, 1e-6f);
  space.setBounds(box.getMin() - margin, box.getMax() + margin);
  return space;
}

}  // namespace umbrage::coin::detail
