#include "umbrage/raster/patch.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::raster {
namespace {

// The absolute products that a cross product is made of.
Vec3 crossSize(const Vec3& a, const Vec3& b) {
  const Vec3 p = glm::abs(a), q = glm::abs(b);
  return {p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
}

// det(a, b, p) for p = (x, y, 1). From the difference of the two, which is nearly exact where they are close.
void setEdge(const PixelSpace& space, const Sighted& a, const Sighted& b, double sign, std::size_t k, Patch& out) {
  const Vec3 difference = b.v * a.w - a.v * b.w;
  const bool differ = a.w != 0.0 && b.w != 0.0;
  const Vec3 other = differ ? difference : b.v;
  const Vec3 cross = sign * glm::cross(a.v, other);
  const Vec3 size = crossSize(a.v, other);
  out.x[k] = cross.x, out.y[k] = cross.y, out.c[k] = cross.z;
  out.slack[k] = 4.0 * kDeterminantError * (size.x * space.width + size.y * space.height + size.z);
}

}  // namespace

bool Patch::covers(const Corners& corners, int px, int py) const {
  const Sighted pixel{{px + 0.5, py + 0.5, 1.0}, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    const int sign = sideSeen(corners.at(corner[k]), corners.at(corner[(k + 1) % 3]), pixel);
    if (sign * side * (beyond && k == 0 ? -1 : 1) <= 0) return false;
  }
  return true;
}

double nearnessOf(std::span<const Vec3> mapped, const mesh::Triangle& triangle, const Vec3& pixel) {
  const Vec3& a = mapped[triangle[0]];
  const Vec3 normal = glm::cross(mapped[triangle[1]] - a, mapped[triangle[2]] - a);
  return glm::dot(normal, pixel) / glm::dot(normal, a);
}

bool makePatch(const PixelSpace& space, const Corners& corners, const std::array<std::uint32_t, 3>& corner, bool beyond,
               Patch& out) {
  const Sighted a = corners.at(corner[0]), b = corners.at(corner[1]), c = corners.at(corner[2]);
  const int side = sideSeen(a, b, c);
  if (side == 0) return false;
  out.corner = corner;
  out.side = static_cast<std::int8_t>(side);
  out.beyond = beyond;
  const Vec3 normal = double(side) * glm::cross(b.v - a.v, c.v - c.w * a.v);
  out.x[3] = normal.x, out.y[3] = normal.y, out.c[3] = normal.z;
  out.distance = std::max(0.0, glm::dot(normal, a.v));
  setEdge(space, a, b, beyond ? -side : side, 0, out);
  setEdge(space, b, c, side, 1, out);
  setEdge(space, c, a, side, 2, out);
  return true;
}

void bound(const PixelSpace& space, std::span<const Vec3> points, Patch& out) {
  constexpr double kTiny = 0x1p-40;
  out.x0 = out.y0 = 0, out.x1 = space.width, out.y1 = space.height;
  Vec2 low(space.width, space.height), high(0.0);
  for (const Vec3& p : points) {
    if (!(p.z > kTiny)) return;
    const Vec2 at(p.x / p.z, p.y / p.z);
    low = glm::min(low, at), high = glm::max(high, at);
  }
  constexpr double kMargin = 0.5 + 0x1p-10;  // centres of pixels lie half a pixel inside
  const Vec2 first = glm::clamp(glm::ceil(low - kMargin), Vec2(0.0), Vec2(space.width, space.height));
  const Vec2 last = glm::clamp(glm::floor(high - 1.0 + kMargin) + 1.0, Vec2(0.0), Vec2(space.width, space.height));
  out.x0 = static_cast<int>(first.x), out.y0 = static_cast<int>(first.y);
  out.x1 = static_cast<int>(last.x), out.y1 = static_cast<int>(last.y);
}

}  // namespace umbrage::raster
static_assert(alignof(umbrage::raster::Patch) == 32 && sizeof(umbrage::raster::Patch) % 32 == 0);
