#include "umbrage/trace/segment.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/math/predicates.hpp"
#include "umbrage/scene/light.hpp"

namespace umbrage::trace {
namespace {

double distanceToEdge(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double square = glm::dot(along, along);
  const double s = square > 0.0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::length(a + s * along - point);
}

// Six times the signed volumes spanned by the line and each edge are of one sign where it passes inside.
bool passesInside(const Vec3& from, const Vec3& direction, const Corners& triangle) {
  const Vec3 a = triangle.a - from, b = triangle.b - from, c = triangle.c - from;
  const double u = glm::dot(direction, glm::cross(c, b));
  const double v = glm::dot(direction, glm::cross(a, c));
  const double w = glm::dot(direction, glm::cross(b, a));
  return (std::min({u, v, w}) >= 0.0 || std::max({u, v, w}) <= 0.0) && u + v + w != 0.0;
}

}  // namespace

std::optional<double> crossing(const Vec3& from, const Vec3& direction, const Corners& triangle) {
  if (!passesInside(from, direction, triangle)) return std::nullopt;
  const Vec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
  const double slope = glm::dot(direction, normal);
  if (slope == 0.0) return std::nullopt;
  const double t = glm::dot(triangle.a - from, normal) / slope;
  return t > 0.0 ? std::optional(t) : std::nullopt;
}

bool hides(const Corners& triangle, const Vec3& point, const Vec4& light) {
  const int ofLight = lightSide(triangle.a, triangle.b, triangle.c, light);
  const int ofPoint = lightSide(triangle.a, triangle.b, triangle.c, Vec4(point, 1.0));
  return ofLight * ofPoint < 0 && passesInside(point, scene::towardsLight(light, point), triangle);
}

double distance(const Vec3& point, const Corners& triangle) {
  const Vec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
  const double length = glm::length(normal);
  if (length > 0.0) {
    const Vec3 unit = normal / length;
    const double height = glm::dot(point - triangle.a, unit);
    const Vec3 foot = point - height * unit;
    const bool inside = glm::dot(glm::cross(triangle.b - triangle.a, foot - triangle.a), normal) >= 0.0 &&
                        glm::dot(glm::cross(triangle.c - triangle.b, foot - triangle.b), normal) >= 0.0 &&
                        glm::dot(glm::cross(triangle.a - triangle.c, foot - triangle.c), normal) >= 0.0;
    if (inside) return std::abs(height);
  }
  return std::min({distanceToEdge(point, triangle.a, triangle.b), distanceToEdge(point, triangle.b, triangle.c),
                   distanceToEdge(point, triangle.c, triangle.a)});
}

}  // namespace umbrage::trace
