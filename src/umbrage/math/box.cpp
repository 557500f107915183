#include "umbrage/math/box.hpp"

#include <algorithm>

namespace umbrage {

bool meetsWay(const Box3& box, double margin, const Vec3& from, const Vec4& to) {
  const Vec3 way = Vec3(to) - from * to.w;
  double enter = 0.0, leave = to.w == 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min[axis] - margin - from[axis], high = box.max[axis] + margin - from[axis];
    if (way[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / way[axis], high / way[axis]));
    leave = std::min(leave, std::max(low / way[axis], high / way[axis]));
  }
  return enter <= leave;
}

}  // namespace umbrage
