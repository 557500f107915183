#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "umbrage/cut/detail/box_tree.hpp"
#include "umbrage/cut/face_cut.hpp"
#include "umbrage/shadow/caster_set.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::cut::detail {

/// The casters as one light sees them.
struct Casters {
  const shadow::CasterSet& set;
  Vec4 light;                                       ///< homogeneous, relative to CasterSet::origin
  std::vector<std::int8_t> side;                    ///< per triangle: lightSide; 0 hides nothing
  std::vector<float> reach;                         ///< per triangle: its largest coordinate
  std::vector<std::array<std::uint32_t, 3>> edges;  ///< per triangle: of CasterSet::edges
  std::vector<std::uint32_t> borders;               ///< edges at which the number of surfaces before a point changes
  BoxTree borderTree;                               ///< of `borders`
  std::vector<std::uint32_t> hiding;                ///< triangles whose side is not 0
  BoxTree hidingTree;                               ///< of `hiding`

  [[nodiscard]] static Casters of(const shadow::CasterSet& set, const Vec4& light);

  [[nodiscard]] trace::Corners corners(std::uint32_t t) const {
    return {set.corner(t, 0), set.corner(t, 1), set.corner(t, 2)};
  }
};

/// A point as the light projects it onto a face: (u w, v w, w), w > 0 where it lies before the light.
using Projected = Vec3;

/// A face that is cut.
struct Face {
  FaceFrame frame;
  Vec3 up{0.0};                  ///< unit normal on the light's side
  double reach = 0.0;            ///< its largest coordinate when it casts, else 0
  double sine = 1.0;             ///< of the light's elevation over it
  double tolerance = 0.0;        ///< lengths on the face that count as nothing
  Vec4 light{0.0};               ///< homogeneous
  double lightHeight = 0.0;      ///< of the light over its plane; for a direction, the sine of its elevation
  Vec2 lightFlat{0.0};           ///< the light's own place over the face, or its direction's
  std::array<Vec3, 3> inside{};  ///< lines of the face's edges, positive inside

  [[nodiscard]] double height(const Vec3& p) const { return glm::dot(up, p - frame.origin); }
  /// Away from the light onto the face's plane.
  [[nodiscard]] Projected project(const Vec3& p) const;
};

/// Whether a caster rises above a face, as far as the two lie over each other seen from the light. What single precision cannot tell from the face's plane
/// does not, as for rays (trace::LightRays): coplanar and touching surfaces hide nothing of each other.
[[nodiscard]] bool isBefore(const Casters& casters, const Face& face, std::uint32_t triangle);

/// Calls visit(triangle) for the casters that hide `point`, which lies on the face away from borders, until it answers false. `steps` grows by the work it was.
template <class Visit>
void visitHiding(const Casters& casters, const Face& face, const Vec3& point, std::int64_t& steps, Visit&& visit) {
  const Vec3 towards = Vec3(casters.light) - point * casters.light.w;
  const Box3& all = casters.set.bounds;
  const double margin = 0x1p-40 * (glm::length(all.size()) + glm::length(point - all.centre()));
  Vec3 inverse;
  for (int k = 0; k < 3; ++k) inverse[k] = 1.0 / (std::abs(towards[k]) < 1e-280 ? 1e-280 : towards[k]);
  const double end = casters.light.w != 0.0 ? 1.0 : 1e300;
  const auto meets = [&](const Box3& box) {
    const Vec3 s = (box.min - margin - point) * inverse, t = (box.max + margin - point) * inverse;
    const Vec3 low = glm::min(s, t), high = glm::max(s, t);
    return std::max(std::max(low.x, low.y), std::max(low.z, 0.0)) <=
           std::min(std::min(high.x, high.y), std::min(high.z, end));
  };
  casters.hidingTree.visit(meets, [&](std::uint32_t item) {
    const std::uint32_t t = casters.hiding[item];
    ++steps;
    if (!trace::hides(casters.corners(t), point, casters.light) || !isBefore(casters, face, t)) return true;
    return static_cast<bool>(visit(t));
  });
}

}  // namespace umbrage::cut::detail
