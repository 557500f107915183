#pragma once

#include "umbrage/cut/pieces.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::cut {

/// The scene with its surfaces cut, for files: lit and shadowed parts under names and materials of their own.
///
/// 1. Every part "House/Roof" becomes "House/Roof/lit" and "House/Roof/shadow", those of both that there are; with several lights "lit", "lit 1+3", ..,
///    "shadow", by the lights that reach it, counted from 1, "lit" by all. Triangles are those of convex pieces.
/// 2. Materials likewise: "brick lit" has the colour of "brick", "brick shadow" `ambient` of it.
/// 3. Meshes are in world coordinates; corners of triangles stay as they are in Surfaces, in single precision around their origin, those of cuts are double.
/// REQUIRES: `surfaces` are those of `scene`, `pieces` those of `surfaces` under `lights` lights; 0 <= ambient <= 1.
[[nodiscard]] scene::Scene litScene(const scene::Scene& scene, const scene::Surfaces& surfaces, const Pieces& pieces,
                                    std::size_t lights, double ambient = 0.3);

}  // namespace umbrage::cut
