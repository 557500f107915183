#include "umbrage/raster/pixel_space.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/math/predicates.hpp"
#include "umbrage/parallel/for_each.hpp"

namespace umbrage::raster {
namespace {

constexpr std::size_t kPart = 8192;  // positions

std::uint8_t outcode(const Vec3& p, double width, double height) {
  return static_cast<std::uint8_t>((p.x < 0.0) | (p.x > width * p.z) << 1 | (p.y < 0.0) << 2 |
                                   (p.y > height * p.z) << 3 | (p.z < 0.0) << 4);
}

constexpr double kLeast = 0x1p-40;  // of the scene

// Whether a point lies on one of the triangles, or within `least` of their boxes and in their planes.
bool touches(const scene::Surfaces& surfaces, const Vec3& point, double least) {
  const Vec3 low = point - least, high = point + least;
  return std::ranges::any_of(surfaces.triangles, [&](const mesh::Triangle& t) {
    const Vec3 a(surfaces.positions[t[0]]), b(surfaces.positions[t[1]]), c(surfaces.positions[t[2]]);
    for (int k = 0; k < 3; ++k)
      if (std::max({a[k], b[k], c[k]}) < low[k] || std::min({a[k], b[k], c[k]}) > high[k]) return false;
    return liesInPlane(a, b, c, point);
  });
}

}  // namespace

PixelSpace pixelSpace(const scene::Camera& camera, const Vec3& origin, double radius) {
  const scene::PixelRays rays = scene::pixelRays(camera);
  const double reach = std::max(radius, glm::length(camera.eye - origin));
  PixelSpace space;
  space.eye = camera.eye - origin;
  space.width = camera.width, space.height = camera.height;
  space.scale = reach > 0.0 ? std::exp2(-std::ceil(std::log2(reach))) : 1.0;
  space.fromScene = space.scale * glm::inverse(Mat3(rays.dx, rays.dy, rays.corner));
  return space;
}

PixelSpace pixelSpace(const scene::Camera& camera, const scene::Surfaces& surfaces) {
  PixelSpace space = pixelSpace(camera, surfaces.origin, surfaces.bounds.radius());
  const double least = kLeast / space.scale;
  if (touches(surfaces, space.eye, least)) space.eye += least * Vec3(0.3617, 0.4771, 0.8009);
  return space;
}

Result<void> mapPositions(const PixelSpace& space, std::span<const Vec3f> positions, SeenPositions& out) {
  out.mapped.resize(positions.size());
  out.outside.resize(positions.size());
  const double width = space.width, height = space.height;
  return parallel::forEach(static_cast<int>((positions.size() + kPart - 1) / kPart), [&](int part) {
    const std::size_t begin = static_cast<std::size_t>(part) * kPart, end = std::min(positions.size(), begin + kPart);
    for (std::size_t i = begin; i < end; ++i) {
      out.mapped[i] = space.map(Vec3(positions[i]));
      out.outside[i] = outcode(out.mapped[i], width, height);
    }
  });
}

}  // namespace umbrage::raster
