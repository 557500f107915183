#include "umbrage/shadow/contours.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "umbrage/math/predicates.hpp"

namespace umbrage::shadow {
namespace {

// What of a segment lies nearer to the plane of the eye than this share of its length is not looked at.
constexpr double kLeastDepth = 1e-9;

struct Lens {
  explicit Lens(const scene::Camera& camera) : forward(scene::basis(camera).forward), rays(scene::pixelRays(camera)) {}

  [[nodiscard]] double depth(const Vec3& p) const { return glm::dot(p, forward); }

  // Pixel coordinates, and the depth.
  [[nodiscard]] Vec3 project(const Vec3& p) const {
    const Vec3 fromCorner = p / depth(p) - rays.corner;
    return {glm::dot(fromCorner, rays.dx) / glm::dot(rays.dx, rays.dx),
            glm::dot(fromCorner, rays.dy) / glm::dot(rays.dy, rays.dy), depth(p)};
  }

  // The point of the segment that is nearest to (x, y) in the picture; none when it lies behind the eye.
  [[nodiscard]] std::optional<ContourPoint> nearest(Vec3 a, Vec3 b, double x, double y) const {
    const double depthA = depth(a), depthB = depth(b), least = kLeastDepth * std::max(depthA, depthB);
    if (least <= 0.0) return std::nullopt;
    if (depthA < least)
      a += (b - a) * ((least - depthA) / (depthB - depthA));
    else if (depthB < least)
      b += (a - b) * ((least - depthB) / (depthA - depthB));
    const Vec3 p = project(a), q = project(b);
    const double dx = q.x - p.x, dy = q.y - p.y, square = dx * dx + dy * dy;
    const double s = square > 0.0 ? std::clamp(((x - p.x) * dx + (y - p.y) * dy) / square, 0.0, 1.0) : 0.0;
    // Where that is along the segment in space: 1 / depth is what varies evenly in the picture.
    const double t = s / q.z / ((1.0 - s) / p.z + s / q.z);
    return ContourPoint{p.x + s * dx, p.y + s * dy, a + t * (b - a)};
  }

  Vec3 forward;
  scene::PixelRays rays;
};

}  // namespace

Contours::Contours(const scene::Surfaces& surfaces)
    : surfaces_(surfaces), edges_(mesh::buildEdgeTable(surfaces.triangles)) {}

bool Contours::turnsAway(std::size_t edge, const Vec4& from) const {
  int sum = 0;
  for (const mesh::EdgeUse& use : edges_.usesOf(edge)) {
    const int side = lightSide(surfaces_.corner(use.triangle, 0), surfaces_.corner(use.triangle, 1),
                               surfaces_.corner(use.triangle, 2), from);
    sum += use.opposite == 1 ? -side : side;  // corners are sorted: past the middle one the edge runs the other way
  }
  return edges_.usesOf(edge).size() != 2 || sum != 0;
}

std::vector<ContourPoint> Contours::near(const scene::Camera& camera, const scene::Light& light, double x, double y,
                                         double pixels) const {
  const Vec3 eye = camera.eye - surfaces_.origin;
  const Vec4 fromLight = scene::homogeneous(light, surfaces_.origin);
  const Lens lens(camera);
  std::vector<ContourPoint> points;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [i, j] = edges_.ends[e];
    const auto point = lens.nearest(Vec3(surfaces_.positions[i]) - eye, Vec3(surfaces_.positions[j]) - eye, x, y);
    if (point && std::hypot(point->x - x, point->y - y) <= pixels &&
        (turnsAway(e, Vec4(eye, 1.0)) || turnsAway(e, fromLight)))
      points.push_back(*point);
  }
  return points;
}

}  // namespace umbrage::shadow
