#pragma once

#include <functional>

#include "umbrage/math/box.hpp"
#include "umbrage/raster/patch.hpp"
#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::raster {

/// Calls fn(triangle, +1 or -1) for every caster surface between the eye and the light, as countAtEye counts it.
/// `side`: Silhouette::side, for `light`.
void visitAtEye(const shadow::CasterSet& casters, std::span<const std::int8_t> side, const Vec4& light,
                const PixelSpace& space, const Corners& corners,
                const std::function<void(std::uint32_t triangle, int sign)>& fn);

/// The caster surfaces between the eye and the light, by the rule the sides of the volumes count with. Exact, even where the eye lies on a side
/// or on a caster: there the sides and this count agree on where it is.
/// `corners`: the positions of `casters` as `space` maps them, and the light of `silhouette`.
[[nodiscard]] int countAtEye(const shadow::CasterSet& casters, const shadow::Silhouette& silhouette,
                             const PixelSpace& space, const Corners& corners);

/// Makes patches of what bounds shadow volumes. The weight of each is what the count of caster surfaces towards the light changes by where the way
/// from the eye crosses it.
class SideMaker {
 public:
  /// `room` holds the eye and everything whose shadow is asked for; `light` and it are relative to the origin of the casters.
  /// REQUIRES: outlived by all but `room`.
  SideMaker(const PixelSpace& space, const Corners& corners, const shadow::CasterSet& casters, const Vec4& light,
            Box3 room);

  /// The side of a volume. False where nothing of it can be seen in the room.
  [[nodiscard]] bool side(const shadow::SilhouetteEdge& edge, Patch& out) const;
  /// A caster, for those that the picture does not show though the way from the eye crosses them: from the lit side into its shadow, or back.
  /// `lightSide`: Silhouette::side. False where it does not count.
  [[nodiscard]] bool cap(std::uint32_t triangle, int lightSide, Patch& out) const;

 private:
  const PixelSpace& space_;
  const Corners& corners_;
  const shadow::CasterSet& casters_;
  const Vec4& light_;
  Box3 room_;  ///< a little larger than the one given
};

}  // namespace umbrage::raster
