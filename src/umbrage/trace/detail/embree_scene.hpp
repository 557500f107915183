#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::trace::detail {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using SceneHandle = std::unique_ptr<RTCSceneTy, ReleaseScene>;

[[nodiscard]] Result<DeviceHandle> openDevice();

/// A tree over some triangles of `surfaces`; primitive i of the tree is triangle chosen[i].
/// The same triangles give the same tree whatever the number of threads.
[[nodiscard]] Result<SceneHandle> buildTree(RTCDevice device, const scene::Surfaces& surfaces,
                                            std::span<const std::uint32_t> chosen);

}  // namespace umbrage::trace::detail

namespace umbrage::trace {

/// What Occlusion hides: the casters in one tree, surfaces that only receive in another (mostly a ground of two triangles).
struct Trees {
  detail::DeviceHandle device;
  detail::SceneHandle casters, receivers;
  std::vector<std::uint32_t> casterTriangle, receiverTriangle;  ///< primitive -> triangle of Surfaces
  bool wide = false;                                            ///< packets of 8 are native here
};

namespace detail {

/// Ray k of a packet, alone.
[[nodiscard]] RTCRay lane(const RTCRay8& rays, int k);

/// tfar of the rays that meet a caster becomes negative. On processors without native packets, ray by ray.
void occluded(const Trees& trees, const int* valid, RTCIntersectContext& context, RTCRay8& rays);

/// All casters with a point within `radius` of `at`, and perhaps a few that are farther; ascending.
[[nodiscard]] std::vector<std::uint32_t> castersNear(const Trees& trees, const Vec3& at, double radius);

}  // namespace detail
}  // namespace umbrage::trace
