#pragma once

#include <optional>
#include <vector>

#include "umbrage/cut/detail/casters.hpp"
#include "umbrage/scene/light.hpp"

namespace umbrage::cut::detail {

/// A spot's cone as a pyramid of many sides, of the same cross-section.
struct Cone {
  bool insideIsLit = true;    ///< false: the cone is wider than a half-space, and what it leaves out is the pyramid
  std::vector<Vec3> inwards;  ///< of the pyramid's sides, which pass through the light: unit normals
};
inline constexpr int kConeSides = 720;

/// None for lights that are no spots, and for those that shine everywhere.
[[nodiscard]] std::optional<Cone> coneOf(const scene::Light& light);

/// The pyramid's sides as lines on a face, positive inside.
[[nodiscard]] std::vector<Vec3> linesOn(const Cone& cone, const Face& face, const Vec3& apex);

}  // namespace umbrage::cut::detail
