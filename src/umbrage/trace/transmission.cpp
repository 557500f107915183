#include "umbrage/trace/transmission.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "umbrage/math/predicates.hpp"
#include "umbrage/trace/detail/embree_scene.hpp"

namespace umbrage::trace {
namespace {

// On which side of a line an edge passes. The corners come in one order whichever of its triangles asks, so that both get the same answer.
int sideOfLine(const Vec3& from, const Vec3& direction, const Vec3& a, const Vec3& b) {
  return glm::dot(direction, glm::cross(a - from, b - from)) < 0.0 ? -1 : 1;
}

// REQUIRES: corners in lexicographic order.
bool lineMeets(const Vec3& from, const Vec3& direction, const Corners& c) {
  const int ab = sideOfLine(from, direction, c.a, c.b);
  return ab == sideOfLine(from, direction, c.b, c.c) && ab == -sideOfLine(from, direction, c.a, c.c);
}

/// A query, as Embree hands it on: called for every triangle whose box a ray meets; false ends the ray.
struct Query {
  RTCIntersectContext context;
  const std::function<bool(std::uint32_t triangle)>* meet;
};

/// What the boxes are made of.
struct Boxes {
  const scene::Surfaces* surfaces;
  double margin;  ///< rays are rounded to single precision
};

void boundsOf(const RTCBoundsFunctionArguments* arguments) {
  const auto& boxes = *static_cast<const Boxes*>(arguments->geometryUserPtr);
  Box3 box;
  for (int k = 0; k < 3; ++k) box.add(boxes.surfaces->corner(arguments->primID, k));
  const Vec3f low(box.min - boxes.margin), high(box.max + boxes.margin);
  *arguments->bounds_o = {low.x, low.y, low.z, 0.0f, high.x, high.y, high.z, 0.0f};
}

void meet(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& query = *reinterpret_cast<const Query*>(arguments->context);
  if (!(*query.meet)(arguments->primID))
    RTCRayN_tfar(arguments->ray, arguments->N, 0) = -std::numeric_limits<float>::infinity();
}

void neverAsked(const RTCIntersectFunctionNArguments*) {}

}  // namespace

struct Transmission::Tree {
  Boxes boxes;  // stays where it is: Embree is told
  detail::DeviceHandle device;
  detail::SceneHandle scene;

  void visit(const Vec3& from, const Vec3& direction, double length,
             const std::function<bool(std::uint32_t triangle)>& fn) const {
    Query query{{}, &fn};
    rtcInitIntersectContext(&query.context);
    RTCRay ray{};
    ray.org_x = float(from.x), ray.org_y = float(from.y), ray.org_z = float(from.z);
    ray.dir_x = float(direction.x), ray.dir_y = float(direction.y), ray.dir_z = float(direction.z);
    ray.tfar = float(length);
    ray.mask = ~0u;
    rtcOccluded1(scene.get(), &query.context, &ray);
  }
};

Result<Transmission> Transmission::build(std::shared_ptr<const shadow::Geometry> geometry) {
  auto device = detail::openDevice();
  if (!device) return tl::unexpected(device.error());
  auto tree = std::make_unique<Tree>();
  tree->device = std::move(*device);
  tree->scene = detail::SceneHandle(rtcNewScene(tree->device.get()));
  const scene::Surfaces& surfaces = geometry->surfaces;
  if (!surfaces.triangles.empty()) {
    RTCGeometry boxes = rtcNewGeometry(tree->device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(boxes, static_cast<unsigned>(surfaces.triangles.size()));
    tree->boxes = {&surfaces,
                   4.0 * resolution(largest(glm::max(glm::abs(surfaces.bounds.min), glm::abs(surfaces.bounds.max))))};
    rtcSetGeometryUserData(boxes, &tree->boxes);
    rtcSetGeometryBoundsFunction(boxes, boundsOf, nullptr);
    rtcSetGeometryIntersectFunction(boxes, neverAsked);
    rtcSetGeometryOccludedFunction(boxes, meet);
    rtcCommitGeometry(boxes);
    rtcAttachGeometry(tree->scene.get(), boxes);
    rtcReleaseGeometry(boxes);
  }
  rtcSetSceneFlags(tree->scene.get(), RTC_SCENE_FLAG_ROBUST);
  tbb::task_arena alone(1);
  alone.execute([&] { rtcJoinCommitScene(tree->scene.get()); });
  if (rtcGetDeviceError(tree->device.get()) != RTC_ERROR_NONE)
    return fail(ErrorCode::device, "the ray tracer could not build its tree", "Embree");
  return Transmission(std::move(geometry), std::move(tree));
}

Transmission::Transmission(std::shared_ptr<const shadow::Geometry> geometry, std::unique_ptr<Tree> tree)
    : geometry_(std::move(geometry)), tree_(std::move(tree)) {}
Transmission::Transmission(Transmission&&) noexcept = default;
Transmission& Transmission::operator=(Transmission&&) noexcept = default;
Transmission::~Transmission() = default;

void Transmission::look(const Vec3& from, const Vec3& direction, std::vector<Hit>& out) const {
  const scene::Surfaces& surfaces = geometry_->surfaces;
  out.clear();
  double end = std::numeric_limits<double>::infinity();  // where the first opaque surface is
  std::uint32_t last = shadow::kNoTriangle;
  // An eye far outside would lose its place in single precision.
  const Vec3 start = from + 0.999 * distanceToBox(from, surfaces.bounds) / glm::length(direction) * direction;
  tree_->visit(start, direction, std::numeric_limits<float>::infinity(), [&](std::uint32_t t) {
    const Corners c{surfaces.corner(t, 0), surfaces.corner(t, 1), surfaces.corner(t, 2)};
    if (!lineMeets(from, direction, c) || liesInPlane(c.a, c.b, c.c, from)) return true;
    const Vec3 normal = surfaces.normal(t);
    const double at = glm::dot(normal, c.a - from) / glm::dot(normal, direction);
    if (!(at > 0.0)) return true;
    if (geometry_->filters.isVeil(t))
      out.push_back({t, at});
    else if (at < end || (at == end && t < last))
      end = at, last = t;
    return true;
  });
  std::erase_if(out, [&](const Hit& hit) { return hit.at >= end; });
  std::sort(out.begin(), out.end(),
            [](const Hit& a, const Hit& b) { return a.at < b.at || (a.at == b.at && a.triangle < b.triangle); });
  if (last != shadow::kNoTriangle) out.push_back({last, end});
}

std::optional<shadow::FilterSum> Transmission::towards(const Vec4& light, const Vec3& point,
                                                       std::uint32_t surface) const {
  const scene::Surfaces& surfaces = geometry_->surfaces;
  const Vec3 way = scene::towardsLight(light, point);
  const double ownReach = surfaces.casts[surface] != 0 ? reachOf(surfaces, surface) : 0.0;
  shadow::FilterSum sum{};
  bool hidden = false;
  const double length = light.w != 0.0 ? 1.0 + 0x1p-18 : std::numeric_limits<double>::infinity();
  tree_->visit(point, way, length, [&](std::uint32_t t) {
    if (surfaces.casts[t] == 0 || t == surface) return true;
    const Corners c{surfaces.corner(t, 0), surfaces.corner(t, 1), surfaces.corner(t, 2)};
    const int ofLight = lightSide(c.a, c.b, c.c, light), ofPoint = lightSide(c.a, c.b, c.c, Vec4(point, 1.0));
    if (ofLight * ofPoint >= 0 || !lineMeets(point, way, c)) return true;
    if (sameSurface(c, point, resolution(std::max({ownReach, reachOf(surfaces, t), largest(point)})))) return true;
    hidden = !geometry_->filters.isVeil(t);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += geometry_->filters.of(t)[k];
    return !hidden;
  });
  return hidden ? std::nullopt : std::optional(sum);
}

}  // namespace umbrage::trace
