#include "umbrage/coin/detail/culling.hpp"

#include <Inventor/VRMLnodes/SoVRMLCone.h>
#include <Inventor/VRMLnodes/SoVRMLCylinder.h>
#include <Inventor/VRMLnodes/SoVRMLElevationGrid.h>
#include <Inventor/VRMLnodes/SoVRMLExtrusion.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedFaceSet.h>
#include <Inventor/VRMLnodes/SoVRMLSphere.h>
#include <Inventor/elements/SoOverrideElement.h>
#include <Inventor/elements/SoShapeHintsElement.h>

#include <optional>

namespace umbrage::coin::detail {
namespace {

template <class... Types>
bool isAny(const SoNode& node) {
  return (node.isOfType(Types::getClassTypeId()) || ...);
}

Culled backOf(bool solid, bool counterclockwise) {
  if (!solid) return Culled::none;
  return counterclockwise ? Culled::clockwise : Culled::counterclockwise;
}

template <class Faces>
std::optional<Culled> byItsFields(const SoNode& shape) {
  if (!isAny<Faces>(shape)) return std::nullopt;
  const auto& faces = static_cast<const Faces&>(shape);
  return backOf(faces.solid.getValue() != FALSE, faces.ccw.getValue() != FALSE);
}

// VRML's shapes say it themselves, whatever hints stand before; its box does not.
std::optional<Culled> byItself(const SoNode& shape) {
  if (const auto faces = byItsFields<SoVRMLIndexedFaceSet>(shape)) return faces;
  if (const auto grid = byItsFields<SoVRMLElevationGrid>(shape)) return grid;
  if (const auto extrusion = byItsFields<SoVRMLExtrusion>(shape)) return extrusion;
  if (isAny<SoVRMLSphere, SoVRMLCone, SoVRMLCylinder>(shape)) return backOf(true, true);
  return std::nullopt;
}

Culled byHints(SoState* state) {
  SoShapeHintsElement::VertexOrdering ordering{};
  SoShapeHintsElement::ShapeType type{};
  SoShapeHintsElement::FaceType face{};
  SoShapeHintsElement::get(state, ordering, type, face);
  if (ordering == SoShapeHintsElement::UNKNOWN_ORDERING) return Culled::none;
  return backOf(type == SoShapeHintsElement::SOLID, ordering == SoShapeHintsElement::COUNTERCLOCKWISE);
}

}  // namespace

Culled culledOf(SoState* state, const SoNode& shape) {
  const bool overridden = (SoOverrideElement::getFlags(state) & SoOverrideElement::SHAPE_HINTS) != 0;
  if (!overridden)
    if (const auto own = byItself(shape)) return *own;
  return byHints(state);
}

}  // namespace umbrage::coin::detail
