#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/math/box.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::study::detail {

/// A convex, flat quad made of two triangles, or one triangle, whose last corner is named twice.
struct CasterQuad {
  std::array<std::uint32_t, 4> corners;  ///< positions of the surfaces; outwards where `solid` >= 0
  std::int32_t solid;                    ///< the closed solid it belongs to, or -1
};

/// The triangles that hide the sun. Solids: components in which every edge joins two triangles and all can be turned outwards; seen
/// from outside of its box, such a one hides by its faces towards the point alone.
struct Casters {
  std::vector<CasterQuad> quads;
  struct Plane {
    Vec3 point, normal;  ///< unit, outwards
  };
  struct Solid {
    Box3 box;
    std::vector<Plane> sides;  ///< of a convex solid with few triangles; who is before one of them is outside
  };
  std::vector<Solid> solids;
};

/// `chosen`: triangles of the surfaces, ascending.
[[nodiscard]] Casters makeCasters(const scene::Surfaces& surfaces, const std::vector<std::uint32_t>& chosen);

}  // namespace umbrage::study::detail
