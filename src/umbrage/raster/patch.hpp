#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/mesh/mesh.hpp"
#include "umbrage/raster/pixel_space.hpp"

namespace umbrage::raster {

/// Four linear functions over the picture side by side, or what belongs to each.
using Double4 = double __attribute__((vector_size(32)));

/// What patches are made of: positions as the camera sees them, and a light behind the last of them.
struct Corners {
  const std::vector<Vec3>& mapped;
  Sighted light;
  [[nodiscard]] std::uint32_t lightIndex() const { return static_cast<std::uint32_t>(mapped.size()); }
  [[nodiscard]] Sighted at(std::uint32_t i) const { return i < mapped.size() ? Sighted{mapped[i], 1.0} : light; }
};

/// A part of a plane as the picture shows it, with no clipping: a triangle (a, b, c), or the side of a shadow volume, which is all that lies
/// beyond the edge (a, b) as c, the light, sees it. Its corners may lie anywhere, behind the eye and at infinity too.
///
/// A pixel is covered where all three edges are above 0. Along its ray the patch lies at nearness (1 / w) plane / distance.
/// Source: rasterisation in homogeneous coordinates, M. Olano and T. Greer, 1997.
struct alignas(32) Patch {
  /// x * pixel.x + y * pixel.y + c: first the edges (a, b), (b, c) and (c, a), then the plane.
  Double4 x{}, y{}, c{};
  Double4 slack{};  ///< an edge has surely the sign that it shows when it is farther than this from 0; 0 for the plane
  double distance = 0.0;  ///< of the eye from the plane, in the measure of the plane; not below 0
  std::array<std::uint32_t, 3> corner{};
  std::int8_t side = 0;     ///< the sign of det(a, b, c): which side of it the eye is on; never 0
  bool beyond = false;      ///< the side of a volume
  std::int32_t weight = 0;  ///< what the count changes by where the way from the eye crosses the patch
  std::uint32_t id = 0;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< pixels it can cover: [x0, x1) x [y0, y1)

  [[nodiscard]] double at(std::size_t function, double px, double py) const {
    return c[function] + x[function] * px + y[function] * py;
  }
  /// Exactly, with all ties broken alike.
  [[nodiscard]] bool covers(const Corners& corners, int px, int py) const;
};

/// How near a triangle is at a pixel (x, y, 1), in double precision.
[[nodiscard]] double nearnessOf(std::span<const Vec3> mapped, const mesh::Triangle& triangle, const Vec3& pixel);

/// Without extent. False, and nothing, where the corners are in line.
[[nodiscard]] bool makePatch(const PixelSpace& space, const Corners& corners,
                             const std::array<std::uint32_t, 3>& corner, bool beyond, Patch& out);

/// The pixels within the hull of what is seen of some points; the whole picture when one of them is not in front of the eye.
void bound(const PixelSpace& space, std::span<const Vec3> points, Patch& out);

}  // namespace umbrage::raster
