#pragma once

#include <Inventor/actions/SoSearchAction.h>

#include <string>

#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/inventor/full_path.hpp"

namespace umbrage::coin::test {

inline const std::string kOneLight = "DEF LAMP PointLight { location 3 5 4 }\n";
inline const std::string kThreeLights =
    "DEF LAMP PointLight { location 3 5 4 color 1 0.5 0.4 intensity 0.7 }\n"
    "DEF SUN DirectionalLight { direction 0.7 -1 -0.4 color 0.4 1 0.5 intensity 0.5 }\n"
    "DEF SPOT SpotLight { location -4 6 2 direction 0.6 -1 -0.3 cutOffAngle 0.5 dropOffRate 0.1 color 0.4 0.5 1 }\n";
inline const std::string kSolids =
    "DEF FLOOR Separator { Translation { translation 0 -1 0 } Material { diffuseColor 0.8 0.8 0.8 }\n"
    "  Complexity { value 1 } Coordinate3 { point [ -6 0 -6, 6 0 -6, 6 0 6, -6 0 6 ] }\n"
    "  ShapeHints { vertexOrdering COUNTERCLOCKWISE } IndexedFaceSet { coordIndex [ 0, 3, 2, 1, -1 ] } }\n"
    "DEF BALL Separator { DEF BALLAT Translation { translation -1.5 0.3 0 } Material { diffuseColor 0.9 0.3 0.2 } "
    "Sphere { radius 0.9 } }\n"
    "DEF BOX Separator { DEF BOXAT Transform { translation 1.2 -0.2 0.5 rotation 0 1 0 0.6 } Material { diffuseColor "
    "0.2 0.5 0.9 specularColor 1 1 1 shininess 0.6 }\n"
    "  DEF CUBE Cube { width 1.2 height 1.6 depth 1 } }\n"
    "DEF PIPE Separator { Transform { translation 0 0 -2 } Material { diffuseColor 0.4 0.8 0.3 } Cylinder { radius 0.5 "
    "height 2 } }\n";
inline const std::string kCamera =
    "PerspectiveCamera { position 1 3 8 orientation -1 0.2 0 0.32 nearDistance 0.5 farDistance 40 heightAngle 0.8 }\n";

/// A camera, and a group with lights and shapes.
inline std::string room(const std::string& fields, const std::string& lights, const std::string& shapes,
                        const std::string& before = kCamera) {
  return "Separator {\n" + before + "DEF GROUP ExactShadowGroup { " + fields + "\n" + lights + shapes + "} }";
}

template <class Node>
Node* find(SoNode* root, const char* name) {
  SoSearchAction search;
  search.setName(name);
  search.setSearchingAll(TRUE);
  search.apply(root);
  return search.getPath() != nullptr ? static_cast<Node*>(inventor::FullPath(*search.getPath()).tail()) : nullptr;
}

inline SoExactShadowGroup* groupOf(SoNode* root) { return find<SoExactShadowGroup>(root, "GROUP"); }

}  // namespace umbrage::coin::test
