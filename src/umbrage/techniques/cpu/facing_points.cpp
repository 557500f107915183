#include <algorithm>
#include <cmath>
#include <variant>

#include "umbrage/shadow/facing.hpp"
#include "umbrage/techniques/cpu/detail/facing_points.hpp"

namespace umbrage::techniques::detail {
namespace {

// Shadow borders may be displaced by this part of a pixel's width where a ray's start is lifted off its surface.
constexpr double kPixelPart = 0.125;
// Below this sine between view and surface the plane says less about the depth than the surface buffer does.
constexpr double kEdgeOn = 1e-4;
// Far above what double arithmetic loses and what visibleSideFacesLight takes as edge-on (2^-20).
constexpr double kSurely = 0x1p-18;

}  // namespace

std::vector<Plane> planesOf(const scene::Surfaces& surfaces) {
  std::vector<Plane> planes(surfaces.triangles.size() + 1, Plane{Vec3(0.0), 0.0, 0.0});
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Vec3 normal = surfaces.normal(t);
    const double length = glm::length(normal);
    const Vec3 unit = length > 0.0 ? normal / length : Vec3(0.0);
    planes[t] = {unit, glm::dot(unit, surfaces.corner(t, 0)),
                 surfaces.casts[t] != 0 ? trace::reachOf(surfaces, t) : 0.0};
  }
  return planes;
}

FacingPoints::FacingPoints(const scene::Surfaces& surfaces, const std::vector<Plane>& planes,
                           const scene::Camera& camera, const scene::Light& light)
    : surfaces_(surfaces),
      planes_(planes),
      light_(light),
      towards_(scene::homogeneous(light, surfaces.origin)),
      eye_(camera.eye - surfaces.origin),
      rays_(scene::pixelRays(camera)),
      precision_(kPixelPart * std::min(glm::length(rays_.dx), glm::length(rays_.dy))) {
  const double reach = glm::length(glm::max(glm::abs(surfaces.bounds.min), glm::abs(surfaces.bounds.max)));
  sureOfEye_ = kSurely * (glm::length(eye_) + reach);
  sureOfLight_ = kSurely * (glm::length(Vec3(towards_)) + towards_.w * reach);
  for (std::size_t k = 0; k < 8; ++k) step_.set(k, double(k & 3) * rays_.dx + double(k >> 2) * rays_.dy);
}

bool FacingPoints::place(const Seen8& seen, int x, int y, Faces& faces, trace::SurfacePoints8& points) const {
  if (seen.triangle != faces.triangle) {
    faces.triangle = seen.triangle;
    lookAt(faces);
    faces.lit = litLanes(faces);
  }
  points.active = faces.lit;
  if (points.active == 0) return false;
  placePoints(seen, faces, x, y, points);
  if (std::holds_alternative<scene::SpotLight>(light_.shape)) points.active = insideCone(points);
  return points.active != 0;
}

UMBRAGE_VECTOR_UNITS void FacingPoints::lookAt(Faces& faces) const {
  alignas(64) trace::Lanes offset;
  const std::size_t none = planes_.size() - 1;
  for (std::size_t k = 0; k < 8; ++k) {
    const Plane& plane = planes_[std::min<std::size_t>(faces.triangle[k], none)];
    faces.normal.set(k, plane.normal);
    offset[k] = plane.offset;
    faces.reach[k] = plane.reach;
  }
  const Vec3 eye = eye_;
  const Vec4 light = towards_;
  for (std::size_t k = 0; k < 8; ++k) {
    const Vec3 normal = faces.normal[k];
    const double eyeHeight = glm::dot(normal, eye) - offset[k];
    const double lightHeight = glm::dot(normal, Vec3(light)) - offset[k] * light.w;
    const double side = eyeHeight > 0.0 ? 1.0 : -1.0;
    faces.normal.set(k, side * normal);
    faces.eyeHeight[k] = std::abs(eyeHeight);
    faces.lightHeight[k] = side * lightHeight;
  }
}

// visibleSideFacesLight, told by the planes wherever they leave no doubt: it costs a fraction, and differs nowhere, since it
// decides only heights of more than kSurely of the lengths they are computed from.
UMBRAGE_VECTOR_UNITS std::uint32_t FacingPoints::litLanes(const Faces& faces) const {
  const double sureOfEye = sureOfEye_, sureOfLight = sureOfLight_;
  const std::uint32_t sure = trace::lanesWhere(
      [&](std::size_t k) { return faces.eyeHeight[k] > sureOfEye && std::abs(faces.lightHeight[k]) > sureOfLight; });
  const std::uint32_t lit = sure & trace::lanesWhere([&](std::size_t k) { return faces.lightHeight[k] > 0.0; });
  return sure == 0xffu ? lit : lit | exactlyLit(faces, ~sure);
}

std::uint32_t FacingPoints::exactlyLit(const Faces& faces, std::uint32_t lanes) const {
  std::uint32_t lit = 0, last = shadow::kNoTriangle;
  bool lastIsLit = false;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::uint32_t triangle = faces.triangle[k];
    if (!trace::hasLane(lanes, k) || triangle == shadow::kNoTriangle || faces.normal[k] == Vec3(0.0)) continue;
    if (triangle != last) lastIsLit = shadow::visibleSideFacesLight(surfaces_, triangle, Vec4(eye_, 1.0), towards_);
    last = triangle;
    lit |= static_cast<std::uint32_t>(lastIsLit) << k;
  }
  return lit;
}

// The points that the pixels' centres show, in double precision.
UMBRAGE_VECTOR_UNITS void FacingPoints::placePoints(const Seen8& seen, const Faces& faces, int x, int y,
                                                    trace::SurfacePoints8& points) const {
  const Vec3 corner = rays_.through(x + 0.5, y + 0.5), eye = eye_;
  const double precision = precision_;
  for (std::size_t k = 0; k < 8; ++k) {
    const Vec3 direction = corner + step_[k];
    const double slope = glm::dot(faces.normal[k], direction), estimate = seen.depth[k];
    const double exact = -faces.eyeHeight[k] / slope;
    const double depth = std::abs(slope) < kEdgeOn ? estimate : exact;
    points.position.set(k, eye + depth * direction);
    points.precision[k] = precision * estimate;
  }
  points.normal = faces.normal;
  points.reach = faces.reach;
  points.triangle = seen.triangle;
}

std::uint32_t FacingPoints::insideCone(const trace::SurfacePoints8& points) const {
  return trace::lanesWhere([&](std::size_t k) {
    return trace::hasLane(points.active, k) && scene::insideCone(light_, points.position[k] + surfaces_.origin);
  });
}

}  // namespace umbrage::techniques::detail
