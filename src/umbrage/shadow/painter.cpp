#include "umbrage/shadow/painter.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/shadow/barycentric.hpp"

namespace umbrage::shadow {

Painter::Painter(const scene::Scene& scene, const scene::Surfaces& surfaces, std::span<const scene::Light> lights,
                 const CompositeOptions& options)
    : scene_(scene), surfaces_(surfaces), up_(scene::upVector(scene.up)), options_(options) {
  for (const scene::Light& light : lights)
    lights_.push_back({scene::homogeneous(light, surfaces.origin), light.colour * light.intensity});
}

// Light that falls on a surface at `point`, unshadowed.
Vec3 Painter::received(const PreparedLight& light, const Vec3& point, const Facing& facing) {
  const Vec3 direction = scene::towardsLight(light.homogeneous, point);
  const double length = glm::length(direction);
  if (!(length > 0.0)) return Vec3(0.0);
  const double cosine = glm::dot(facing.normal, direction) / length;
  if (!facing.isSmooth) return light.radiance * std::abs(cosine);
  return light.radiance * std::max(0.0, (cosine - facing.fade) / (1.0 - facing.fade));
}

Facing Painter::smoothFacing(std::uint32_t triangle, const Vec3& point, double side) const {
  const auto& corners = options_.smooth->corners[triangle];
  const Vec3 parts = barycentric(surfaces_, triangle, point);
  Vec3 normal(0.0);
  double slack = 0.0;
  for (int k = 0; k < 3; ++k) {
    normal += parts[k] * Vec3(corners[static_cast<std::size_t>(k)].normal);
    slack += parts[k] * double(corners[static_cast<std::size_t>(k)].slack);
  }
  return {side * glm::normalize(normal), true, options_.hideTerminator ? std::min(0.5, slack) : 0.0};
}

}  // namespace umbrage::shadow
