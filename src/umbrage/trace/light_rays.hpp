#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/scene/light.hpp"
#include "umbrage/trace/lanes.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::trace {

/// Eight points on surfaces, relative to the origin of the surfaces.
struct SurfacePoints8 {
  Vec3Lanes position;  ///< on the triangle's plane
  Vec3Lanes normal;    ///< unit, on the light's side
  Lanes precision;     ///< shadow borders may be displaced by this much along the surface, in scene units
  Lanes reach;         ///< the largest coordinate of the triangle it lies on when that casts, else 0
  std::array<std::uint32_t, 8> triangle;  ///< the one the point lies on; shadow::kNoTriangle: none
  std::uint32_t active = 0;               ///< bit k: point k is there
};

/// Shadow rays towards one light: whether the segment from a surface point to the light meets a caster.
///
/// 1. A surface does not shadow itself, nor do surfaces that cover the point and are nearer to it than the rounding of either:
///    coincident and coplanar ones.
/// 2. A caster whose plane holds the light hides nothing; one near the light or touching it is decided in double precision.
/// 3. Points are lifted off their surface by the resolution, which displaces shadow borders by resolution / tan(elevation of
///    the light). Where that is more than the asked precision, every candidate is decided in double precision.
/// REQUIRES: outlived by its Occlusion.
class LightRays {
 public:
  LightRays(const Occlusion& occlusion, const scene::Light& light);

  /// Packets that are best asked for together: their rays are prepared side by side.
  static constexpr std::size_t kBatch = 8;

  /// hidden[i], bit k: point k of points[i] is hidden from the light.
  /// REQUIRES: as many `hidden` as `points`, at most kBatch; each active point's normal does not point away from the light.
  void hidden(std::span<const SurfacePoints8> points, std::span<std::uint32_t> hidden) const;
  /// The same for one packet.
  [[nodiscard]] std::uint32_t hidden(const SurfacePoints8& points) const;

  /// The light, homogeneous and relative to the origin of the surfaces.
  [[nodiscard]] const Vec4& light() const { return light_; }

  /// A caster near the light: at least so far from it.
  struct Near {
    std::uint32_t triangle;
    double distance;
  };

 private:
  [[nodiscard]] std::uint32_t hiddenNearLight(const SurfacePoints8& points) const;

  const Occlusion& occlusion_;
  Vec4 light_;
  double cut_ = 0.0;             ///< rays end this far from the light, plus a part of their length
  std::vector<Near> nearLight_;  ///< casters that the shortened rays may miss, the nearest first
};

}  // namespace umbrage::trace
