#include "umbrage/raster/pixel_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "umbrage/math/predicates.hpp"
#include "umbrage/parallel/for_each.hpp"

namespace umbrage::raster {
namespace {

constexpr std::size_t kPart = 8192;  // positions

std::uint8_t outcode(const Vec3& p, double width, double height) {
  return static_cast<std::uint8_t>((p.x < 0.0) | (p.x > width * p.z) << 1 | (p.y < 0.0) << 2 |
                                   (p.y > height * p.z) << 3 | (p.z < 0.0) << 4);
}

constexpr double kLeast = 0x1p-40;     // of what the eye touches
constexpr double kRounding = 0x1p-50;  // of the eye's own place

// Whether a point lies on a triangle, as far as double arithmetic can tell. One hardly above it is above it.
bool touches(std::array<Vec3, 3> corners, const Vec3& point) {
  const double least = kRounding * glm::length(point);
  for (int k = 0; k < 3; ++k)
    if (std::max({corners[0][k], corners[1][k], corners[2][k]}) < point[k] - least ||
        std::min({corners[0][k], corners[1][k], corners[2][k]}) > point[k] + least)
      return false;
  std::ranges::sort(corners,
                    [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return lightSide(corners[0], corners[1], corners[2], Vec4(point, 1.0)) == 0;
}

// How large what a point touches is, the smallest of it; infinite where it touches nothing.
double touchedSize(const scene::Surfaces& surfaces, const Vec3& point) {
  double size = std::numeric_limits<double>::infinity();
  for (const mesh::Triangle& t : surfaces.triangles) {
    const std::array<Vec3, 3> c{surfaces.positions[t[0]], surfaces.positions[t[1]], surfaces.positions[t[2]]};
    if (touches(c, point))
      size =
          std::min(size, std::max({glm::length(c[0] - point), glm::length(c[1] - point), glm::length(c[2] - point)}));
  }
  return size;
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
  const double size = touchedSize(surfaces, space.eye);
  if (std::isinf(size)) return space;
  const double way =
      std::max({kLeast * size, 2.0 * kRounding * glm::length(space.eye), size > 0.0 ? 0.0 : kLeast / space.scale});
  space.eye += way * Vec3(0.3617, 0.4771, 0.8009);
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
