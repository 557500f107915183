#include "bare_rays.hpp"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "embree_casters.hpp"
#include "umbrage/shadow/facing.hpp"

namespace umbrage::benchmarks {

struct BareRays::State {
  const View view;
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene tree = rtcNewScene(device);
  std::vector<Vec3f>
      lift;  ///< per triangle: the offset of starts, towards the light's side; zero where it does not face the light
  std::vector<std::uint8_t> facing;
  Vec3f eye, corner, dx, dy;
  Vec4f light;
};

namespace {

constexpr int kTileWidth = 32, kTileHeight = 16;

}  // namespace

BareRays::BareRays(const View& view) : state_(new State{view, {}, {}, {}, {}, {}, {}, {}, {}}) {
  State& s = *state_;
  s.device = rtcNewDevice(nullptr);
  s.tree = rtcNewScene(s.device);
  const scene::Surfaces& surfaces = view.geometry->surfaces;
  addCasters(s.device, s.tree, surfaces);
  rtcSetSceneFlags(s.tree, RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(s.tree);
  const Vec4 light = scene::homogeneous(view.light, surfaces.origin);
  const Vec3 eye = view.camera.eye - surfaces.origin;
  s.facing = shadow::visibleSideFacesLight(surfaces, Vec4(eye, 1.0), light);
  const double offset = 0x1p-20 * surfaces.casterBounds.radius();
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Vec3 n = glm::normalize(surfaces.normal(t));
    const bool towards = glm::dot(n, scene::towardsLight(light, surfaces.corner(t, 0))) > 0.0;
    s.lift.push_back(Vec3f((towards ? offset : -offset) * n));
  }
  const scene::PixelRays rays = scene::pixelRays(view.camera);
  s.eye = Vec3f(eye), s.corner = Vec3f(rays.corner), s.dx = Vec3f(rays.dx), s.dy = Vec3f(rays.dy),
  s.light = Vec4f(light);
}

BareRays::~BareRays() {
  rtcReleaseScene(state_->tree);
  rtcReleaseDevice(state_->device);
}

image::GreyImage BareRays::mask(const shadow::SurfaceBuffer& seen) const {
  const State& s = *state_;
  const int width = seen.depth.width(), height = seen.depth.height();
  image::GreyImage mask(width, height);
  const auto packet = [&](int x, int y) {
    alignas(32) int valid[8];
    RTCRay8 rays;
    int any = 0;
    for (int k = 0; k < 8; ++k) {
      const int px = x + (k & 3), py = y + (k >> 2);
      valid[k] = 0;
      if (px >= width || py >= height) continue;
      const std::uint32_t t = seen.triangle(px, py);
      if (t == shadow::kNoTriangle || s.facing[t] == 0) continue;
      const Vec3f direction = s.corner + (float(px) + 0.5f) * s.dx + (float(py) + 0.5f) * s.dy;
      const Vec3f from = s.eye + seen.depth(px, py) * direction + s.lift[t];
      const Vec3f along = Vec3f(s.light) - s.light.w * from;
      rays.org_x[k] = from.x, rays.org_y[k] = from.y, rays.org_z[k] = from.z;
      rays.dir_x[k] = along.x, rays.dir_y[k] = along.y, rays.dir_z[k] = along.z;
      rays.tnear[k] = 0.0f;
      rays.tfar[k] = s.light.w == 0.0f ? std::numeric_limits<float>::infinity() : 0.9999f;
      rays.time[k] = 0.0f;
      rays.mask[k] = ~0u;
      rays.id[k] = rays.flags[k] = 0;
      valid[k] = any = -1;
    }
    if (any == 0) return;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(valid, s.tree, &context, &rays);
    for (int k = 0; k < 8; ++k)
      if (valid[k] != 0 && rays.tfar[k] >= 0.0f) mask(x + (k & 3), y + (k >> 2)) = 255;
  };
  const int columns = (width + kTileWidth - 1) / kTileWidth, rows = (height + kTileHeight - 1) / kTileHeight;
  tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows), [&](const tbb::blocked_range<int>& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const int x0 = i % columns * kTileWidth, y0 = i / columns * kTileHeight;
      for (int y = y0; y < std::min(height, y0 + kTileHeight); y += 2)
        for (int x = x0; x < std::min(width, x0 + kTileWidth); x += 4) packet(x, y);
    }
  });
  return mask;
}

}  // namespace umbrage::benchmarks
