#include "umbrage/trace/segment.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/math/predicates.hpp"
#include "umbrage/scene/light.hpp"

namespace umbrage::trace {
namespace {

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

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double distanceToBox(const Vec3& p, const Box3& box) {
  if (box.empty()) return 0.0;
  return glm::length(glm::max(glm::max(box.min - p, p - box.max), Vec3(0.0)));
}

bool sameSurface(const Corners& triangle, const Vec3& point, double resolution) {
  const auto& [a, b, c] = triangle;
  const Vec3 outside = glm::max(glm::min(a, glm::min(b, c)) - point, point - glm::max(a, glm::max(b, c)));
  if (std::max({outside.x, outside.y, outside.z}) > 2.0 * resolution)
    return false;  // most are: the box is quickly asked
  return distanceToTriangle(point, triangle.a, triangle.b, triangle.c) <= resolution;
}

}  // namespace umbrage::trace
