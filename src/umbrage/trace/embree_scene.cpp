#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "umbrage/trace/detail/embree_scene.hpp"

namespace umbrage::trace::detail {
namespace {

const char* text(RTCError code) {
  switch (code) {
    case RTC_ERROR_NONE: return "no error";
    case RTC_ERROR_INVALID_ARGUMENT: return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION: return "invalid operation";
    case RTC_ERROR_OUT_OF_MEMORY: return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU: return "this processor is not supported";
    case RTC_ERROR_CANCELLED: return "cancelled";
    default: return "unknown error";
  }
}

tl::unexpected<Error> failure(RTCDevice device) {
  return fail(ErrorCode::device, std::string("the ray tracer failed: ") + text(rtcGetDeviceError(device)), "Embree");
}

struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using GeometryHandle = std::unique_ptr<RTCGeometryTy, ReleaseGeometry>;

void copyPositions(float* to, const std::vector<Vec3f>& positions) {
  for (const Vec3f& p : positions) {
    *to++ = p.x;
    *to++ = p.y;
    *to++ = p.z;
  }
}

GeometryHandle makeGeometry(RTCDevice device, const scene::Surfaces& surfaces, std::span<const std::uint32_t> chosen) {
  GeometryHandle geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  if (geometry == nullptr) return nullptr;
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), surfaces.positions.size()));
  auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), chosen.size()));
  if (points == nullptr || corners == nullptr) return nullptr;
  copyPositions(points, surfaces.positions);
  for (const std::uint32_t triangle : chosen) corners = std::copy_n(surfaces.triangles[triangle].data(), 3, corners);
  rtcCommitGeometry(geometry.get());
  return geometry;
}

}  // namespace

Result<DeviceHandle> openDevice() {
  DeviceHandle device(rtcNewDevice(nullptr));
  if (device == nullptr) return failure(nullptr);
  return device;
}

Result<SceneHandle> buildTree(RTCDevice device, const scene::Surfaces& surfaces,
                              std::span<const std::uint32_t> chosen) {
  SceneHandle tree(rtcNewScene(device));
  if (tree == nullptr) return failure(device);
  // Robust: no ray slips through an edge shared by two triangles. The filter looks at hits beside a ray's start.
  rtcSetSceneFlags(tree.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  if (!chosen.empty()) {
    const GeometryHandle geometry = makeGeometry(device, surfaces, chosen);
    if (geometry == nullptr) return failure(device);
    rtcAttachGeometry(tree.get(), geometry.get());
  }
  // One thread: where triangles coincide, which of them a ray reports depends on their order in the tree, and parallel
  // builders order them as the threads happen to run.
  tbb::task_arena alone(1);
  alone.execute([&] { rtcJoinCommitScene(tree.get()); });
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    return fail(ErrorCode::device, "the ray tracer could not build its tree", "Embree");
  return tree;
}

RTCRay lane(const RTCRay8& rays, int k) {
  RTCRay ray{};
  ray.org_x = rays.org_x[k], ray.org_y = rays.org_y[k], ray.org_z = rays.org_z[k];
  ray.dir_x = rays.dir_x[k], ray.dir_y = rays.dir_y[k], ray.dir_z = rays.dir_z[k];
  ray.tnear = rays.tnear[k], ray.tfar = rays.tfar[k], ray.mask = rays.mask[k], ray.id = rays.id[k];
  return ray;
}

void occluded(const Trees& trees, const int* valid, RTCIntersectContext& context, RTCRay8& rays) {
  if (trees.wide) return rtcOccluded8(valid, trees.casters.get(), &context, &rays);
  for (int k = 0; k < 8; ++k) {
    if (valid[k] == 0) continue;
    RTCRay ray = lane(rays, k);
    rtcOccluded1(trees.casters.get(), &context, &ray);
    rays.tfar[k] = ray.tfar;
  }
}

std::vector<std::uint32_t> castersNear(const Trees& trees, const Vec3& at, double radius) {
  std::vector<std::uint32_t> found;
  if (trees.casterTriangle.empty()) return found;
  // What rounding the place to single precision moves it by.
  const double moved = 0x1p-22 * glm::length(at);
  RTCPointQuery query{};
  query.x = static_cast<float>(at.x), query.y = static_cast<float>(at.y), query.z = static_cast<float>(at.z);
  query.radius = static_cast<float>((1.0 + 0x1p-20) * (radius + moved));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto note = [](RTCPointQueryFunctionArguments* arguments) {
    static_cast<std::vector<std::uint32_t>*>(arguments->userPtr)->push_back(arguments->primID);
    return false;  // the radius stays
  };
  rtcPointQuery(trees.casters.get(), &query, &context, note, &found);
  for (std::uint32_t& primitive : found) primitive = trees.casterTriangle[primitive];
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace umbrage::trace::detail
