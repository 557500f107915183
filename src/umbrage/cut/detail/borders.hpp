#pragma once

#include <vector>

#include "umbrage/cut/detail/casters.hpp"

namespace umbrage::cut::detail {

/// A piece of a line on a face across which the number of casters before the face may change.
struct Border {
  Vec2 from, to;
  std::uint32_t line;  ///< of Borders::lines
};
struct Borders {
  std::vector<Border> borders;
  std::vector<Vec3> lines;  ///< over (u, v, 1), unit: a distance
};

/// All of them on a face: shadows of silhouette edges, edges on which casters stand, and lines in which casters pierce it. Elsewhere on the face the number
/// is constant.
/// Lines come from the planes through the light and the two ends of an edge, or of the caster, as they are given: nothing that was computed by cutting is
/// in them.
[[nodiscard]] Borders bordersOn(const Casters& casters, const Face& face);

}  // namespace umbrage::cut::detail
