#pragma once

#include <vector>

#include "umbrage/study/detail/hours_casters.hpp"

namespace umbrage::study::detail {

/// A ball within a closed solid.
struct Ball {
  Vec3 centre;  ///< relative to the origin of the surfaces
  double radius;
};

/// Balls that lie within the closed solids among the casters, for solids of many faces. Who sees the sun's centre behind such a ball sees
/// no sun: the way there passes through the solid's surface. One ball so answers for the faces before it, and only
/// those near the solid's outline are left.
/// 1. No ball reaches the surface of its solid, and all of it has the same winding number, which is not 0.
/// 2. Solids of few faces, and places too narrow for a ball worth its price, have none.
/// Source: the shrinking ball, Ma, Bae and Choi, 3D medial axis point approximation using nearest neighbors and the normal field, 2012.
[[nodiscard]] std::vector<Ball> findBalls(const scene::Surfaces& surfaces, const Casters& casters);

}  // namespace umbrage::study::detail
