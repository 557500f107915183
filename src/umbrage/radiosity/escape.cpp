#include <cmath>
#include <limits>
#include <numbers>

#include "umbrage/radiosity/detail/escape.hpp"
#include "umbrage/shadow/surface_buffer.hpp"

namespace umbrage::radiosity::detail {
namespace {

constexpr std::uint32_t kRays = 256;

/// The digits of a number in a base, mirrored at the point.
double mirrored(std::uint32_t number, std::uint32_t base) {
  double value = 0.0, digit = 1.0;
  for (; number != 0; number /= base) {
    digit /= base;
    value += digit * double(number % base);
  }
  return value;
}

/// Evenly spread over the triangle and, by cosine, over the directions. Source: J. H. Halton, 1960.
void aim(const Emitter& e, std::uint32_t i, std::size_t lane, trace::Rays8& rays) {
  const double s = std::sqrt(mirrored(i, 2)), t = mirrored(i, 3);
  const Vec3 from = (1.0 - s) * e.corner[0] + s * (1.0 - t) * e.corner[1] + s * t * e.corner[2] + e.lift * e.normal;
  const Vec3 u = glm::normalize(e.corner[1] - e.corner[0]), v = glm::cross(e.normal, u);
  const double radius = std::sqrt(mirrored(i, 5)), angle = 2.0 * std::numbers::pi * mirrored(i, 7);
  const Vec3 along = radius * (std::cos(angle) * u + std::sin(angle) * v) + std::sqrt(1.0 - radius * radius) * e.normal;
  rays.fromX[lane] = static_cast<float>(from.x), rays.fromY[lane] = static_cast<float>(from.y);
  rays.fromZ[lane] = static_cast<float>(from.z);
  rays.directionX[lane] = static_cast<float>(along.x), rays.directionY[lane] = static_cast<float>(along.y);
  rays.directionZ[lane] = static_cast<float>(along.z);
  rays.length[lane] = std::numeric_limits<float>::infinity();
}

}  // namespace

double escaping(const trace::Occlusion& occlusion, const Emitter& emitter) {
  std::uint32_t lost = 0;
  for (std::uint32_t first = 0; first < kRays; first += 8) {
    trace::Rays8 rays{};
    for (std::uint32_t k = 0; k < 8; ++k) aim(emitter, first + k + 1, k, rays);
    rays.active = 0xff;
    for (const std::uint32_t met : occlusion.nearest(rays).triangle) lost += met == shadow::kNoTriangle;
  }
  return double(lost) / kRays;
}

}  // namespace umbrage::radiosity::detail
