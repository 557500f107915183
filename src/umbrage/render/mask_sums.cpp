#include "umbrage/render/mask_sums.hpp"

#include <cmath>
#include <limits>

namespace umbrage::render {

shadow::SoftStats softStats(const image::Image<Vec4f>& sums, const image::Image<std::uint32_t>& ids,
                            std::size_t samples) {
  // So much of a light is none, or all, whatever rounding left of it.
  constexpr double kNone = 0.5 / 65535.0;
  shadow::SoftStats stats{samples};
  double squares = 0.0;
  std::size_t covered = 0;
  bool both = false;  // halves have samples
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (ids.pixels()[i] == shadow::kNoTriangle) continue;
    ++covered;
    const Vec4 sum(sums.pixels()[i]);
    const double weight = sum.y + sum.w, mean = weight > 0.0 ? (sum.x + sum.z) / weight : 0.0;
    stats.umbra += mean <= kNone;
    stats.penumbra += mean > kNone && mean < 1.0 - kNone;
    if (!(sum.y > 0.0 && sum.w > 0.0)) continue;
    both = true;
    const double apart = (sum.x / sum.y - sum.z / sum.w) / 2.0;
    squares += apart * apart;
  }
  stats.error =
      both ? std::sqrt(squares / double(std::max<std::size_t>(1, covered))) : std::numeric_limits<double>::infinity();
  return stats;
}

}  // namespace umbrage::render
