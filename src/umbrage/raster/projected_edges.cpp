#include "umbrage/raster/projected_edges.hpp"

#include <cmath>

namespace umbrage::raster {
namespace {

// Of what a plane's distance from a point is summed up of, the part that may be rounding: a surface does not hide itself, nor its neighbour along
// the edge they share.
constexpr double kTouching = 0x1p-38;

Stretch notAbove(const Slope& function, const Stretch& within) {
  const Stretch rest = above(function, 0.0, within);
  if (rest.empty()) return within;
  return rest.begin == within.begin ? Stretch{rest.end, within.end} : Stretch{within.begin, rest.begin};
}

Slope turned(const Slope& s, int sign) { return {sign * s.at0, sign * s.perPixel}; }

}  // namespace

SurfaceRow surfaceRow(const PixelSpace& space, const Patch& surface, int y) {
  return {alongRow(surface, 3, y), y,
          std::abs(surface.c[3]) + std::abs(surface.y[3]) * space.height + std::abs(surface.x[3]) * space.width};
}

ProjectedEdges::Plane ProjectedEdges::planeThrough(const Vec3& a, const Vec3& along, const Vec3& other) {
  const Vec3 normal = glm::cross(along, other);
  return {normal, -glm::dot(normal, a)};
}

ProjectedEdges::ProjectedEdges(const PixelSpace& space, const shadow::CasterSet& casters,
                               std::span<const std::int8_t> side, const Corners& corners)
    : width_(space.width), height_(space.height), casters_(casters.triangles.size()) {
  const Sighted& light = corners.light;
  for (std::uint32_t t = 0; t < casters_.size(); ++t) {
    if (side[t] == 0) continue;
    const mesh::Triangle& corner = casters.triangles[t];
    const Vec3 &a = corners.mapped[corner[0]], &b = corners.mapped[corner[1]], &c = corners.mapped[corner[2]];
    const auto toLight = [&](const Vec3& p) { return light.v - light.w * p; };
    // Every edge runs from its lesser corner to its greater, whichever triangle asks.
    casters_[t] = {planeThrough(a, b - a, c - a), planeThrough(a, b - a, toLight(a)),
                   planeThrough(b, c - b, toLight(b)), planeThrough(a, c - a, toLight(a)), 0};
    const double value = glm::dot(casters_[t].own.normal, toLight(a));
    casters_[t].towards = value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
  }
}

Stretch ProjectedEdges::shadow(std::uint32_t triangle, const SurfaceRow& surface, Stretch pixels) const {
  const Caster& caster = casters_[triangle];
  if (caster.towards == 0) return {};
  const Vec3 n = glm::abs(caster.own.normal);
  const double size = n.x * width_ + n.y * height_ + n.z + std::abs(caster.own.level) * surface.size;
  pixels = above(turned(caster.own.along(surface), -caster.towards), kTouching * size, pixels);
  const bool up = caster.towards > 0;
  for (const Plane* plane : {&caster.ab, &caster.bc}) {
    if (pixels.empty()) return {};
    pixels = up ? notAbove(plane->along(surface), pixels) : above(plane->along(surface), 0.0, pixels);
  }
  if (pixels.empty()) return {};
  return up ? above(caster.ac.along(surface), 0.0, pixels) : notAbove(caster.ac.along(surface), pixels);
}

}  // namespace umbrage::raster
