#include "umbrage/scene/light.hpp"

#include <cmath>

namespace umbrage::scene {
namespace {

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool properPosition(const Vec3& v) { return finite(v) && glm::length(v) <= kFarthestLight; }

bool properDirection(const Vec3& v) {
  const double length = glm::length(v);
  return std::isfinite(length) && length > 1e-150;
}

}  // namespace

Vec4 homogeneous(const Light& light, const Vec3& origin) {
  if (const auto* sun = std::get_if<DirectionalLight>(&light.shape)) return {-glm::normalize(sun->direction), 0.0};
  if (const auto* lamp = std::get_if<PointLight>(&light.shape)) return {lamp->position - origin, 1.0};
  return {std::get<SpotLight>(light.shape).position - origin, 1.0};
}

bool insideCone(const Light& light, const Vec3& point) {
  const auto* spot = std::get_if<SpotLight>(&light.shape);
  if (spot == nullptr) return true;
  const Vec3 ray = point - spot->position;
  return glm::dot(ray, glm::normalize(spot->direction)) >= cos(spot->cutoff) * glm::length(ray);
}

bool isValid(const Light& light) {
  if (!finite(light.colour) || !std::isfinite(light.intensity)) return false;
  if (const auto* sun = std::get_if<DirectionalLight>(&light.shape)) return properDirection(sun->direction);
  if (const auto* lamp = std::get_if<PointLight>(&light.shape)) return properPosition(lamp->position);
  const auto& spot = std::get<SpotLight>(light.shape);
  return properPosition(spot.position) && properDirection(spot.direction) && spot.cutoff > Angle() &&
         spot.cutoff <= Angle::degrees(180);
}

}  // namespace umbrage::scene
