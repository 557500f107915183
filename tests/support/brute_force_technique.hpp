#pragma once

#include <cmath>
#include <limits>

#include "umbrage/shadow/facing.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::support {

/// The light mask by its definition, every ray against every triangle in double precision: for scenes of a few
/// triangles.
class BruteForceTechnique final : public shadow::Technique {
 public:
  [[nodiscard]] const shadow::Traits& traits() const override { return traits_; }

  [[nodiscard]] Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    geometry_ = std::move(geometry);
    ++prepared;
    return {};
  }

  [[nodiscard]] Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    const auto& surfaces = geometry_->surfaces;
    const int width = frame.camera.width, height = frame.camera.height;
    const Vec3 eye = frame.camera.eye - surfaces.origin;
    const auto rays = scene::pixelRays(frame.camera);
    shadow::Shading out;
    image::Image<Vec3> points(width, height);
    out.surface.triangle = image::Image<std::uint32_t>(width, height, shadow::kNoTriangle);
    out.surface.depth = image::Image<float>(width, height, std::numeric_limits<float>::infinity());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Hit hit = nearest(eye, rays.through(x + 0.5, y + 0.5), false);
        out.surface.triangle(x, y) = hit.triangle;
        out.surface.depth(x, y) = static_cast<float>(hit.t);
        points(x, y) = eye + hit.t * rays.through(x + 0.5, y + 0.5);
      }
    for (const scene::Light& light : frame.lights) out.masks.push_back(mask(out.surface, points, light, eye));
    return out;
  }

  int prepared = 0;

 private:
  struct Hit {
    std::uint32_t triangle = shadow::kNoTriangle;
    double t = std::numeric_limits<double>::infinity();
  };

  /// Source: Moeller and Trumbore, fast minimum storage ray/triangle intersection, 1997.
  [[nodiscard]] Hit nearest(const Vec3& from, const Vec3& along, bool castersOnly) const {
    const auto& s = geometry_->surfaces;
    Hit best;
    for (std::uint32_t i = 0; i < s.triangles.size(); ++i) {
      if (castersOnly && s.casts[i] == 0) continue;
      const Vec3 a = s.corner(i, 0), ab = s.corner(i, 1) - a, ac = s.corner(i, 2) - a;
      const Vec3 p = glm::cross(along, ac);
      const double det = glm::dot(ab, p);
      if (det == 0.0) continue;
      const Vec3 rel = from - a, q = glm::cross(rel, ab);
      const double u = glm::dot(rel, p) / det, v = glm::dot(along, q) / det, t = glm::dot(ac, q) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && t > 1e-9 && t < best.t) best = {i, t};
    }
    return best;
  }

  [[nodiscard]] shadow::LightMask mask(const shadow::SurfaceBuffer& seen, const image::Image<Vec3>& points,
                                       const scene::Light& light, const Vec3& eye) const {
    const auto& surfaces = geometry_->surfaces;
    const Vec4 homogeneous = scene::homogeneous(light, surfaces.origin);
    const auto facing = shadow::visibleSideFacesLight(surfaces, Vec4(eye, 1.0), homogeneous);
    shadow::LightMask mask{image::GreyImage(seen.depth.width(), seen.depth.height()), {}, {}};
    mask.covered = mask.light;
    for (int y = 0; y < seen.depth.height(); ++y)
      for (int x = 0; x < seen.depth.width(); ++x) {
        const std::uint32_t triangle = seen.triangle(x, y);
        if (triangle == shadow::kNoTriangle) continue;
        mask.covered(x, y) = 1;
        if (facing[triangle] == 0) continue;
        const Vec3 towards = scene::towardsLight(homogeneous, points(x, y));
        mask.light(x, y) = nearest(points(x, y), towards, true).triangle == shadow::kNoTriangle ? 255 : 0;
      }
    return mask;
  }

  shadow::Traits traits_{.name = "brute_force", .summary = "Every ray against every triangle."};
  std::shared_ptr<const shadow::Geometry> geometry_;
};

}  // namespace umbrage::support
