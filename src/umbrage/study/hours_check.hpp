#pragma once

#include <cstddef>

#include "umbrage/base/error.hpp"
#include "umbrage/sun/self_check.hpp"

namespace umbrage::study {

/// ExactHours held against ERFA: single triangles about a point, each at a place and on a day of its own.
struct HoursCheck {
  std::size_t triangles = 0;
  /// Seconds from each moment at which the point is covered or uncovered to where sun::sunPositionByObserver passes the nearest of
  /// the triangle's edges or the horizon.
  sun::Deviation changes;
  std::size_t moments = 0;  ///< at which light and shade were asked for as well, farther than a second from a change
  std::size_t wrong = 0;    ///< of them, where a ray towards ERFA's sun says otherwise
};
/// Errors: memory.
[[nodiscard]] Result<HoursCheck> checkHours(std::size_t triangles = 200);

inline constexpr double kChangeBound = 0.5;  ///< seconds, of HoursCheck::changes
[[nodiscard]] bool holds(const HoursCheck& check);

}  // namespace umbrage::study
