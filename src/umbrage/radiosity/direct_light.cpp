#include "umbrage/radiosity/direct_light.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/base/check.hpp"
#include "umbrage/shadow/surface_buffer.hpp"

namespace umbrage::radiosity {
namespace {

/// A light that rises less over a surface rakes along it (see shadow::visibleSideFacesLight).
constexpr double kRaking = 0x1p-20;

}  // namespace

DirectLight::DirectLight(const trace::Occlusion& occlusion, const scene::Light& light, std::size_t samples,
                         const Box3& room)
    : occlusion_(occlusion),
      brightness_(light.colour * light.intensity),
      centre_(scene::homogeneous(light, occlusion.surfaces().origin)),
      samples_(shadow::lightSamples(light, 0, scene::isArea(light) ? std::max<std::size_t>(1, samples) : 1, room)) {
  rays_.reserve(samples_.size());
  for (const shadow::LightSample& sample : samples_) rays_.emplace_back(occlusion, sample.light);
}

void DirectLight::seen(std::span<const SurfacePoint> points, std::span<std::array<double, 2>> parts) const {
  UMBRAGE_CHECK(points.size() == parts.size(), "parts of every point");
  for (std::size_t i = 0; i < points.size(); i += 8) {
    const std::size_t count = std::min<std::size_t>(8, points.size() - i);
    seenByEight(points.subspan(i, count), parts.subspan(i, count));
  }
}

void DirectLight::seenByEight(std::span<const SurfacePoint> points, std::span<std::array<double, 2>> parts) const {
  const scene::Surfaces& surfaces = occlusion_.surfaces();
  trace::SurfacePoints8 packet{};
  packet.triangle.fill(shadow::kNoTriangle);
  for (std::size_t k = 0; k < points.size(); ++k) {
    packet.position.set(k, points[k].point);
    packet.triangle[k] = points[k].triangle;
    packet.reach[k] = surfaces.casts[points[k].triangle] != 0 ? double(occlusion_.reach(points[k].triangle)) : 0.0;
    // No border need be nearer than this: the samples themselves lie farther inside.
    packet.precision[k] = 64.0 * trace::resolution(std::max(packet.reach[k], trace::largest(points[k].point)));
    parts[k] = {0.0, 0.0};
  }
  std::array<double, 8> weights{};
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    packet.active = 0;
    std::array<std::size_t, 8> side{};
    std::array<double, 8> weight{};
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec3 towards = scene::towardsLight(rays_[s].light(), points[k].point);
      const double height = glm::dot(points[k].normal, towards);
      weight[k] = samples_[s].weight(points[k].point + surfaces.origin);
      weights[k] += weight[k];
      if (std::abs(height) <= kRaking * glm::length(towards)) continue;
      if (!scene::insideCone(samples_[s].light, points[k].point + surfaces.origin)) continue;
      side[k] = height > 0.0 ? 0 : 1;
      packet.normal.set(k, height > 0.0 ? points[k].normal : -points[k].normal);
      packet.active |= 1u << k;
    }
    if (packet.active == 0) continue;
    const std::uint32_t lit = packet.active & ~rays_[s].hidden(packet);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (trace::hasLane(lit, k)) parts[k][side[k]] += weight[k];
  }
  for (std::size_t k = 0; k < points.size(); ++k)
    for (double& part : parts[k]) part = weights[k] > 0.0 ? part / weights[k] : 0.0;
}

std::array<Vec3, 2> DirectLight::received(const SurfacePoint& point, const std::array<double, 2>& parts) const {
  const Vec3 towards = scene::towardsLight(centre_, point.point);
  const double length = glm::length(towards);
  const double cosine = length > 0.0 ? std::abs(glm::dot(point.normal, towards)) / length : 0.0;
  return {parts[0] * cosine * brightness_, parts[1] * cosine * brightness_};
}

}  // namespace umbrage::radiosity
