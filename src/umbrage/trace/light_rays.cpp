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
// Of a triangle's largest coordinate: what single precision may be wrong by about where a ray meets it.
constexpr double kRounding = 0x1p-18;
// Hits within this many resolutions of a lifted start, or within the rounding of the triangle met, are looked at again in double
// precision.
constexpr double kNearResolutions = 64.0;
// So are triangles within this sine of the ray's direction, and hits in the last part of a ray: rounding errs by a few 2^-24 of
// the ray's length divided by that sine.
constexpr float kEdgeOn = 1e-4f;
constexpr float kLastPart = 0.99f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The rounding of a triangle whose corners have coordinates up to `reach`.
double rounding(double reach) { return kRounding * reach; }

// The casters that some ray which ends `cut` + kRelativeCut x its length before the light may miss, and that hide anything at all,
// the nearest first.
std::vector<LightRays::Near> castersNear(const Occlusion& occlusion, const Vec4& light, double cut) {
  const scene::Surfaces& surfaces = occlusion.surfaces();
  const Vec3 at(light);
  const double longest = glm::length(at - surfaces.bounds.centre()) + surfaces.bounds.radius();
  const double most = cut + 2.0 * kRelativeCut * longest;
  std::vector<LightRays::Near> found;
  for (const std::uint32_t t : detail::castersNear(occlusion.trees(), at, most + rounding(occlusion.largestReach()))) {
    const Corners c = occlusion.corners(t);
    const double distance = distanceToTriangle(at, c.a, c.b, c.c) - rounding(occlusion.reach(t));
    if (distance <= most && lightSide(c.a, c.b, c.c, light) != 0) found.push_back({t, distance});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return found;
}

/// Of the rays of a packet.
struct Distances {
  alignas(32) std::array<float, 8> below;    ///< hits at smaller parameters are decided in double precision
  alignas(32) std::array<float, 8> inverse;  ///< 1 / length
};

struct Query {
  RTCIntersectContext context;
  const Occlusion* occlusion;
  const SurfacePoints8* points;
  const Vec4* light;
  const Distances* exact;
  float exactAbove;  ///< hits at larger parameters are decided in double precision too
  float rounding;    ///< and hits nearer to the start than this
};

bool hidesPoint(const Query& query, std::uint32_t triangle, std::size_t k) {
  if (triangle == query.points->triangle[k]) return false;
  const Corners corners = query.occlusion->corners(triangle);
  const Vec3 point = query.points->position[k];
  if (!hides(corners, point, *query.light)) return false;
  const double reach = std::max(query.points->reach[k], double(query.occlusion->reach(triangle)));
  return !sameSurface(corners, point, resolution(std::max(reach, largest(point))));
}

// A triangle seen edge-on from the light: single precision hits some that lie in a plane with the light and hide nothing.
bool edgeOn(float directionX, float directionY, float directionZ, float normalX, float normalY, float normalZ) {
  const float along = directionX * normalX + directionY * normalY + directionZ * normalZ;
  const float direction = directionX * directionX + directionY * directionY + directionZ * directionZ;
  const float normal = normalX * normalX + normalY * normalY + normalZ * normalZ;
  return along * along <= kEdgeOn * kEdgeOn * direction * normal;
}

// Rows of RTCRayN and RTCHitN, each of N numbers.
constexpr std::size_t kDirectionRow = 4, kFarRow = 8;

// Per hit of eight rays in a row: whether single precision cannot be trusted with it.
UMBRAGE_VECTOR_UNITS void doubtful(const float* ray, const float* hit, const Query& query, int* doubt) {
  const float* direction = ray + 8 * kDirectionRow;
  const float* at = ray + 8 * kFarRow;
  const Distances& exact = *query.exact;
  const float rounding = query.rounding, above = query.exactAbove;
  for (std::size_t k = 0; k < 8; ++k)
    doubt[k] = (at[k] < exact.below[k]) | (at[k] < rounding * exact.inverse[k]) | (at[k] > above) |
               edgeOn(direction[k], direction[8 + k], direction[16 + k], hit[k], hit[8 + k], hit[16 + k]);
}

// Embree hands over the rays of a packet together, in their order, or one at a time.
void doubtful(const RTCFilterFunctionNArguments& a, const Query& query, int* doubt) {
  if (a.N == 8)
    return doubtful(reinterpret_cast<const float*>(a.ray), reinterpret_cast<const float*>(a.hit), query, doubt);
  for (unsigned i = 0; i < a.N; ++i) {
    const float t = RTCRayN_tfar(a.ray, a.N, i);
    const std::size_t k = RTCRayN_id(a.ray, a.N, i);
    doubt[i] = t < query.exact->below[k] || t < query.rounding * query.exact->inverse[k] || t > query.exactAbove ||
               edgeOn(RTCRayN_dir_x(a.ray, a.N, i), RTCRayN_dir_y(a.ray, a.N, i), RTCRayN_dir_z(a.ray, a.N, i),
                      RTCHitN_Ng_x(a.hit, a.N, i), RTCHitN_Ng_y(a.hit, a.N, i), RTCHitN_Ng_z(a.hit, a.N, i));
  }
}

void rejectFalseHits(const RTCFilterFunctionNArguments* arguments) {
  const RTCFilterFunctionNArguments& a = *arguments;
  const auto* query = reinterpret_cast<const Query*>(a.context);
  UMBRAGE_CHECK(a.N <= 8, "packets of eight");
  alignas(32) int doubt[8];
  doubtful(a, *query, doubt);
  for (unsigned i = 0; i < a.N; ++i) {
    if (a.valid[i] != -1 || doubt[i] == 0) continue;
    const std::uint32_t triangle = query->occlusion->trees().casterTriangle[RTCHitN_primID(a.hit, a.N, i)];
    if (!hidesPoint(*query, triangle, RTCRayN_id(a.ray, a.N, i))) a.valid[i] = 0;
  }
}

/// Where rays start and end.
struct Aim {
  Vec4 light;
  float cut;  ///< rays end this far from the light, plus a part of their length
};

// Rays from eight points to the light, lane by lane without a branch; lanes that hold no point get some ray.
// A start is lifted off the surface where that is precise enough; else it lies a little behind it, and every hit is looked at in
// double precision. The light's height over the surface is, for a direction, the sine of its elevation.
template <bool kFinite>
UMBRAGE_VECTOR_UNITS void aim(const Aim& a, const SurfacePoints8& points, RTCRay8& rays, Distances& exact) {
  for (std::size_t k = 0; k < 8; ++k) {
    const Vec3 point = points.position[k], normal = points.normal[k];
    const double reach =
        std::max(std::max(std::abs(point.x), std::abs(point.y)), std::max(std::abs(point.z), points.reach[k]));
    const double rounded = resolution(reach);
    const Vec3 towards = scene::towardsLight(a.light, point);
    const double length = kFinite ? glm::length(towards) : 1.0;
    const float inverse = 1.0f / static_cast<float>(length);
    const double height = glm::dot(normal, towards);
    const double lift = kFinite ? std::min(rounded, 0.5 * height) : rounded;
    const bool lifted = lift * length <= points.precision[k] * height;
    const double back = -2.0 * rounded / length, step = lifted ? lift : back;
    const Vec3f from(point.x + step * (lifted ? normal.x : towards.x), point.y + step * (lifted ? normal.y : towards.y),
                     point.z + step * (lifted ? normal.z : towards.z));
    const Vec3f along(kFinite ? Vec3(a.light) - Vec3(from) : towards);
    rays.org_x[k] = from.x, rays.org_y[k] = from.y, rays.org_z[k] = from.z;
    rays.dir_x[k] = along.x, rays.dir_y[k] = along.y, rays.dir_z[k] = along.z;
    rays.tfar[k] = kFinite ? 1.0f - float(kRelativeCut) - a.cut * inverse : kInfinity;
    exact.below[k] = (lifted ? static_cast<float>(kNearResolutions * rounded) : kInfinity) * inverse;
    exact.inverse[k] = inverse;
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
  cut_ = 0x1p-17 * largest(Vec3(light_));
  nearLight_ = castersNear(occlusion, light_, cut_);
}

void LightRays::hidden(std::span<const SurfacePoints8> points, std::span<std::uint32_t> hidden) const {
  UMBRAGE_CHECK(points.size() <= kBatch && points.size() == hidden.size(), "packets");
  if (occlusion_.trees().casterTriangle.empty()) return void(std::fill(hidden.begin(), hidden.end(), 0u));
  const bool finite = light_.w != 0.0;
  const Aim to{light_, static_cast<float>(cut_)};
  std::array<RTCRay8, kBatch> rays;
  std::array<Distances, kBatch> exact;
  for (std::size_t i = 0; i < points.size(); ++i) {
    setConstants(rays[i]);
    finite ? aim<true>(to, points[i], rays[i], exact[i]) : aim<false>(to, points[i], rays[i], exact[i]);
  }
  Query query{coherentContext(),
              &occlusion_,
              nullptr,
              &light_,
              nullptr,
              finite ? kLastPart : kInfinity,
              static_cast<float>(rounding(occlusion_.largestReach()))};
  for (std::size_t i = 0; i < points.size(); ++i) {
    query.points = &points[i];
    query.exact = &exact[i];
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
  const Query query{{}, &occlusion_, &points, &light_, nullptr, 0.0f, 0.0f};
  for (std::size_t k = 0; k < 8; ++k) {
    if (!hasLane(points.active, k)) continue;
    const double missed = cut_ + 2.0 * kRelativeCut * glm::length(Vec3(light_) - points.position[k]);
    for (const Near& near : nearLight_) {
      if (near.distance > missed) break;
      if (hidesPoint(query, near.triangle, k)) hidden |= 1u << k;
    }
  }
  return hidden;
}

}  // namespace umbrage::trace
