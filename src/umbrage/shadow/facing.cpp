#include "umbrage/shadow/facing.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/finders/threads.hpp"

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
  constexpr std::size_t kPerThread = 16384;
  const std::size_t count = surfaces.triangles.size();
  const auto threads = static_cast<unsigned>(std::min<std::size_t>(threadCount(0), 1 + count / kPerThread));
  std::vector<std::uint8_t> facing(count);
  inParts(count, 64, threads, [&](unsigned, std::size_t begin, std::size_t end) {
    for (auto t = static_cast<std::uint32_t>(begin); t < end; ++t)
      facing[t] = visibleSideFacesLight(surfaces, t, eye, light) ? 1 : 0;
  });
  return facing;
}

bool visibleSideFacesLight(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec4& eye,
                           const Vec4& light) {
  const Vec3 a = surfaces.corner(triangle, 0), b = surfaces.corner(triangle, 1), c = surfaces.corner(triangle, 2);
  return lightSide(a, b, c, eye) * lightSide(a, b, c, light) > 0 && !rakes(a, b, c, light);
}

}  // namespace umbrage::shadow
