#include "umbrage/render/large_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "umbrage/math/predicates.hpp"

namespace umbrage::render {
namespace {

// Sine of the angle at which the eye sees the plane. Measured over the conformance scenes: from 2^-20 to 2^-11 not a pixel
// changes; with 2^-8 some lose the precision they need, and with none at all the rounding of the corners is magnified.
constexpr double kFlatSine = 0x1p-14;

// The corners of a triangle as seen from the eye.
struct Seen {
  Vec3 a, b, c;
  double nearest, farthest;  ///< depths

  Seen(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& forward) : a(p), b(q), c(r) {
    std::tie(nearest, farthest) = std::minmax({glm::dot(a, forward), glm::dot(b, forward), glm::dot(c, forward)});
  }

  [[nodiscard]] bool isLarge() const {
    if (farthest <= 0.0) return false;  // not seen
    const double extent = std::max({glm::dot(b - a, b - a), glm::dot(c - a, c - a), glm::dot(c - b, c - b)});
    return nearest <= 0.0 || extent > nearest * nearest;
  }

  [[nodiscard]] Vec4f plane() const {
    const Vec3 normal = glm::cross(b - a, c - a);
    const double height = glm::dot(normal, a), size = glm::length(normal) * glm::length(a);
    if (std::abs(height) <= kFlatSine * size) return {0.0f, 0.0f, 0.0f, -1.0f};
    const double most = nearest > 0.0 ? 1.0 / nearest : double(std::numeric_limits<float>::max());
    return Vec4f(Vec3f(normal / height), static_cast<float>(most));
  }
};

}  // namespace

Arrangement arrange(const scene::Surfaces& surfaces, const Vec3& eye, const Vec3& forward) {
  Arrangement out;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Vec3 a = surfaces.corner(t, 0), b = surfaces.corner(t, 1), c = surfaces.corner(t, 2);
    if (liesInPlane(a, b, c, eye)) {
      out.edgeOn.push_back(t);
      continue;
    }
    const Seen seen(a - eye, b - eye, c - eye, forward);
    if (seen.isLarge()) out.large.push_back({seen.plane(), t, {}});
  }
  return out;
}

}  // namespace umbrage::render
