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

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

bool isArea(const Light& light) {
  return !std::holds_alternative<PointLight>(light.shape) && !std::holds_alternative<DirectionalLight>(light.shape) &&
         !std::holds_alternative<SpotLight>(light.shape);
}

Vec4 homogeneous(const Light& light, const Vec3& origin) {
  struct Centre {
    Vec3 origin;
    Vec4 operator()(const PointLight& l) const { return {l.position - origin, 1.0}; }
    Vec4 operator()(const DirectionalLight& l) const { return {-glm::normalize(l.direction), 0.0}; }
    Vec4 operator()(const SpotLight& l) const { return {l.position - origin, 1.0}; }
    Vec4 operator()(const DiscLight& l) const { return {l.centre - origin, 1.0}; }
    Vec4 operator()(const RectangleLight& l) const { return {l.centre - origin, 1.0}; }
    Vec4 operator()(const SphereLight& l) const { return {l.centre - origin, 1.0}; }
    Vec4 operator()(const SunLight& l) const { return {-glm::normalize(l.direction), 0.0}; }
  };
  return std::visit(Centre{origin}, light.shape);
}

bool insideCone(const Light& light, const Vec3& point) {
  const auto* spot = std::get_if<SpotLight>(&light.shape);
  if (spot == nullptr) return true;
  const Vec3 ray = point - spot->position;
  return glm::dot(ray, glm::normalize(spot->direction)) >= cos(spot->cutoff) * glm::length(ray);
}

bool isValid(const Light& light) {
  struct Valid {
    bool operator()(const PointLight& l) const { return properPosition(l.position); }
    bool operator()(const DirectionalLight& l) const { return properDirection(l.direction); }
    bool operator()(const SpotLight& l) const {
      return properPosition(l.position) && properDirection(l.direction) && l.cutoff > Angle() &&
             l.cutoff <= Angle::degrees(180);
    }
    bool operator()(const DiscLight& l) const {
      return properPosition(l.centre) && properDirection(l.direction) && positive(l.radius);
    }
    bool operator()(const RectangleLight& l) const {
      return properPosition(l.centre) && properDirection(glm::cross(l.u, l.v));
    }
    bool operator()(const SphereLight& l) const { return properPosition(l.centre) && positive(l.radius); }
    bool operator()(const SunLight& l) const {
      return properDirection(l.direction) && l.radius > Angle() && l.radius < Angle::degrees(90);
    }
  };
  return finite(light.colour) && std::isfinite(light.intensity) && std::visit(Valid{}, light.shape);
}

}  // namespace umbrage::scene
