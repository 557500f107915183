#pragma once

#include "umbrage/cut/detail/casters.hpp"

namespace umbrage::cut::detail {

/// Some point within a polygon of a face, `which` of several. Crooked, since the very middle is apt to lie in line with edges that are no borders: on a
/// lattice, or where triangles of one surface meet.
[[nodiscard]] Vec3 innerPoint(const Face& face, const Polygon& polygon, int which);

/// Whether a polygon of a face that no border crosses is hidden, as any of its points is. Should rounding ever let the way to the light slip through between
/// two triangles, the majority of three overrules it. `steps` grows by the work it was; so it does below.
[[nodiscard]] bool isHidden(const Casters& casters, const Face& face, const Polygon& polygon, std::int64_t& steps);

/// Whether one caster alone is found to hide all of a polygon, so that borders in it need no look. False says nothing.
[[nodiscard]] bool isCovered(const Casters& casters, const Face& face, const Polygon& polygon, std::int64_t& steps);

}  // namespace umbrage::cut::detail
