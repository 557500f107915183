#pragma once

#include <array>
#include <span>
#include <vector>

#include "umbrage/shadow/light_samples.hpp"
#include "umbrage/trace/light_rays.hpp"

namespace umbrage::radiosity {

/// A point of a surface, both sides of it.
struct SurfacePoint {
  Vec3 point;              ///< relative to the origin of the surfaces, on the triangle
  Vec3 normal;             ///< unit; side 0 is the one it points to, side 1 the other
  std::uint32_t triangle;  ///< of the surfaces
};

/// What of a light of the scene is seen from points of surfaces.
/// The light keeps the law of all techniques: no attenuation, brightness is colour x intensity x cosine to its centre x the part of it that is seen.
/// Const afterwards; may be asked in many threads at once. REQUIRES: outlived by the Occlusion.
class DirectLight {
 public:
  /// `samples`: points of the light where it has an extent. `room`: see shadow::lightSamples.
  DirectLight(const trace::Occlusion& occlusion, const scene::Light& light, std::size_t samples, const Box3& room);

  /// The part of the light, in [0, 1], that each side of each point sees.
  void seen(std::span<const SurfacePoint> points, std::span<std::array<double, 2>> parts) const;
  /// What falls on a point of which `parts` are known, per side.
  [[nodiscard]] std::array<Vec3, 2> received(const SurfacePoint& point, const std::array<double, 2>& parts) const;

 private:
  void seenByEight(std::span<const SurfacePoint> points, std::span<std::array<double, 2>> parts) const;

  const trace::Occlusion& occlusion_;
  Vec3 brightness_;
  Vec4 centre_;
  std::vector<shadow::LightSample> samples_;
  std::vector<trace::LightRays> rays_;
};

}  // namespace umbrage::radiosity
