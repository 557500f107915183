#pragma once

#include <utility>
#include <vector>

#include "umbrage/math/vec.hpp"
#include "umbrage/study/detail/sun_leg.hpp"

namespace umbrage::study::detail {

/// Stretches of hours, ascending, in pseudo-angles.
using Stretches = std::vector<std::pair<double, double>>;

/// When the sun of a leg is on the inner side of a plane through the eye, plane . (cos h, sin h, height(h)) >= 0, within the leg: in double
/// precision on the leg's own sun. `plane`: in the frame of the leg.
[[nodiscard]] Stretches stretchesInside(const SunLeg& leg, const Vec3& plane);

/// The same between two hours of one arc, where it is not more than one stretch or one gap: from > to is a gap from `to` to `from`;
/// -4 and 4 stand for "before" and "after". False when it is at no hour between them.
[[nodiscard]] bool hoursInside(const SunLeg& leg, const SunArc& arc, const Vec3& plane, double first, double last,
                               float& from, float& to);

}  // namespace umbrage::study::detail
