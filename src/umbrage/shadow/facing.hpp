#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/scene/surfaces.hpp"

namespace umbrage::shadow {

/// Per triangle of `surfaces`: 1 when the side that the eye sees is the side that the light sees. Constant over a triangle for
/// any eye and light, so it is decided once, in double precision, for all techniques alike; edge-on to either is 0.
/// A light that rises nowhere more than 1e-6 radians over a triangle counts as edge-on: coordinates are rounded to single precision,
/// and facets of one flat wall would face it or not by chance.
/// `eye` and `light` are homogeneous and relative to surfaces.origin (w = 0: a parallel view or a directional light).
[[nodiscard]] std::vector<std::uint8_t> visibleSideFacesLight(const scene::Surfaces& surfaces, const Vec4& eye,
                                                              const Vec4& light);

/// The same for one triangle.
[[nodiscard]] bool visibleSideFacesLight(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec4& eye,
                                         const Vec4& light);

}  // namespace umbrage::shadow
