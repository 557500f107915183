#include "umbrage/coin/detail/ray_masks.hpp"

#include "umbrage/shadow/facing.hpp"
#include "umbrage/shadow/surface_buffer.hpp"
#include "umbrage/trace/light_rays.hpp"
#include "umbrage/trace/tiles.hpp"

namespace umbrage::coin::detail {
namespace {

// A shadow's border may be displaced by this part of a pixel.
constexpr double kBorder = 1.0 / 64.0;
// How far behind a surface that is looked through a ray goes on, of what it came so far.
constexpr double kStep = 1e-9;

/// What the pixels of one light's mask are computed from.
struct Shadowing {
  const trace::Occlusion& occlusion;
  const View& view;
  const SeenPoints& seen;
  const scene::Light& light;
  Vec4 towards;
  std::vector<std::uint8_t> facing;
  trace::LightRays rays;
};

std::optional<trace::Hit> firstSeen(const trace::Occlusion& occlusion, Vec3 from, const Vec3& direction,
                                    const Unseen& unseen) {
  double passed = 0.0;
  for (;;) {
    const auto hit = occlusion.nearest(from + passed * direction, direction);
    if (!hit || !unseen(hit->triangle)) {
      if (!hit) return hit;
      return trace::Hit{hit->triangle, passed + hit->at};
    }
    passed += hit->at + kStep * std::max(1e-3, passed + hit->at);
  }
}

Vec3 unitNormal(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec3& from, const Vec4& light) {
  const Vec3 normal = glm::normalize(surfaces.normal(triangle));
  return glm::dot(normal, scene::towardsLight(light, from)) < 0.0 ? -normal : normal;
}

double pixelSize(const View& view, const Vec3& point, int x, int y) {
  const ViewRay here = rayThrough(view, x + 0.5, y + 0.5), beside = rayThrough(view, x + 1.5, y + 0.5);
  const double along = glm::length(point - here.from) / glm::length(here.direction);
  return glm::length((beside.from - here.from) + along * (beside.direction - here.direction));
}

bool isLit(const Shadowing& s, int x, int y) {
  const std::uint32_t triangle = s.seen.triangle(x, y);
  if (triangle == shadow::kNoTriangle || s.facing[triangle] == 0) return false;
  const Vec3 point = s.seen.point(x, y);
  return scene::insideCone(s.light, point + s.occlusion.surfaces().origin);
}

void fill(const Shadowing& s, const trace::Tile& tile, int x, int y, trace::SurfacePoints8& points) {
  points.active = 0;
  points.triangle.fill(shadow::kNoTriangle);
  const scene::Surfaces& surfaces = s.occlusion.surfaces();
  for (std::size_t k = 0; k < 8; ++k) {  // lanes that are off must hold numbers all the same
    points.position.set(k, Vec3(0.0));
    points.normal.set(k, Vec3(0.0, 0.0, 1.0));
    points.precision[k] = points.reach[k] = 0.0;
  }
  trace::forEachLane(tile, x, y, [&](int lane, int px, int py) {
    if (!isLit(s, px, py)) return;
    const auto k = static_cast<std::size_t>(lane);
    const std::uint32_t triangle = s.seen.triangle(px, py);
    const Vec3 point = s.seen.point(px, py);
    points.active |= 1u << k;
    points.triangle[k] = triangle;
    points.position.set(k, point);
    points.normal.set(k, unitNormal(surfaces, triangle, point, s.towards));
    points.precision[k] = kBorder * pixelSize(s.view, point + surfaces.origin, px, py);
    points.reach[k] = surfaces.casts[triangle] != 0 ? double(s.occlusion.reach(triangle)) : 0.0;
  });
}

void shade(const Shadowing& s, const trace::Tile& tile, image::GreyImage& lit) {
  trace::SurfacePoints8 points;
  for (int y = tile.y0; y < tile.y1; y += 2) {
    for (int x = tile.x0; x < tile.x1; x += 4) {
      fill(s, tile, x, y, points);
      if (points.active == 0) continue;
      const std::uint32_t reached = points.active & ~s.rays.hidden(points);
      trace::forEachLane(tile, x, y, [&](int k, int px, int py) {
        if (trace::hasLane(reached, static_cast<std::size_t>(k))) lit(px, py) = 255;
      });
    }
  }
}

}  // namespace

Result<SeenPoints> look(const trace::Occlusion& occlusion, const View& view, const Unseen& unseen,
                        const image::GreyImage* where) {
  SeenPoints seen{image::Image<std::uint32_t>(view.width, view.height, shadow::kNoTriangle),
                  image::Image<Vec3>(view.width, view.height)};
  const Vec3 origin = occlusion.surfaces().origin;
  auto done = trace::forEachTile(view.width, view.height, [&](const trace::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        if (where != nullptr && (*where)(x, y) == 0) continue;
        const ViewRay ray = rayThrough(view, x + 0.5, y + 0.5);
        const auto hit = firstSeen(occlusion, ray.from - origin, ray.direction, unseen);
        if (!hit) continue;
        seen.triangle(x, y) = hit->triangle;
        seen.point(x, y) = ray.from - origin + hit->at * ray.direction;
      }
    }
  });
  if (!done) return tl::unexpected(done.error());
  return seen;
}

Result<shadow::LightMask> rayMask(const trace::Occlusion& occlusion, const View& view, const SeenPoints& seen,
                                  const scene::Light& light) {
  const scene::Surfaces& surfaces = occlusion.surfaces();
  const Vec4 towards = scene::homogeneous(light, surfaces.origin);
  const Vec4 eye(Vec3(view.eye) - surfaces.origin * view.eye.w, view.eye.w);
  const Shadowing shadowing{occlusion,
                            view,
                            seen,
                            light,
                            towards,
                            shadow::visibleSideFacesLight(surfaces, eye, towards),
                            trace::LightRays(occlusion, light)};
  shadow::LightMask mask{image::GreyImage(view.width, view.height), {}, image::GreyImage(view.width, view.height)};
  for (std::size_t i = 0; i < mask.covered.size(); ++i)
    mask.covered.pixels()[i] = seen.triangle.pixels()[i] != shadow::kNoTriangle ? 1 : 0;
  auto done =
      trace::forEachTile(view.width, view.height, [&](const trace::Tile& tile) { shade(shadowing, tile, mask.light); });
  if (!done) return tl::unexpected(done.error());
  return mask;
}

void cutCone(shadow::LightMask& mask, const scene::Light& light, const View& view, const scene::Surfaces& surfaces,
             const image::Image<std::uint32_t>& triangle) {
  if (!std::holds_alternative<scene::SpotLight>(light.shape)) return;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      if (mask.light(x, y) == 0 || triangle(x, y) == shadow::kNoTriangle) continue;
      const ViewRay ray = rayThrough(view, x + 0.5, y + 0.5);
      const Vec3 normal = surfaces.normal(triangle(x, y)), from = ray.from - surfaces.origin;
      const double at = glm::dot(normal, surfaces.corner(triangle(x, y), 0) - from) / glm::dot(normal, ray.direction);
      if (!scene::insideCone(light, ray.from + at * ray.direction)) mask.light(x, y) = 0;
    }
  }
}

}  // namespace umbrage::coin::detail
