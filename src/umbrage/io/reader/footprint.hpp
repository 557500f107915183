#pragma once

#include <vector>

#include "umbrage/math/vec.hpp"
#include "umbrage/mesh/mesh.hpp"

namespace umbrage::io::reader {

/// The first ring is the outer one, the others are holes; no ring repeats its first point at its end.
using Footprint = std::vector<std::vector<Vec2>>;

/// The footprint without repeated points and rings of fewer than three; empty where nothing is left of its outer ring.
[[nodiscard]] Footprint cleanFootprint(const Footprint& footprint);

/// No ring crosses or touches itself along a line, holes lie inside.
[[nodiscard]] bool isSimple(const Footprint& footprint);

/// What the outer ring of a crossing footprint encloses without what its holes enclose, as simple footprints; none where that is none.
[[nodiscard]] std::vector<Footprint> untangle(const Footprint& footprint);

/// Adds the closed prism over a simple footprint from `base` to `top`, wound outwards.
void addPrism(mesh::Mesh& mesh, const Footprint& footprint, double base, double top);

}  // namespace umbrage::io::reader
