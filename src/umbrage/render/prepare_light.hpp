#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "umbrage/render/pass_list.hpp"
#include "umbrage/shadow/eye_count.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// How the stencil counts. zPass falls back to z-fail for casters that the eye is too close to (shadow::countAtEye).
enum class Counting { zFail, zPass };

/// A run of indices in LightVolume::indices.
struct IndexRange {
  std::size_t first = 0, count = 0;
};

/// What of a light's volumes is counted together.
struct VolumeGroup {
  int eyeCount = 0;  ///< where the stencil starts
  IndexRange passSides, failSides, failCaps;
};

/// What one light's shadow volumes are made of, ready to be uploaded. Computed without OpenGL.
struct LightVolume {
  Vec4 light{0.0};  ///< homogeneous, relative to the casters' origin
  Counting counting = Counting::zFail;
  std::vector<std::uint32_t> indices;  ///< into doubled vertices (shadow::ShadowVolume)
  /// One, unless a ray may meet more surfaces than 8 bits can count; then as many as 7 bits can, one bit keeping the result.
  std::vector<VolumeGroup> groups;
};

/// Called with the name of each phase when it has ended.
using PhaseEnd = std::function<void(const char*)>;

/// The count of a group is below these: of the only group, or of one among several.
inline constexpr int kWholeStencil = 255, kSharedStencil = 127;

/// `light` and `eye` are relative to the origin of the finder's casters. Fills all of `stats` but its reason.
[[nodiscard]] LightVolume prepareVolume(const shadow::SilhouetteFinder& finder, const Vec4& light, const Vec3& eye,
                                        Counting counting, shadow::LightStats& stats, const PhaseEnd& ended = {});

/// What a plan needs to know of it.
[[nodiscard]] std::vector<GroupPlan> planGroups(const LightVolume& volume);

}  // namespace umbrage::render
