#include "umbrage/radiosity/form_factor.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "umbrage/base/check.hpp"

namespace umbrage::radiosity {
namespace {

constexpr std::size_t kMostCorners = 8;

/// A polygon seen from a point, cut off at the point's horizon.
struct Cut {
  std::array<Vec3, kMostCorners + 1> corner;
  std::size_t count = 0;
  void add(const Vec3& v) { corner[count++] = v; }
};

Cut aboveHorizon(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon) {
  Cut cut;
  Vec3 last = polygon.back() - point;
  double lastHeight = glm::dot(last, normal);
  for (const Vec3& corner : polygon) {
    const Vec3 here = corner - point;
    const double height = glm::dot(here, normal);
    if ((height > 0.0) != (lastHeight > 0.0)) cut.add(last + lastHeight / (lastHeight - height) * (here - last));
    if (height > 0.0) cut.add(here);
    last = here, lastHeight = height;
  }
  return cut;
}

}  // namespace

double polygonFactor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon) {
  UMBRAGE_CHECK(polygon.size() >= 3 && polygon.size() <= kMostCorners, "corners");
  const Cut cut = aboveHorizon(point, normal, polygon);
  double sum = 0.0;
  for (std::size_t i = 0; i < cut.count; ++i) {
    const Vec3 &a = cut.corner[i], &b = cut.corner[i + 1 < cut.count ? i + 1 : 0];
    const Vec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    // Small angles are lost in an arc cosine, not here.
    if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(normal, across) / sine;
  }
  return std::abs(sum) / (2.0 * std::numbers::pi);
}

}  // namespace umbrage::radiosity
