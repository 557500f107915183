#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "umbrage/shadow/technique.hpp"
#include "umbrage/techniques/cpu/detail/facing_points.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::techniques::detail {

/// Who decides which surface points are hidden from a light, as trace::LightRays::hidden does; in many threads at once.
using Hidden = std::function<void(std::span<const trace::SurfacePoints8> points, std::span<std::uint32_t> hidden)>;

/// Masks by rays from visible surface points to the light.
class Rays {
 public:
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] static Result<Rays> build(const std::shared_ptr<const shadow::Geometry>& geometry);

  [[nodiscard]] const trace::Occlusion& occlusion() const { return occlusion_; }
  /// `seen`: what the camera sees of the geometry.
  [[nodiscard]] Result<shadow::LightMask> mask(const scene::Camera& camera, const scene::Light& light,
                                               const shadow::SurfaceBuffer& seen) const;
  /// The same points, with somebody else's word for the rays'.
  [[nodiscard]] Result<shadow::LightMask> mask(const scene::Camera& camera, const scene::Light& light,
                                               const shadow::SurfaceBuffer& seen, const Hidden& hidden) const;

 private:
  explicit Rays(trace::Occlusion occlusion);
  trace::Occlusion occlusion_;
  std::vector<Plane> planes_;
};

/// What a camera sees by rays, kept until it is asked of another.
class RaySight {
 public:
  /// REQUIRES: always the same rays, but for forget() between.
  [[nodiscard]] Result<void> see(const Rays& rays, const scene::Camera& camera);
  void forget() { camera_.reset(); }
  [[nodiscard]] bool isOf(const scene::Camera& camera) const { return camera_ == camera; }
  [[nodiscard]] const shadow::SurfaceBuffer& surface() const { return surface_; }

 private:
  std::optional<scene::Camera> camera_;
  shadow::SurfaceBuffer surface_;
};

}  // namespace umbrage::techniques::detail
