#include "umbrage/raster/pixel_space.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/parallel/for_each.hpp"

namespace umbrage::raster {
namespace {

constexpr std::size_t kPart = 8192;  // positions

std::uint8_t outcode(const Vec3& p, double width, double height) {
  return static_cast<std::uint8_t>((p.x < 0.0) | (p.x > width * p.z) << 1 | (p.y < 0.0) << 2 |
                                   (p.y > height * p.z) << 3 | (p.z < 0.0) << 4);
}

}  // namespace

PixelSpace pixelSpace(const scene::Camera& camera, const Vec3& origin, double radius,
                      std::span<const Vec3f> positions) {
  const scene::PixelRays rays = scene::pixelRays(camera);
  const double reach = std::max(radius, glm::length(camera.eye - origin));
  PixelSpace space;
  space.eye = camera.eye - origin;
  const Vec3 eye = space.eye;
  if (std::ranges::any_of(positions, [&](const Vec3f& p) { return Vec3(p) == eye; }))
    space.eye += 0x1p-40 * reach * Vec3(0.3617, 0.4771, 0.8009);
  space.width = camera.width, space.height = camera.height;
  space.scale = reach > 0.0 ? std::exp2(-std::ceil(std::log2(reach))) : 1.0;
  space.fromScene = space.scale * glm::inverse(Mat3(rays.dx, rays.dy, rays.corner));
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
