#include "umbrage/math/predicates.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage {
namespace {

Vec3 nearestOnEdge(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double square = glm::dot(along, along);
  const double s = square > 0.0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
  return a + s * along;
}

double distanceToEdge(const Vec3& point, const Vec3& a, const Vec3& b) {
  return glm::length(nearestOnEdge(point, a, b) - point);
}

bool isOver(const Vec3& foot, const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::dot(glm::cross(b - a, foot - a), normal) >= 0.0 && glm::dot(glm::cross(c - b, foot - b), normal) >= 0.0 &&
         glm::dot(glm::cross(a - c, foot - c), normal) >= 0.0;
}

}  // namespace

int lightSide(const Vec3& a, const Vec3& b, const Vec3& c, const Vec4& light) {
  const Vec3 ac = c - a;
  const Vec3 al = Vec3(light) - a * light.w;
  const Vec3 ab = b - a;
  const double volume =
      (ac.y * al.z - ac.z * al.y) * ab.x + (ac.z * al.x - ac.x * al.z) * ab.y + (ac.x * al.y - ac.y * al.x) * ab.z;
  // Each of the six products below carries at most 7 rounding errors of 2^-53 by the time it stands in the sum. Without this bound
  // a light in a corner of a triangle would see noise instead of 0.
  const Vec3 c1 = glm::abs(ac), l1 = glm::abs(al), b1 = glm::abs(ab);
  const double size =
      (c1.y * l1.z + c1.z * l1.y) * b1.x + (c1.z * l1.x + c1.x * l1.z) * b1.y + (c1.x * l1.y + c1.y * l1.x) * b1.z;
  if (std::abs(volume) <= 0x1p-50 * size) return 0;
  return volume > 0.0 ? +1 : -1;
}

bool liesInPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double farthest = std::max({glm::length(a - point), glm::length(b - point), glm::length(c - point)});
  return std::abs(glm::dot(normal, a - point)) <= 0x1p-25 * farthest * glm::length(normal);
}

double distanceToTriangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  if (length > 0.0) {
    const double height = glm::dot(point - a, normal / length);
    const Vec3 foot = point - height * (normal / length);
    if (isOver(foot, normal, a, b, c)) return std::abs(height);
  }
  return std::min({distanceToEdge(point, a, b), distanceToEdge(point, b, c), distanceToEdge(point, c, a)});
}

Vec3 nearestOnTriangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  if (square > 0.0) {
    const Vec3 foot = point - (glm::dot(point - a, normal) / square) * normal;
    if (isOver(foot, normal, a, b, c)) return foot;
  }
  Vec3 best = nearestOnEdge(point, a, b);
  for (const Vec3& other : {nearestOnEdge(point, b, c), nearestOnEdge(point, c, a)})
    if (glm::distance(other, point) < glm::distance(best, point)) best = other;
  return best;
}

}  // namespace umbrage
