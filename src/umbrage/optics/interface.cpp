#include "umbrage/optics/interface.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::optics {

std::optional<Vec3> refracted(const Vec3& direction, const Vec3& normal, double from, double to) {
  const double ratio = from / to, cosine = -glm::dot(direction, normal);
  const double square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
  if (square < 0.0) return std::nullopt;
  return glm::normalize(ratio * direction + (ratio * cosine - std::sqrt(square)) * normal);
}

double reflectance(const Vec3& direction, const Vec3& normal, double from, double to) {
  const double cosine = std::clamp(-glm::dot(direction, normal), 0.0, 1.0);
  const double square = 1.0 - from * from / (to * to) * (1.0 - cosine * cosine);
  if (square <= 0.0) return 1.0;
  const double beyond = std::sqrt(square);
  const double across = (from * cosine - to * beyond) / (from * cosine + to * beyond);
  const double along = (to * cosine - from * beyond) / (to * cosine + from * beyond);
  return 0.5 * (across * across + along * along);
}

}  // namespace umbrage::optics
