#pragma once

#include <memory>
#include <vector>

#include "umbrage/shadow/technique.hpp"
#include "umbrage/techniques/cpu/detail/facing_points.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::techniques::detail {

/// Masks by rays from visible surface points to the light.
class Rays {
 public:
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] static Result<Rays> build(const std::shared_ptr<const shadow::Geometry>& geometry);

  [[nodiscard]] const trace::Occlusion& occlusion() const { return occlusion_; }
  /// `seen`: what the camera sees of the geometry.
  [[nodiscard]] Result<shadow::LightMask> mask(const scene::Camera& camera, const scene::Light& light,
                                               const shadow::SurfaceBuffer& seen) const;

 private:
  explicit Rays(trace::Occlusion occlusion);
  trace::Occlusion occlusion_;
  std::vector<Plane> planes_;
};

}  // namespace umbrage::techniques::detail
