#include "umbrage/shadow/true_edges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace umbrage::shadow {
namespace {

// A depth edge is a gap of more than this many samples' width.
constexpr double kGap = 2.0;

struct Samples {
  const scene::Surfaces& surfaces;
  const SurfaceBuffer& seen;
  const LightMask& truth;
  Vec3 eye;  ///< relative to the origin of the surfaces
  scene::PixelRays rays;

  /// Depth at which the ray through sample (x, y) meets the plane of a triangle; not finite when it runs along it.
  [[nodiscard]] double depthOfPlane(std::uint32_t triangle, int x, int y) const {
    const Vec3 normal = surfaces.normal(triangle);
    return glm::dot(surfaces.corner(triangle, 0) - eye, normal) / glm::dot(rays.through(x + 0.5, y + 0.5), normal);
  }

  [[nodiscard]] bool depthJumps(int x0, int y0, int x1, int y1) const {
    const std::uint32_t a = seen.triangle(x0, y0), b = seen.triangle(x1, y1);
    if (a == b || a == kNoTriangle) return false;
    const double depthA = seen.depth(x0, y0), depthB = seen.depth(x1, y1);
    const double atA = depthA - depthOfPlane(b, x0, y0), atB = depthOfPlane(a, x1, y1) - depthB;
    if (!std::isfinite(atA) || !std::isfinite(atB)) return true;
    const double width = glm::length(rays.dx) * std::max(depthA, depthB);
    return atA * atB > 0.0 && std::min(std::abs(atA), std::abs(atB)) > kGap * width;
  }

  [[nodiscard]] bool edgeBetween(int x0, int y0, int x1, int y1) const {
    return truth.light(x0, y0) != truth.light(x1, y1) || truth.covered(x0, y0) != truth.covered(x1, y1) ||
           depthJumps(x0, y0, x1, y1);
  }
};

}  // namespace

scene::Camera divided(scene::Camera camera, int factor) {
  camera.width *= factor;
  camera.height *= factor;
  return camera;
}

scene::Camera magnified(const scene::Camera& camera, double x, double y, int samples) {
  const scene::PixelRays rays = scene::pixelRays(camera);
  const auto through = [&](double dx, double dy) { return glm::normalize(rays.through(x + dx, y + dy)); };
  const Vec3 centre = through(0, 0);
  double half = 1.0;
  for (const auto& [dx, dy] : {std::pair(1.5, 0.0), std::pair(-1.5, 0.0), std::pair(0.0, 1.5), std::pair(0.0, -1.5)})
    half = std::min(half, glm::length(through(dx, dy) - centre));
  scene::Camera out = camera;
  out.target = out.eye + centre * glm::length(camera.target - camera.eye);
  out.up = scene::basis(camera).up;
  out.fovY = Angle::radians(2.0 * half);
  out.width = out.height = 3 * samples;
  return out;
}

image::GreyImage trueEdges(const scene::Surfaces& surfaces, const scene::Camera& camera, int factor,
                           const SurfaceBuffer& seen, const LightMask& truth) {
  const scene::Camera fine = divided(camera, factor);
  UMBRAGE_CHECK(truth.light.width() == fine.width && truth.light.height() == fine.height &&
                    seen.triangle.width() == fine.width && seen.triangle.height() == fine.height,
                "the truth is not of the divided view");
  const Samples samples{surfaces, seen, truth, camera.eye - surfaces.origin, scene::pixelRays(fine)};
  image::GreyImage edges(camera.width, camera.height);
  const auto mark = [&](int x0, int y0, int x1, int y1) {
    if (x1 < fine.width && y1 < fine.height && samples.edgeBetween(x0, y0, x1, y1))
      edges(x0 / factor, y0 / factor) = edges(x1 / factor, y1 / factor) = 255;
  };
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      mark(x, y, x + 1, y);
      mark(x, y, x, y + 1);
    }
  }
  return edges;
}

}  // namespace umbrage::shadow
