#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "umbrage/image/image.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/shadow/facing.hpp"
#include "umbrage/shadow/technique.hpp"

// A few boxes with all that makes shadows hard, eyes and lights for it, and the truth by brute force.
namespace umbrage::support {

constexpr int kWidth = 160, kHeight = 90;

// ---- scenes ----

inline std::shared_ptr<mesh::Mesh> boxMesh() {
  auto m = std::make_shared<mesh::Mesh>();
  for (int i = 0; i < 8; ++i) m->positions.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  m->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

inline scene::Instance box(const Vec3& at, const Vec3& size) {
  Mat4 m(1.0);
  for (int k = 0; k < 3; ++k) m[k][k] = size[k];
  m[3] = Vec4(at, 1.0);
  return {"box", 0, m, true};
}

// Three boxes, two of which touch, and an open sheet above them.
inline scene::Scene village() {
  scene::Scene s;
  s.meshes = {boxMesh(), std::make_shared<mesh::Mesh>()};
  auto sheet = std::make_shared<mesh::Mesh>();
  sheet->positions = {{0, 0, 5}, {2, 0.3, 5.2}, {2.2, 2, 5.4}, {0.1, 1.8, 5.1}};
  sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
  s.meshes[1] = sheet;
  s.materials = {{"wall", Vec3(0.8, 0.5, 0.3), 1.0}};
  s.instances = {box({0, 0, 0}, {2, 2, 3}), box({2, 0.5, 0}, {1, 1, 1.5}), box({-3, 4, 0}, {1, 3, 4}), {"sheet", 1}};
  return scene::withGround(std::move(s));
}

inline scene::Camera cameraFrom(const Vec3& eye, const Vec3& target) {
  scene::Camera c;
  c.eye = eye;
  c.target = target;
  c.width = kWidth;
  c.height = kHeight;
  return c;
}

// ---- the truth, by brute force in double precision ----

struct Truth {
  const scene::Surfaces& surfaces;

  // The first triangle that origin + t * ray hits with t in (from, to); its index, or kNoTriangle.
  std::uint32_t hit(const Vec3& origin, const Vec3& ray, double from, double to, bool castersOnly,
                    double* where = nullptr) const {
    std::uint32_t best = shadow::kNoTriangle;
    for (std::uint32_t i = 0; i < surfaces.triangles.size(); ++i) {
      if (castersOnly && surfaces.casts[i] == 0) continue;
      const Vec3 a = surfaces.corner(i, 0), e = surfaces.corner(i, 1) - a, f = surfaces.corner(i, 2) - a;
      const Vec3 p = glm::cross(ray, f), s = origin - a, q = glm::cross(s, e);
      const double det = glm::dot(e, p);
      const double u = glm::dot(s, p) / det, v = glm::dot(ray, q) / det, t = glm::dot(f, q) / det;
      if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > from && t < to)) continue;
      to = t;
      best = i;
    }
    if (where != nullptr) *where = to;
    return best;
  }

  // Pixels at a shadow edge of `mask`, and those with a neighbour that does not lie in the plane they see: depth edges.
  image::GreyImage edges(const scene::Camera& camera, const shadow::LightMask& mask) const {
    image::GreyImage edges = shadow::edgePixels(mask);
    const Vec3 eye = camera.eye - surfaces.origin;
    const scene::PixelRays rays = scene::pixelRays(camera);
    const double none = std::numeric_limits<double>::infinity();
    image::Image<std::uint32_t> seen(camera.width, camera.height);
    image::Image<double> depth(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        seen(x, y) = hit(eye, rays.through(x + 0.5, y + 0.5), 0.0, none, false, &depth(x, y));
    const auto leaves = [&](int x, int y, int u, int v) {
      if (!seen.contains(u, v) || seen(x, y) == shadow::kNoTriangle || seen(u, v) == shadow::kNoTriangle) return false;
      const Vec3 n = glm::normalize(surfaces.normal(seen(x, y)));
      const Vec3 beside = eye + depth(u, v) * rays.through(u + 0.5, v + 0.5);
      return std::abs(glm::dot(n, beside - surfaces.corner(seen(x, y), 0))) > 1e-5 * surfaces.casterBounds.radius();
    };
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        if (leaves(x, y, x + 1, y) || leaves(x, y, x - 1, y) || leaves(x, y, x, y + 1) || leaves(x, y, x, y - 1))
          edges(x, y) = 255;
    return edges;
  }

  shadow::LightMask mask(const scene::Camera& camera, const scene::Light& light) const {
    const Vec3 eye = camera.eye - surfaces.origin;
    const Vec4 lamp = scene::homogeneous(light, surfaces.origin);
    const auto facing = shadow::visibleSideFacesLight(surfaces, Vec4(eye, 1.0), lamp);
    const scene::PixelRays rays = scene::pixelRays(camera);
    shadow::LightMask m{
        image::GreyImage(camera.width, camera.height), {}, image::GreyImage(camera.width, camera.height)};
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const Vec3 ray = rays.through(x + 0.5, y + 0.5);
        double t = 0.0;
        const auto seen = hit(eye, ray, 0.0, std::numeric_limits<double>::infinity(), false, &t);
        if (seen == shadow::kNoTriangle) continue;
        m.covered(x, y) = 1;
        const Vec3 p = eye + t * ray;
        if (facing[seen] == 0 || !scene::insideCone(light, p + surfaces.origin)) continue;
        const double far = lamp.w == 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
        if (hit(p, scene::towardsLight(lamp, p), 1e-9, far, true) == shadow::kNoTriangle) m.light(x, y) = 255;
      }
    return m;
  }
};

struct Light3 {
  const char* name;
  scene::Light light;
};
inline std::vector<Light3> lights() {
  return {{"sun", {scene::DirectionalLight{{0.5, 0.3, -0.8}}}},
          {"low sun", {scene::DirectionalLight{{-1.0, 0.2, -0.1}}}},
          {"lamp", {scene::PointLight{{3.7, -1.2, 6.0}}}},
          {"lamp among the boxes", {scene::PointLight{{-0.7, 1.1, 1.3}}}},
          {"spot", {scene::SpotLight{{4, -3, 7}, {-0.5, 0.6, -1}, Angle::degrees(25)}}},
          {"wide spot", {scene::SpotLight{{4, -3, 7}, {-0.5, 0.6, -1}, Angle::degrees(100)}}}};
}

struct Eye {
  const char* name;
  scene::Camera camera;
};
inline std::vector<Eye> eyes() {
  return {{"outside", cameraFrom({9, -11, 7}, {0, 1, 1})},
          {"low in a shadow", cameraFrom({2.5, 2.3, 0.2}, {-1, 4, 1})},
          {"near a wall", cameraFrom({-0.01, 1.03, 0.9}, {-3, 5, 2})},
          {"from above", cameraFrom({0.3, 0.2, 30}, {0.4, 0.5, 0})},
          {"inside a box", cameraFrom({1.1, 0.9, 1.2}, {0.2, 1.9, 0.4})}};
}

}  // namespace umbrage::support
