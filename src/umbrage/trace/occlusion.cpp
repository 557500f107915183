#include "umbrage/trace/occlusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/surface_buffer.hpp"
#include "umbrage/trace/detail/embree_scene.hpp"

namespace umbrage::trace {
namespace {

using shadow::kNoTriangle;

std::vector<float> reachesOf(const scene::Surfaces& surfaces) {
  std::vector<float> reach;
  reach.reserve(surfaces.triangles.size());
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    reach.push_back(static_cast<float>(reachOf(surfaces, t)));
  return reach;
}

void fill(RTCRay8& to, const Rays8& rays) {
  std::memcpy(to.org_x, rays.fromX.data(), sizeof to.org_x);
  std::memcpy(to.org_y, rays.fromY.data(), sizeof to.org_y);
  std::memcpy(to.org_z, rays.fromZ.data(), sizeof to.org_z);
  std::memcpy(to.dir_x, rays.directionX.data(), sizeof to.dir_x);
  std::memcpy(to.dir_y, rays.directionY.data(), sizeof to.dir_y);
  std::memcpy(to.dir_z, rays.directionZ.data(), sizeof to.dir_z);
  std::memcpy(to.tfar, rays.length.data(), sizeof to.tfar);
  for (int k = 0; k < 8; ++k) {
    to.tnear[k] = 0.0f;
    to.time[k] = 0.0f;
    to.mask[k] = ~0u;
    to.id[k] = static_cast<unsigned>(k);
    to.flags[k] = 0;
  }
}

struct Valid8 {
  alignas(32) int lane[8];
  explicit Valid8(std::uint32_t active) {
    for (int k = 0; k < 8; ++k) lane[k] = (active >> k & 1u) != 0 ? -1 : 0;
  }
};

RTCIntersectContext coherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

// Nearest hits of a packet; on processors without native packets, ray by ray.
void intersect(const Trees& trees, RTCScene tree, const Valid8& valid, RTCRayHit8& rays) {
  RTCIntersectContext context = coherentContext();
  if (trees.wide) return rtcIntersect8(valid.lane, tree, &context, &rays);
  for (int k = 0; k < 8; ++k) {
    if (valid.lane[k] == 0) continue;
    RTCRayHit one{};
    one.ray = detail::lane(rays.ray, k);
    one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tree, &context, &one);
    rays.ray.tfar[k] = one.ray.tfar;
    rays.hit.geomID[k] = one.hit.geomID;
    rays.hit.primID[k] = one.hit.primID;
  }
}

void intersect(const Trees& trees, RTCScene tree, const std::vector<std::uint32_t>& triangles, const Valid8& valid,
               RTCRayHit8& rays, Hits8& hits) {
  if (triangles.empty()) return;
  std::fill_n(rays.hit.geomID, 8, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(rays.hit.instID[0], 8, RTC_INVALID_GEOMETRY_ID);
  intersect(trees, tree, valid, rays);
  for (std::size_t k = 0; k < 8; ++k) {
    if (valid.lane[k] == 0 || rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
    hits.triangle[k] = triangles[rays.hit.primID[k]];
    hits.at[k] = rays.ray.tfar[k];
  }
}

struct ExactQuery {
  RTCIntersectContext context;
  const Occlusion* occlusion;
  const std::vector<std::uint32_t>* triangles;
  Vec3 from, direction;
};

void rejectWhatIsNotCrossed(const RTCFilterFunctionNArguments* arguments) {
  const auto* query = reinterpret_cast<const ExactQuery*>(arguments->context);
  const std::uint32_t triangle = (*query->triangles)[RTCHitN_primID(arguments->hit, arguments->N, 0)];
  const Corners c = query->occlusion->corners(triangle);
  const bool edgeOn = liesInPlane(c.a, c.b, c.c, query->from);
  if (edgeOn || !crossing(query->from, query->direction, c)) arguments->valid[0] = 0;
}

}  // namespace

Occlusion::Occlusion(std::shared_ptr<const scene::Surfaces> surfaces, std::unique_ptr<Trees> trees)
    : surfaces_(std::move(surfaces)), trees_(std::move(trees)), reach_(reachesOf(*surfaces_)) {
  for (const std::uint32_t t : trees_->casterTriangle) largestReach_ = std::max(largestReach_, reach_[t]);
}
Occlusion::Occlusion(Occlusion&&) noexcept = default;
Occlusion& Occlusion::operator=(Occlusion&&) noexcept = default;
Occlusion::~Occlusion() = default;

Result<Occlusion> Occlusion::build(std::shared_ptr<const scene::Surfaces> surfaces) {
  UMBRAGE_CHECK(surfaces != nullptr, "surfaces");
  auto trees = std::make_unique<Trees>();
  for (std::uint32_t t = 0; t < surfaces->triangles.size(); ++t)
    (surfaces->casts[t] != 0 ? trees->casterTriangle : trees->receiverTriangle).push_back(t);
  auto device = detail::openDevice();
  if (!device) return tl::unexpected(device.error());
  trees->device = std::move(*device);
  trees->wide = rtcGetDeviceProperty(trees->device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0;
  auto casters = detail::buildTree(trees->device.get(), *surfaces, trees->casterTriangle);
  if (!casters) return tl::unexpected(casters.error());
  auto receivers = detail::buildTree(trees->device.get(), *surfaces, trees->receiverTriangle);
  if (!receivers) return tl::unexpected(receivers.error());
  trees->casters = std::move(*casters);
  trees->receivers = std::move(*receivers);
  return Occlusion(std::move(surfaces), std::move(trees));
}

double reachOf(const scene::Surfaces& surfaces, std::uint32_t triangle) {
  Vec3 most(0.0);
  for (int k = 0; k < 3; ++k) most = glm::max(most, glm::abs(surfaces.corner(triangle, k)));
  return std::max({most.x, most.y, most.z});
}

std::optional<Hit> Occlusion::nearest(const Vec3& from, const Vec3& direction) const {
  RTCRayHit query{};
  const Vec3f o(from), d(direction);
  query.ray.org_x = o.x, query.ray.org_y = o.y, query.ray.org_z = o.z;
  query.ray.dir_x = d.x, query.ray.dir_y = d.y, query.ray.dir_z = d.z;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  std::optional<Hit> best;
  ExactQuery exact{{}, this, nullptr, from, direction};
  for (const auto& [tree, triangles] : {std::pair(trees_->casters.get(), &trees_->casterTriangle),
                                        std::pair(trees_->receivers.get(), &trees_->receiverTriangle)}) {
    if (triangles->empty()) continue;
    rtcInitIntersectContext(&exact.context);
    exact.context.filter = rejectWhatIsNotCrossed;
    exact.triangles = triangles;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tree, &exact.context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    const std::uint32_t triangle = (*triangles)[query.hit.primID];
    best = Hit{triangle, refine(corners(triangle), from, direction, query.ray.tfar)};
  }
  return best;
}

Hits8 Occlusion::nearest(const Rays8& rays) const {
  Hits8 hits;
  hits.triangle.fill(kNoTriangle);
  hits.at.fill(std::numeric_limits<float>::infinity());
  RTCRayHit8 query;
  fill(query.ray, rays);
  const Valid8 valid(rays.active);
  intersect(*trees_, trees_->casters.get(), trees_->casterTriangle, valid, query, hits);
  intersect(*trees_, trees_->receivers.get(), trees_->receiverTriangle, valid, query, hits);
  return hits;
}

std::uint32_t Occlusion::meetsCaster(const Rays8& rays) const {
  if (trees_->casterTriangle.empty() || rays.active == 0) return 0;
  RTCRay8 query;
  fill(query, rays);
  const Valid8 valid(rays.active);
  RTCIntersectContext context = coherentContext();
  detail::occluded(*trees_, valid.lane, context, query);
  std::uint32_t met = 0;
  for (int k = 0; k < 8; ++k) met |= valid.lane[k] != 0 && query.tfar[k] < 0.0f ? 1u << k : 0u;
  return met;
}

double refine(const Corners& triangle, const Vec3& from, const Vec3& direction, double estimate) {
  const Vec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
  const double slope = glm::dot(direction, normal);
  if (slope == 0.0) return estimate;
  const double square = glm::dot(direction, direction);
  const auto [low, high] =
      std::minmax({glm::dot(triangle.a - from, direction) / square, glm::dot(triangle.b - from, direction) / square,
                   glm::dot(triangle.c - from, direction) / square});
  return std::clamp(glm::dot(triangle.a - from, normal) / slope, low, high);
}

}  // namespace umbrage::trace
