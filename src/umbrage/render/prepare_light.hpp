#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "umbrage/shadow/eye_count.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// How the stencil counts. zPass falls back to z-fail for casters that the eye is too close to (shadow::countAtEye).
enum class Counting { zFail, zPass };

/// A run of indices in LightVolume::indices.
struct IndexRange {
  std::size_t first = 0, count = 0;
};

/// What one light's shadow volumes are made of, ready to be uploaded. Computed without OpenGL.
struct LightVolume {
  Vec4 light{0.0};                     ///< homogeneous, relative to the casters' origin
  Counting counting = Counting::zFail;
  int eyeCount = 0;                    ///< where the stencil starts
  std::vector<std::uint32_t> indices;  ///< into doubled vertices (shadow::ShadowVolume)
  IndexRange passSides, failSides, failCaps;
};

/// Called with the name of each phase when it has ended.
using PhaseEnd = std::function<void(const char*)>;

/// `light` and `eye` are relative to casters.origin. Fills all of `stats` but its reason.
[[nodiscard]] LightVolume prepareVolume(const shadow::CasterSet& casters, const Vec4& light, const Vec3& eye,
                                        Counting counting, shadow::LightStats& stats, const PhaseEnd& ended = {});

}  // namespace umbrage::render
