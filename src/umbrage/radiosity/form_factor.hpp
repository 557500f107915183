#pragma once

#include <span>

#include "umbrage/math/vec.hpp"

namespace umbrage::radiosity {

/// The form factor from a small piece of surface to a flat polygon, as if nothing stood between: of all light that the piece would give off, the
/// part that goes to the polygon; in [0, 1]. What of the polygon lies behind the piece counts nothing.
/// normal: unit. REQUIRES: the polygon is convex and has at most 8 corners; `point` is not on its border.
/// Source: J. H. Lambert, Photometria, 1760 (the contour formula); M. F. Cohen and J. R. Wallace, Radiosity and Realistic Image Synthesis, 1993.
[[nodiscard]] double polygonFactor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon);

}  // namespace umbrage::radiosity
