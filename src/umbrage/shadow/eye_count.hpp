#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/shadow/volume.hpp"

namespace umbrage::shadow {

/// What z-pass needs to be right for an eye inside shadow volumes.
struct EyeCount {
  /// Caster surfaces between the eye and the light, without those of `byZFail`; the stencil starts from it.
  int count = 0;
  std::vector<std::uint32_t> crossed;  ///< by countAtEye: these surfaces, caster triangles
  /// Per component: 1 when the eye is too close to one of its side quads or faces for z-pass.
  std::vector<std::uint8_t> byZFail;
  std::size_t byZFailCount = 0;
  double threshold = 0.0;  ///< the distance below which a component goes to byZFail, in scene units
};

/// Per component: 1 when the eye is closer to one of its sides (reaching to infinity) than EyeCount::threshold.
[[nodiscard]] std::vector<std::uint8_t> sidesAtEye(const CasterSet& casters, const Silhouette& silhouette,
                                                   const Vec3& eye);

/// Per component: 1 when it may lie between the eye and the light, or have a side or a face nearer to the eye than EyeCount::threshold, by its box alone.
/// Law: every component of sidesAtEye and touchesEye is among them, and the eye is in the volume of no other.
[[nodiscard]] std::vector<std::uint8_t> boxesBetween(const CasterSet& casters, const Vec4& light, const Vec3& eye);

/// The distance below which a component goes to byZFail.
[[nodiscard]] double eyeThreshold(const CasterSet& casters, const Vec4& light, const Vec3& eye);

/// As countAtEye, without counting.
[[nodiscard]] EyeCount touchesEye(const CasterSet& casters, const Silhouette& silhouette, const Vec3& eye);

/// Whether the eye lies on a side (reaching to infinity) as far as single precision can tell. Nothing is seen of such a side, but its depth,
/// interpolated from corners around the eye, may come out anywhere: z-fail must leave it out.
[[nodiscard]] bool liesOnSide(const CasterSet& casters, const SilhouetteEdge& edge, const Vec4& light, const Vec3& eye);

/// The plan that counts nothing: every component that might lie between the eye and the light, by its box, or has a side or a face at the eye
/// goes to byZFail; the eye is outside the volumes of all others.
/// Source: the choice by the near-clip volume, which without a near plane is the segment from the eye to the light; C. Everitt and M. Kilgard, 2002.
[[nodiscard]] EyeCount chooseAtEye(const CasterSet& casters, const Silhouette& silhouette, const Vec3& eye);

/// With depth clamp a perspective view clips volumes only at the eye itself, so what z-pass misses is one number for the whole
/// screen. It goes wrong only when the eye (nearly) touches a side quad or a caster itself; such components are told to be
/// drawn by z-fail.
/// `eye` is relative to the origin of the casters. CAVEAT: for perspective cameras only.
/// Source: verified in this project against ray tracing; compare Usta, Scandolo, Billeter, Eisemann et al., 2019.
[[nodiscard]] EyeCount countAtEye(const CasterSet& casters, const Silhouette& silhouette, const Vec3& eye);

}  // namespace umbrage::shadow
