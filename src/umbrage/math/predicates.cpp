#include "umbrage/math/predicates.hpp"

namespace umbrage {

int lightSide(const Vec3& a, const Vec3& b, const Vec3& c, const Vec4& light) {
  const Vec3 ac = c - a;
  const Vec3 al = Vec3(light) - a * light.w;
  const Vec3 ab = b - a;
  const double volume = (ac.y * al.z - ac.z * al.y) * ab.x + (ac.z * al.x - ac.x * al.z) * ab.y +
                        (ac.x * al.y - ac.y * al.x) * ab.z;
  return (volume > 0.0) - (volume < 0.0);
}

}  // namespace umbrage
