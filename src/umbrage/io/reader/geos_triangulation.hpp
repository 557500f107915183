#pragma once

#include <vector>

#include "umbrage/io/reader/ear_clipping.hpp"

namespace umbrage::io::reader {

/// A constrained Delaunay triangulation, or nothing where GEOS refuses the polygon or a triangle has no area to orient it by.
/// The caller checks that it is complete.
[[nodiscard]] std::vector<mesh::Triangle> triangulateWithGeos(const PlanePolygon& polygon);

}  // namespace umbrage::io::reader
