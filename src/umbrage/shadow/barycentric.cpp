#include "umbrage/shadow/barycentric.hpp"

#include <algorithm>

namespace umbrage::shadow {

Vec3 barycentric(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec3& point) {
  const Vec3 normal = surfaces.normal(triangle);
  const auto part = [&](int k) {
    const Vec3 a = surfaces.corner(triangle, (k + 1) % 3), b = surfaces.corner(triangle, (k + 2) % 3);
    return std::clamp(glm::dot(glm::cross(b - a, point - a), normal) / glm::dot(normal, normal), 0.0, 1.0);
  };
  const Vec3 parts(part(0), part(1), part(2));
  const double sum = parts.x + parts.y + parts.z;
  return sum > 0.0 ? parts / sum : Vec3(1.0 / 3.0);
}

}  // namespace umbrage::shadow
