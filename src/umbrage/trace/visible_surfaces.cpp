#include "umbrage/trace/visible_surfaces.hpp"

#include <limits>

#include "umbrage/trace/tiles.hpp"

namespace umbrage::trace {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kEdgeOn = 1e-4;  ///< sine of the angle between ray and surface

struct View {
  const Occlusion& occlusion;
  Vec3 eye;  ///< relative to the origin of the surfaces
  scene::PixelRays rays;
  double
      clear;  ///< distance from the eye in which nothing is: an eye far outside would lose its place in single precision
  double
      near;    ///< distance from the eye in which single precision may be wrong about a hit, however small the triangle
  double low;  ///< height of the eye over a plane below which it may count as lying in it (liesInPlane)
};

// A hit in single precision, made exact. Nothing where that takes a second look: very near the eye, or edge-on, where a triangle
// may be hit whose plane holds the eye and which shows nothing.
std::optional<double> exactDepth(const View& view, std::uint32_t triangle, const Vec3& direction, double estimate) {
  const Corners c = view.occlusion.corners(triangle);
  const Vec3 normal = glm::cross(c.b - c.a, c.c - c.a);
  const double slope = glm::dot(normal, direction), square = glm::dot(direction, direction);
  const double area = glm::dot(normal, normal), height = glm::dot(c.a - view.eye, normal);
  const double near = view.near + 0x1p-16 * double(view.occlusion.reach(triangle));
  const bool edgeOn =
      slope * slope <= kEdgeOn * kEdgeOn * area * square || height * height <= view.low * view.low * area;
  if (edgeOn || estimate * estimate * square <= near * near) return std::nullopt;
  return height / slope;
}

void castPacket(const View& view, const Tile& tile, int x, int y, shadow::SurfaceBuffer& out) {
  Rays8 rays{};
  std::array<Vec3, 8> direction;
  std::array<double, 8> start{};
  forEachLane(tile, x, y, [&](int lane, int px, int py) {
    const auto k = static_cast<std::size_t>(lane);
    direction[k] = view.rays.through(px + 0.5, py + 0.5);
    if (view.clear > 0.0) start[k] = 0.99 * view.clear / glm::length(direction[k]);
    const Vec3f from(view.eye + start[k] * direction[k]), d(direction[k]);
    rays.fromX[k] = from.x, rays.fromY[k] = from.y, rays.fromZ[k] = from.z;
    rays.directionX[k] = d.x, rays.directionY[k] = d.y, rays.directionZ[k] = d.z;
    rays.length[k] = kInfinity;
    rays.active |= 1u << lane;
  });
  const Hits8 hits = view.occlusion.nearest(rays);
  forEachLane(tile, x, y, [&](int lane, int px, int py) {
    const auto k = static_cast<std::size_t>(lane);
    if (hits.triangle[k] == shadow::kNoTriangle) return;
    const double estimate = start[k] + double(hits.at[k]);
    if (const auto depth = exactDepth(view, hits.triangle[k], direction[k], estimate)) {
      out.triangle(px, py) = hits.triangle[k];
      out.depth(px, py) = static_cast<float>(*depth);
    } else if (const auto hit = view.occlusion.nearest(view.eye, direction[k])) {
      out.triangle(px, py) = hit->triangle;
      out.depth(px, py) = static_cast<float>(hit->at);
    }
  });
}

}  // namespace

Result<shadow::SurfaceBuffer> visibleSurfaces(const Occlusion& occlusion, const scene::Camera& camera) {
  const scene::Surfaces& surfaces = occlusion.surfaces();
  const Vec3 eye = camera.eye - surfaces.origin;
  const double near = 0x1p-16 * glm::length(eye);
  const double low = 0x1p-25 * (glm::length(eye - surfaces.bounds.centre()) + surfaces.bounds.radius());
  const View view{occlusion, eye, scene::pixelRays(camera), distanceToBox(eye, surfaces.bounds), near, low};
  shadow::SurfaceBuffer out{{camera.width, camera.height, shadow::kNoTriangle},
                            {camera.width, camera.height, kInfinity}};
  const auto done = forEachTile(camera.width, camera.height, [&](const Tile& tile) {
    for (int y = tile.y0; y < tile.y1; y += 2)
      for (int x = tile.x0; x < tile.x1; x += 4) castPacket(view, tile, x, y, out);
  });
  if (!done) return tl::unexpected(done.error());
  return out;
}

}  // namespace umbrage::trace
