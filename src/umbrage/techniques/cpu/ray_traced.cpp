#include <array>
#include <chrono>
#include <cmath>

#include "umbrage/shadow/facing.hpp"
#include "umbrage/techniques/cpu/detail/ray_traced.hpp"
#include "umbrage/trace/light_rays.hpp"
#include "umbrage/trace/tiles.hpp"
#include "umbrage/trace/visible_surfaces.hpp"

namespace umbrage::techniques::detail {
namespace {

using Clock = std::chrono::steady_clock;

// Shadow borders may be displaced by this part of a pixel's width where a ray's start is lifted off its surface.
constexpr double kPixelPart = 0.125;
// Below this sine between view and surface the plane says less about the depth than the surface buffer does.
constexpr double kEdgeOn = 1e-4;
// Far above what double arithmetic loses and what visibleSideFacesLight takes as edge-on (2^-20).
constexpr double kSurely = 0x1p-18;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A triangle's plane: points p with dot(normal, p) = offset; the normal is of unit length, or zero.
struct Plane {
  Vec3 normal;
  double offset;
};

std::vector<Plane> planesOf(const scene::Surfaces& surfaces) {
  std::vector<Plane> planes(surfaces.triangles.size());
  for (std::uint32_t t = 0; t < planes.size(); ++t) {
    const Vec3 normal = surfaces.normal(t);
    const double length = glm::length(normal);
    const Vec3 unit = length > 0.0 ? normal / length : Vec3(0.0);
    planes[t] = {unit, glm::dot(unit, surfaces.corner(t, 0))};
  }
  return planes;
}

/// Signed distances from a triangle's plane of the eye and of the light (for a direction: the sine of its elevation).
struct Heights {
  double eye, light;
};
Heights heightsOver(const Plane& plane, const Vec3& eye, const Vec4& light) {
  return {glm::dot(plane.normal, eye) - plane.offset, glm::dot(plane.normal, Vec3(light)) - plane.offset * light.w};
}

/// A triangle as one eye and one light see it.
struct LitFace {
  Vec3 normal{0.0};  ///< of unit length, on the side of both; zero when they are on different sides or it is edge-on
  double eyeHeight = 0.0;
};

// shadow::visibleSideFacesLight, told by the planes wherever they leave no doubt: it costs a fraction, and differs nowhere, since
// it decides only heights of more than kSurely of the lengths they are computed from.
std::vector<LitFace> litFaces(const scene::Surfaces& surfaces, const std::vector<Plane>& planes, const Vec3& eye,
                              const Vec4& light) {
  std::vector<LitFace> faces(planes.size());
  const double reach = glm::length(glm::max(glm::abs(surfaces.bounds.min), glm::abs(surfaces.bounds.max)));
  const double sureOfEye = kSurely * (glm::length(eye) + reach);
  const double sureOfLight = kSurely * (glm::length(Vec3(light)) + light.w * reach);
  for (std::uint32_t t = 0; t < planes.size(); ++t) {
    const Heights h = heightsOver(planes[t], eye, light);
    const bool sure = std::abs(h.eye) > sureOfEye && std::abs(h.light) > sureOfLight;
    const bool lit =
        sure ? (h.eye > 0.0) == (h.light > 0.0) : shadow::visibleSideFacesLight(surfaces, t, Vec4(eye, 1.0), light);
    if (lit) faces[t] = {h.eye > 0.0 ? planes[t].normal : -planes[t].normal, std::abs(h.eye)};
  }
  return faces;
}

/// What the pixels of one light's mask are computed from.
struct Shadowing {
  const scene::Surfaces& surfaces;
  const shadow::SurfaceBuffer& seen;
  const trace::LightRays& lightRays;
  const scene::Light& light;
  bool spot;
  std::vector<LitFace> faces;  ///< per triangle
  Vec3 eye;                    ///< relative to the origin of the surfaces
  scene::PixelRays rays;
  std::array<Vec3, 8> step;  ///< from the direction through a packet's first pixel to its others
  double precision;          ///< of shadow borders, at depth 1
};

std::array<Vec3, 8> stepsOf(const scene::PixelRays& rays) {
  std::array<Vec3, 8> step;
  for (int k = 0; k < 8; ++k) step[static_cast<std::size_t>(k)] = double(k & 3) * rays.dx + double(k >> 2) * rays.dy;
  return step;
}

void shadePacket(const Shadowing& s, const trace::Tile& tile, int x, int y, image::GreyImage& lit) {
  trace::SurfacePoints8 points;
  const Vec3 corner = s.rays.through(x + 0.5, y + 0.5);
  trace::forEachLane(tile, x, y, [&](int lane, int px, int py) {
    const std::uint32_t triangle = s.seen.triangle(px, py);
    if (triangle == shadow::kNoTriangle) return;
    const LitFace& face = s.faces[triangle];
    if (face.normal == Vec3(0.0)) return;
    const Vec3 direction = corner + s.step[static_cast<std::size_t>(lane)];
    // The point that the pixel's centre shows, in double precision.
    const double slope = glm::dot(face.normal, direction), seen = s.seen.depth(px, py);
    const double depth = std::abs(slope) < kEdgeOn ? seen : -face.eyeHeight / slope;
    const Vec3 point = s.eye + depth * direction;
    if (s.spot && !scene::insideCone(s.light, point + s.surfaces.origin)) return;
    const auto k = static_cast<std::size_t>(lane);
    points.position[k] = point;
    points.normal[k] = face.normal;
    points.triangle[k] = triangle;
    points.precision[k] = s.precision * seen;
    points.active |= 1u << lane;
  });
  if (points.active == 0) return;
  const std::uint32_t lanes = points.active & ~s.lightRays.hidden(points);
  trace::forEachLane(tile, x, y, [&](int lane, int px, int py) {
    if ((lanes >> lane & 1u) != 0) lit(px, py) = 255;
  });
}

void markCovered(const shadow::SurfaceBuffer& seen, const trace::Tile& tile, image::GreyImage& covered) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    const std::uint32_t* triangle = seen.triangle.row(y);
    std::uint8_t* row = covered.row(y);
    for (int x = tile.x0; x < tile.x1; ++x) row[x] = triangle[x] != shadow::kNoTriangle ? 1 : 0;
  }
}

class RayTraced final : public shadow::Technique {
 public:
  RayTraced() : traits_(rayTracedTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    auto built = trace::Occlusion::build({geometry, &geometry->surfaces});
    if (!built) return tl::unexpected(built.error());
    planes_ = planesOf(geometry->surfaces);
    occlusion_.emplace(std::move(*built));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(occlusion_.has_value(), "shade() before prepare()");
    const auto start = Clock::now();
    auto seen = trace::visibleSurfaces(*occlusion_, frame.camera);
    if (!seen) return tl::unexpected(seen.error());
    shadow::Shading out;
    out.surface = std::move(*seen);
    out.stats.phases.push_back({"surface", millisecondsSince(start)});
    for (const scene::Light& light : frame.lights) {
      const auto begin = Clock::now();
      auto mask = maskOf(frame.camera, light, out.surface);
      if (!mask) return tl::unexpected(mask.error());
      out.masks.push_back(std::move(*mask));
      out.stats.phases.push_back({"shadow", millisecondsSince(begin)});
      out.stats.lights.push_back({"ray_traced", "one ray per lit-facing pixel towards the light", 0, 0, 0, 0, 0});
    }
    return out;
  }

 private:
  Result<shadow::LightMask> maskOf(const scene::Camera& camera, const scene::Light& light,
                                   const shadow::SurfaceBuffer& seen) const {
    const scene::Surfaces& surfaces = occlusion_->surfaces();
    const trace::LightRays lightRays(*occlusion_, light);
    const Vec3 eye = camera.eye - surfaces.origin;
    const scene::PixelRays rays = scene::pixelRays(camera);
    const Shadowing s{surfaces,
                      seen,
                      lightRays,
                      light,
                      std::holds_alternative<scene::SpotLight>(light.shape),
                      litFaces(surfaces, planes_, eye, lightRays.light()),
                      eye,
                      rays,
                      stepsOf(rays),
                      kPixelPart * std::min(glm::length(rays.dx), glm::length(rays.dy))};
    shadow::LightMask mask{{camera.width, camera.height}, {}, {camera.width, camera.height}};
    const auto done = trace::forEachTile(camera.width, camera.height, [&](const trace::Tile& tile) {
      markCovered(seen, tile, mask.covered);
      for (int y = tile.y0; y < tile.y1; y += 2)
        for (int x = tile.x0; x < tile.x1; x += 4) shadePacket(s, tile, x, y, mask.light);
    });
    if (!done) return tl::unexpected(done.error());
    return mask;
  }

  shadow::Traits traits_;
  std::optional<trace::Occlusion> occlusion_;
  std::vector<Plane> planes_;
};

}  // namespace

shadow::Traits rayTracedTraits() {
  shadow::Traits traits;
  traits.name = "ray_traced";
  traits.summary =
      "One ray from every visible surface point to the light (Embree): the truth all others are judged by.";
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeRayTraced() { return std::make_unique<RayTraced>(); }

}  // namespace umbrage::techniques::detail
