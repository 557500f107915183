#include "umbrage/cut/light_cutter.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/cut/detail/borders.hpp"
#include "umbrage/cut/detail/cone.hpp"
#include "umbrage/cut/detail/cover.hpp"
#include "umbrage/cut/detail/partition.hpp"
#include "umbrage/shadow/facing.hpp"

namespace umbrage::cut {
namespace {

// Of what lengths are computed from: far above the rounding of double precision, far below anything seen.
constexpr double kNothing = 0x1p-44;

}  // namespace

struct LightCutter::Parts {
  std::shared_ptr<const shadow::Geometry> geometry;
  scene::Light light;
  Vec4 towards;  ///< homogeneous, relative to the origin of the surfaces
  detail::Casters casters;
  std::optional<detail::Cone> cone;

  Parts(std::shared_ptr<const shadow::Geometry> g, const scene::Light& l, ConeSides sides)
      : geometry(std::move(g)),
        light(l),
        towards(scene::homogeneous(l, geometry->surfaces.origin)),
        casters(detail::Casters::of(geometry->casters, towards)) {
    if (sides == ConeSides::lines) cone = detail::coneOf(l);
  }

  [[nodiscard]] detail::Face face(std::uint32_t triangle) const {
    const scene::Surfaces& s = geometry->surfaces;
    const std::array<Vec3, 3> corners{s.corner(triangle, 0), s.corner(triangle, 1), s.corner(triangle, 2)};
    const Vec3 towardsLight = scene::towardsLight(towards, corners[0]);
    detail::Face face{.frame = FaceFrame::of(corners)};
    face.up = glm::dot(face.frame.normal, towardsLight) < 0.0 ? -face.frame.normal : face.frame.normal;
    face.reach = s.casts[triangle] != 0 ? trace::reachOf(s, triangle) : 0.0;
    face.lightHeight = glm::dot(face.up, towardsLight);
    // Shadows of casters this far away fall on the face with their rounding, stretched by a low light.
    const double far = glm::length(casters.set.bounds.size()) +
                       (casters.set.bounds.empty() ? 0.0 : glm::length(casters.set.bounds.centre() - corners[0]));
    const double own = std::max(glm::length(corners[1] - corners[0]), glm::length(corners[2] - corners[0]));
    face.sine = std::min(1.0, face.lightHeight / glm::length(towardsLight));
    face.tolerance = kNothing * (own + far / face.sine);
    face.light = towards;
    face.lightFlat = {glm::dot(face.frame.e1, towardsLight), glm::dot(face.frame.e2, towardsLight)};
    const auto& f = face.frame.flatCorners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 along = f[(k + 1) % 3] - f[k];
      const Vec2 inwards = Vec2(-along.y, along.x) / glm::length(along);
      face.inside[k] = Vec3(inwards, -glm::dot(inwards, f[k]));
    }
    return face;
  }

  // A convex face between whose corners the cone has no border.
  [[nodiscard]] bool whollyInside(const detail::Face& face) const {
    return cone->insideIsLit && std::all_of(cone->inwards.begin(), cone->inwards.end(), [&](const Vec3& n) {
             return std::all_of(face.frame.corners.begin(), face.frame.corners.end(),
                                [&](const Vec3& c) { return glm::dot(n, c - Vec3(towards)) >= 0.0; });
           });
  }
};

LightCutter::LightCutter(std::shared_ptr<const shadow::Geometry> geometry, const scene::Light& light, ConeSides cone)
    : parts_(std::make_unique<const Parts>(std::move(geometry), light, cone)) {}
LightCutter::LightCutter(LightCutter&&) noexcept = default;
LightCutter& LightCutter::operator=(LightCutter&&) noexcept = default;
LightCutter::~LightCutter() = default;

std::optional<FaceCut> LightCutter::cut(std::uint32_t triangle, Effort& effort) const {
  const Parts& p = *parts_;
  const detail::Face face = p.face(triangle);
  if (!shadow::visibleSideFacesLight(p.geometry->surfaces, triangle, p.towards, p.towards) || !(face.lightHeight > 0.0))
    return FaceCut(face.frame, face.tolerance, {}, FaceCut::kDark);
  std::int64_t steps = 1;
  if (detail::isCovered(p.casters, face, {face.frame.flatCorners.begin(), face.frame.flatCorners.end()}, steps))
    return FaceCut(face.frame, face.tolerance, {}, FaceCut::kDark);
  detail::ConeLines cone;
  if (p.cone && !p.whollyInside(face)) cone = {detail::linesOn(*p.cone, face, Vec3(p.towards)), p.cone->insideIsLit};
  detail::Borders borders = detail::bordersOn(p.casters, face);
  steps += static_cast<std::int64_t>(borders.borders.size());
  if (!effort.spendSteps(steps)) return std::nullopt;
  return detail::partition(p.casters, face, std::move(borders), cone, effort);
}

}  // namespace umbrage::cut
