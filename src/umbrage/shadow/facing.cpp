#include "umbrage/shadow/facing.hpp"

#include "umbrage/math/predicates.hpp"

namespace umbrage::shadow {

std::vector<std::uint8_t> visibleSideFacesLight(const scene::Surfaces& surfaces, const Vec4& eye, const Vec4& light) {
  std::vector<std::uint8_t> facing;
  facing.reserve(surfaces.triangles.size());
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Vec3 a = surfaces.corner(t, 0), b = surfaces.corner(t, 1), c = surfaces.corner(t, 2);
    facing.push_back(lightSide(a, b, c, eye) * lightSide(a, b, c, light) > 0 ? 1 : 0);
  }
  return facing;
}

}  // namespace umbrage::shadow
