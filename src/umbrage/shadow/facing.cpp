#include "umbrage/shadow/facing.hpp"

#include <cmath>

#include "umbrage/math/predicates.hpp"

namespace umbrage::shadow {
namespace {

// Coordinates rounded to single precision turn a small face by as much; a light this near to its plane lies in it.
constexpr double kRakingSine = 0x1p-20;

// Whether the light rakes along the triangle: its elevation, where it is highest over the triangle, is lost in the rounding.
bool rakes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec4& light) {
  const Vec3 normal = glm::cross(b - a, c - a), towards = Vec3(light) - a * light.w;
  const double height = std::abs(glm::dot(normal, towards)) / glm::length(normal);
  if (!(height <= kRakingSine * glm::length(towards))) return false;
  return light.w == 0.0 || height <= kRakingSine * distanceToTriangle(Vec3(light), a, b, c);
}

}  // namespace

std::vector<std::uint8_t> visibleSideFacesLight(const scene::Surfaces& surfaces, const Vec4& eye, const Vec4& light) {
  std::vector<std::uint8_t> facing;
  facing.reserve(surfaces.triangles.size());
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    facing.push_back(visibleSideFacesLight(surfaces, t, eye, light) ? 1 : 0);
  return facing;
}

bool visibleSideFacesLight(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec4& eye,
                           const Vec4& light) {
  const Vec3 a = surfaces.corner(triangle, 0), b = surfaces.corner(triangle, 1), c = surfaces.corner(triangle, 2);
  return lightSide(a, b, c, eye) * lightSide(a, b, c, light) > 0 && !rakes(a, b, c, light);
}

}  // namespace umbrage::shadow
