#pragma once

#include "umbrage/math/vec.hpp"
#include "umbrage/study/detail/sun_leg.hpp"

namespace umbrage::study::detail {

/// When the sun of a leg is on the inner side of a plane through the eye.
struct SideHours {
  enum class Kind { never, always, between };
  Kind kind;
  double from, to;  ///< pseudo-angles; wrapped where from > to
};

/// Solves plane . (cos h, sin h, height(h)) >= 0 in double precision on the leg's own sun, touching planes included.
/// `plane`: in the frame of the leg.
[[nodiscard]] SideHours hoursInside(const SunLeg& leg, const Vec3& plane);

}  // namespace umbrage::study::detail
