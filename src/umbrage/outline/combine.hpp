#pragma once

#include <optional>

#include "umbrage/outline/casters.hpp"
#include "umbrage/outline/region.hpp"

namespace umbrage::outline {

/// What `a` has and `b` has not. Corners as in shadowsOnPlane: within 2^-29 of the size of both; slivers thinner than two steps of that grid
/// are left out.
[[nodiscard]] Region without(const Region& a, const Region& b);
/// What both have.
[[nodiscard]] Region common(const Region& a, const Region& b);
/// What one of them has.
[[nodiscard]] Region together(const std::vector<Region>& regions);

/// All that is nearer to a region than `distance`, corners rounded: within `tolerance` of it, and never farther.
/// REQUIRES: distance > 0, tolerance > 0.
[[nodiscard]] Region grown(const Region& region, double distance, double tolerance);

/// Does the region hold the point? Borders belong to either side.
[[nodiscard]] bool covers(const Region& region, const Vec2& point);
/// How far a point is from a region; 0 within it, infinity where it is empty.
[[nodiscard]] double distanceTo(const Region& region, const Vec2& point);

/// The shadow of `added` on the plane at height 0 where nothing of `standing` casts one already; see shadowsOnPlane for its laws. Parts count their
/// heights from the plane and end there (aboveHeight). `within`: only this part of the plane.
/// 1. What `added` and `standing` share casts nothing new, whatever rounding does.
[[nodiscard]] Region newShadow(const std::vector<CasterPart>& added, const std::vector<CasterPart>& standing,
                               const Vec2& slope, const std::optional<Region>& within = std::nullopt);

/// The area of newShadow on regions that do not overlap, all together. Of regions of few corners each it takes far less time than of one of many: the
/// time of clipping grows with the square of the corners beside one another (inPieces).
[[nodiscard]] double newShadowArea(const std::vector<CasterPart>& added, const std::vector<CasterPart>& standing,
                                   const Vec2& slope, const std::vector<Region>& regions);

/// A region cut by parallels to the axes into pieces of about so many corners, where it has more; where cuts would meet more than a quarter of its edges
/// it stays whole. REQUIRES: corners >= 16.
[[nodiscard]] std::vector<Region> inPieces(const Region& region, std::size_t corners);

/// What of the parts lies above a height, which becomes 0.
[[nodiscard]] std::vector<CasterPart> aboveHeight(const std::vector<CasterPart>& parts, double height);

}  // namespace umbrage::outline
