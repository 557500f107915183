// The dual space of planes. A plane n.x + d = 0 is the point (n, d); a homogeneous light l is the hyperplane through the origin
// with normal l, and the plane faces the light by the side of the hyperplane that its point lies on.
// Source: Hertzmann and Zorin, Illustrating smooth surfaces, 2000; hextree: Geometry of Real Time Shadows.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/shadow/caster_set.hpp"

namespace umbrage::shadow {

/// (n, d) with |n| = 1 and d in units of the casters' radius from their centre: every component within -1..1.
using DualPoint = std::array<float, 4>;

inline DualPoint operator-(const DualPoint& p) { return {-p[0], -p[1], -p[2], -p[3]}; }

/// Where the casters are: what dual points and lights are measured against.
struct DualFrame {
  Vec3 centre{0.0};
  double radius = 0.0;  ///< no corner is farther from the centre
};
[[nodiscard]] DualFrame dualFrame(const CasterSet& casters);

/// The light with |xyz| + |w| = 1; all zero when nothing can be told for it.
[[nodiscard]] DualPoint dualLight(const DualFrame& frame, const Vec4& light);

/// A dual point p of a triangle and a dual light u: |p.u| > kDoubt, computed in single precision in any order, proves that
/// lightSide(triangle, light) is the sign of p.u.
///
/// Let V be the exact volume that lightSide computes, N = |b-a| x |c-a| without cancellation, a the first corner, m = |l - centre| +
/// radius w. lightSide returns the sign of V when |V| >= 2^-48 N.|l - a w|, six times the rounding errors it allows for, and that is
/// met by |V| >= 2^-48 |N| m. With the length |n| of the cross product at least 2^-22 |N| (`steady`) this is |V|/(|n| m) >= 2^-26.
/// p.u differs from V/(|n| m) by at most 2^-29 (the cross product) + 4.5 * 2^-25 (p and u rounded) + 14 * 2^-25 (four products and three
/// sums of terms whose absolute values sum to at most sqrt(3), which also covers corners of boxes). All together: below 2^-20.
inline constexpr float kDoubt = 0x1p-20f;

/// The dual point of a triangle; nothing can be told of a sliver (`steady` false).
struct DualPlane {
  DualPoint point{};
  bool steady = false;
};
[[nodiscard]] DualPlane dualPlane(const CasterSet& casters, const DualFrame& frame, std::uint32_t triangle);

/// An edge as a segment between two dual points: its multiplicity is `sign` x (sgn p0.u - sgn p1.u), halved for edges of one face
/// (whose p1 is -p0) and for those of convex solids of which only lit faces count.
struct DualEdge {
  std::array<DualPoint, 2> point;
  std::uint32_t tag;  ///< edge and how it is counted
};

// How a tag is laid out.
inline constexpr std::uint32_t kTagNegative = 1u << 31;  ///< `sign` is -1
inline constexpr std::uint32_t kTagSingle = 1u << 30;    ///< one face
inline constexpr std::uint32_t kTagConvex = 1u << 29;    ///< of a convex solid
inline constexpr std::uint32_t kTagPartial =
    1u << 28;  ///< a part of an edge of more than two faces: only the predicate knows the sum
inline constexpr std::uint32_t kTagEdge = kTagPartial - 1;

/// Every edge of a caster set in dual space. The multiplicity is a sum over faces, so an edge of many faces is several
/// segments, and where none of them is crossed by the light's hyperplane, the sum is zero.
struct DualEdges {
  DualFrame frame;
  std::vector<DualEdge> segments;
  std::vector<std::uint32_t> always;  ///< edges that must be asked every time, since a face is a sliver
};
/// 1. The same in the same order, whatever the number of threads.
/// REQUIRES: fewer than 2^28 edges.
[[nodiscard]] DualEdges dualEdges(const CasterSet& casters, unsigned threads);

}  // namespace umbrage::shadow
