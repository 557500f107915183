#include "umbrage/trace/light_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrage/base/check.hpp"
#include "umbrage/math/predicates.hpp"
#include "umbrage/trace/detail/embree_scene.hpp"

namespace umbrage::trace {
namespace {

// A ray in single precision knows its far end to a few 2^-24 of its length.
constexpr double kRelativeCut = 0x1p-20;
// Hits within this many resolutions of a lifted start are looked at again in double precision.
constexpr double kNearResolutions = 64.0;
// So are triangles within this sine of the ray's direction, and hits in the last part of a ray: rounding errs by a few 2^-24 of
// the ray's length divided by that sine.
constexpr float kEdgeOn = 1e-4f;
constexpr float kLastPart = 0.99f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// The casters that rays ending `cut` + kRelativeCut x length before the light may miss, and that hide anything at all.
std::vector<std::uint32_t> castersNear(const Occlusion& occlusion, const Vec4& light, double cut) {
  std::vector<std::uint32_t> found;
  const scene::Surfaces& surfaces = occlusion.surfaces();
  const Vec3 at(light);
  const double longest = glm::length(at - surfaces.bounds.centre()) + surfaces.bounds.radius();
  const double reach = cut + 2.0 * kRelativeCut * longest;
  const auto apart = [&](const Vec3& min, const Vec3& max) {
    return largest(glm::max(glm::max(min - at, at - max), Vec3(0.0))) > reach;
  };
  if (surfaces.casterBounds.empty() || apart(surfaces.casterBounds.min, surfaces.casterBounds.max)) return found;
  for (const std::uint32_t t : occlusion.trees().casterTriangle) {
    const Corners c = occlusion.corners(t);
    if (apart(glm::min(c.a, glm::min(c.b, c.c)), glm::max(c.a, glm::max(c.b, c.c)))) continue;
    if (distanceToTriangle(at, c.a, c.b, c.c) <= reach && lightSide(c.a, c.b, c.c, light) != 0) found.push_back(t);
  }
  return found;
}

// Whether `triangle` is the surface the point lies on, or one that lies upon it as far as the resolution can tell.
bool sameSurface(const Corners& triangle, const Vec3& point, double resolution) {
  const auto& [a, b, c] = triangle;
  const Vec3 outside = glm::max(glm::min(a, glm::min(b, c)) - point, point - glm::max(a, glm::max(b, c)));
  if (std::max({outside.x, outside.y, outside.z}) > 2.0 * resolution)
    return false;  // most are: the box is quickly asked
  return distanceToTriangle(point, triangle.a, triangle.b, triangle.c) <= resolution;
}

struct Query {
  RTCIntersectContext context;
  const Occlusion* occlusion;
  const SurfacePoints8* points;
  const Vec4* light;
  const float* exactBelow;  ///< per lane: hits at smaller parameters are decided in double precision
  float exactAbove;         ///< and at larger ones
};

bool hidesPoint(const Query& query, std::uint32_t triangle, std::size_t k) {
  if (triangle == query.points->triangle[k]) return false;
  const Corners corners = query.occlusion->corners(triangle);
  const Vec3 point = query.points->position[k];
  return hides(corners, point, *query.light) && !sameSurface(corners, point, query.occlusion->resolution());
}

// A triangle seen edge-on from the light: single precision hits some that lie in a plane with the light and hide nothing.
bool edgeOn(const RTCFilterFunctionNArguments& arguments, unsigned i) {
  const Vec3f direction(RTCRayN_dir_x(arguments.ray, arguments.N, i), RTCRayN_dir_y(arguments.ray, arguments.N, i),
                        RTCRayN_dir_z(arguments.ray, arguments.N, i));
  const Vec3f normal(RTCHitN_Ng_x(arguments.hit, arguments.N, i), RTCHitN_Ng_y(arguments.hit, arguments.N, i),
                     RTCHitN_Ng_z(arguments.hit, arguments.N, i));
  return std::abs(glm::dot(direction, normal)) <= kEdgeOn * glm::length(direction) * glm::length(normal);
}

void rejectFalseHits(const RTCFilterFunctionNArguments* arguments) {
  const auto* query = reinterpret_cast<const Query*>(arguments->context);
  const std::vector<std::uint32_t>& triangles = query->occlusion->trees().casterTriangle;
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != -1) continue;
    const std::size_t k = RTCRayN_id(arguments->ray, arguments->N, i);
    const float t = RTCRayN_tfar(arguments->ray, arguments->N, i);
    if (t >= query->exactBelow[k] && t <= query->exactAbove && !edgeOn(*arguments, i)) continue;
    const std::uint32_t triangle = triangles[RTCHitN_primID(arguments->hit, arguments->N, i)];
    if (!hidesPoint(*query, triangle, k)) arguments->valid[i] = 0;
  }
}

/// Where rays start and end.
struct Aim {
  Vec4 light;
  double resolution;
  float cut;  ///< rays end this far from the light, plus a part of their length
};

// Rays from eight points to the light, lane by lane without a branch; lanes that hold no point get some ray.
// A start is lifted off the surface where that is precise enough; else it lies a little behind it, and every hit is looked at in
// double precision. The light's height over the surface is, for a direction, the sine of its elevation.
template <bool kFinite>
UMBRAGE_LANES void aim(const Aim& a, const SurfacePoints8& points, RTCRay8& rays, float* exactBelow) {
  const float nearBelow = static_cast<float>(kNearResolutions * a.resolution);
  for (std::size_t k = 0; k < 8; ++k) {
    const Vec3 point = points.position[k], normal = points.normal[k];
    const Vec3 towards = scene::towardsLight(a.light, point);
    const double length = kFinite ? glm::length(towards) : 1.0;
    const float inverse = 1.0f / static_cast<float>(length);
    const double height = glm::dot(normal, towards);
    const double lift = kFinite ? std::min(a.resolution, 0.5 * height) : a.resolution;
    const bool lifted = lift * length <= points.precision[k] * height;
    const double back = -2.0 * a.resolution / length, step = lifted ? lift : back;
    const Vec3f from(point.x + step * (lifted ? normal.x : towards.x), point.y + step * (lifted ? normal.y : towards.y),
                     point.z + step * (lifted ? normal.z : towards.z));
    const Vec3f along(kFinite ? Vec3(a.light) - Vec3(from) : towards);
    rays.org_x[k] = from.x, rays.org_y[k] = from.y, rays.org_z[k] = from.z;
    rays.dir_x[k] = along.x, rays.dir_y[k] = along.y, rays.dir_z[k] = along.z;
    rays.tfar[k] = kFinite ? 1.0f - float(kRelativeCut) - a.cut * inverse : kInfinity;
    exactBelow[k] = (lifted ? nearBelow : kInfinity) * inverse;
  }
}

void setConstants(RTCRay8& rays) {
  for (unsigned k = 0; k < 8; ++k) {
    rays.tnear[k] = 0.0f;
    rays.time[k] = 0.0f;
    rays.mask[k] = ~0u;
    rays.id[k] = k;
    rays.flags[k] = 0;
  }
}

RTCIntersectContext coherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  context.filter = rejectFalseHits;
  return context;
}

// Bit k: ray k meets what hides its point.
std::uint32_t meets(Query& query, RTCRay8& rays) {
  alignas(32) int valid[8];
  for (std::size_t k = 0; k < 8; ++k) valid[k] = hasLane(query.points->active, k) && rays.tfar[k] > 0.0f ? -1 : 0;
  detail::occluded(query.occlusion->trees(), valid, query.context, rays);
  return lanesWhere([&](std::size_t k) { return valid[k] != 0 && rays.tfar[k] < 0.0f; });
}

}  // namespace

LightRays::LightRays(const Occlusion& occlusion, const scene::Light& light)
    : occlusion_(occlusion), light_(scene::homogeneous(light, occlusion.surfaces().origin)) {
  if (light_.w == 0.0) return;
  cut_ = 4.0 * occlusion.resolution() + 0x1p-21 * largest(Vec3(light_));
  nearLight_ = castersNear(occlusion, light_, cut_);
}

void LightRays::hidden(std::span<const SurfacePoints8> points, std::span<std::uint32_t> hidden) const {
  UMBRAGE_CHECK(points.size() <= kBatch && points.size() == hidden.size(), "packets");
  if (occlusion_.trees().casterTriangle.empty()) return void(std::fill(hidden.begin(), hidden.end(), 0u));
  const bool finite = light_.w != 0.0;
  const Aim to{light_, occlusion_.resolution(), static_cast<float>(cut_)};
  std::array<RTCRay8, kBatch> rays;
  alignas(32) std::array<std::array<float, 8>, kBatch> exactBelow;
  for (std::size_t i = 0; i < points.size(); ++i) {
    setConstants(rays[i]);
    finite ? aim<true>(to, points[i], rays[i], exactBelow[i].data())
           : aim<false>(to, points[i], rays[i], exactBelow[i].data());
  }
  Query query{coherentContext(), &occlusion_, nullptr, &light_, nullptr, finite ? kLastPart : kInfinity};
  for (std::size_t i = 0; i < points.size(); ++i) {
    query.points = &points[i];
    query.exactBelow = exactBelow[i].data();
    hidden[i] = meets(query, rays[i]);
    if (!nearLight_.empty()) hidden[i] |= hiddenNearLight(points[i]);
  }
}

std::uint32_t LightRays::hidden(const SurfacePoints8& points) const {
  std::uint32_t bits = 0;
  hidden({&points, 1}, {&bits, 1});
  return bits;
}

std::uint32_t LightRays::hiddenNearLight(const SurfacePoints8& points) const {
  std::uint32_t hidden = 0;
  const Query query{{}, &occlusion_, &points, &light_, nullptr, 0.0f};
  for (std::size_t k = 0; k < 8; ++k)
    if (hasLane(points.active, k) &&
        std::any_of(nearLight_.begin(), nearLight_.end(), [&](std::uint32_t t) { return hidesPoint(query, t, k); }))
      hidden |= 1u << k;
  return hidden;
}

}  // namespace umbrage::trace
