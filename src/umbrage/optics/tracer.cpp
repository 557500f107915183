#include "umbrage/optics/tracer.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/optics/interface.hpp"
#include "umbrage/shadow/facing.hpp"
#include "umbrage/trace/tiles.hpp"

namespace umbrage::optics {
namespace {

/// What counts for less is not followed: no 8-bit picture shows it.
constexpr double kLeastWeight = 1.0 / 1024.0;
/// A turned ray meets its own surface, or a neighbour at an edge, where rounding says so: within so many resolutions nothing is met.
constexpr double kOwnResolutions = 4.0;

Vec3 linearBackground(const Vec3& srgb) {
  Vec3 linear;
  for (int k = 0; k < 3; ++k)
    linear[k] = shadow::decodeSrgb(static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(srgb[k], 0.0, 1.0))));
  return linear;
}

}  // namespace

Tracer::Tracer(const scene::Scene& scene, trace::Transmission rays, std::span<const scene::Light> lights,
               const Options& options)
    : scene_(scene),
      rays_(std::move(rays)),
      options_(std::make_unique<const Options>(options)),
      painter_(scene, rays_.geometry().surfaces, lights, options_->look),
      background_(linearBackground(options.look.background)) {
  Box3 room = surfaces().bounds;
  if (!room.empty()) room.min += surfaces().origin, room.max += surfaces().origin;
  for (const scene::Light& light : lights) {
    const std::size_t count = scene::isArea(light) ? std::max<std::size_t>(1, options.lightSamples) : 1;
    LightPoints points{shadow::lightSamples(light, 0, count, room), {}};
    for (const auto& sample : points.samples) points.at.push_back(scene::homogeneous(sample.light, surfaces().origin));
    lights_.push_back(std::move(points));
  }
  for (std::uint32_t t = 0; t < surfaces().triangles.size(); ++t)
    if (rays_.geometry().filters.isVeil(t) && scene.materials[surfaces().materials[t]].ior > 1.0) solids_.push_back(t);
  std::ranges::stable_sort(solids_, {}, [&](std::uint32_t t) { return surfaces().instances[t]; });
}

Result<Tracer> Tracer::build(const scene::Scene& scene, std::shared_ptr<const shadow::Geometry> geometry,
                             std::span<const scene::Light> lights, const Options& options) {
  auto rays = trace::Transmission::build(std::move(geometry));
  if (!rays) return tl::unexpected(rays.error());
  return Tracer(scene, std::move(*rays), lights, options);
}

// A point is inside what a ray from it leaves more often than it enters: meets an odd number of times. The direction is any that runs along no edge.
std::vector<std::uint32_t> Tracer::inside(const Vec3& point) const {
  std::vector<std::uint32_t> found;
  const Vec3 way(0.5377, 0.2113, 0.8163);
  for (std::size_t begin = 0, end = 0; begin < solids_.size(); begin = end) {
    std::size_t crossed = 0;
    const std::uint32_t instance = surfaces().instances[solids_[begin]];
    for (; end < solids_.size() && surfaces().instances[solids_[end]] == instance; ++end) {
      const std::uint32_t t = solids_[end];
      crossed +=
          trace::crossing(point, way, {surfaces().corner(t, 0), surfaces().corner(t, 1), surfaces().corner(t, 2)})
              .has_value();
    }
    if (crossed % 2 != 0) found.push_back(solids_[begin]);
  }
  return found;
}

double Tracer::medium(const std::vector<std::uint32_t>& inside) const {
  return inside.empty() ? 1.0 : scene_.materials[surfaces().materials[inside.back()]].ior;
}

Tracer::Meeting Tracer::meet(const Ray& ray, const trace::Hit& hit) const {
  Meeting at;
  painter_.turnTo(hit.triangle, at.face);
  at.point = ray.from + hit.at * ray.direction;
  at.normal = painter_.facing(at.face, at.point, ray.direction).normal;
  // A smooth normal may look away from who looks at the facet.
  const Vec3 flat = glm::dot(at.face.normal, ray.direction) > 0.0 ? -at.face.normal : at.face.normal;
  const Vec3 direction = glm::normalize(ray.direction);
  const bool sensible = glm::dot(at.normal, direction) < 0.0 && glm::dot(reflected(direction, at.normal), flat) > 0.0;
  if (!sensible) at.normal = flat;
  return at;
}

Tracer::Ray Tracer::turned(const Ray& ray, const Meeting& at, const Vec3& direction, double weight) const {
  return {at.point, direction, ray.inside, ray.mirrored, ray.bent, weight};
}

// What of a light reaches a point; `from`: whence it is looked at.
Vec3 Tracer::lit(std::size_t light, const Vec3& from, const Meeting& at) const {
  const LightPoints& points = lights_[light];
  const std::uint32_t triangle = at.face.triangle;
  Vec3 sum(0.0);
  double weights = 0.0;
  for (std::size_t i = 0; i < points.samples.size(); ++i) {
    const Vec3 world = at.point + surfaces().origin;
    const double weight = points.samples[i].weight(world);
    weights += weight;
    if (!shadow::visibleSideFacesLight(surfaces(), triangle, Vec4(from, 1.0), points.at[i])) continue;
    if (!scene::insideCone(points.samples[i].light, world)) continue;
    if (const auto taken = rays_.towards(points.at[i], at.point, triangle))
      sum += weight * Vec3(rays_.geometry().filters.transmitted(*taken));
  }
  return weights > 0.0 ? sum / weights : Vec3(0.0);
}

// Of what is opaque of a surface.
Vec3 Tracer::ownLook(const Ray& ray, const Meeting& at) const {
  const scene::Material& material = *at.face.material;
  const bool mirrors =
      material.mirror > 0.0 && ray.mirrored < options_->reflections && ray.weight * material.mirror >= kLeastWeight;
  Vec3 look(0.0);
  if (!mirrors || material.mirror < 1.0)
    look = painter_.colour(at.face, at.point, ray.direction, [&](std::size_t i) { return lit(i, ray.from, at); });
  if (!mirrors) return look;
  Ray back = turned(ray, at, reflected(glm::normalize(ray.direction), at.normal), ray.weight * material.mirror);
  ++back.mirrored;
  return (1.0 - material.mirror) * look + material.mirror * material.colour * along(back);
}

// What a ray is inside of beyond a surface.
std::vector<std::uint32_t> Tracer::beyond(const Ray& ray, std::uint32_t triangle) const {
  std::vector<std::uint32_t> inside = ray.inside;
  const auto entered = std::ranges::find(inside, surfaces().instances[triangle],
                                         [&](std::uint32_t t) { return surfaces().instances[t]; });
  if (entered != inside.end())
    inside.erase(entered);
  else
    inside.push_back(triangle);
  return inside;
}

bool Tracer::isThrownBack(const Ray& ray, const Meeting& at) const {
  const double to = medium(beyond(ray, at.face.triangle));
  return !refracted(glm::normalize(ray.direction), at.normal, medium(ray.inside), to);
}

// All that comes from an interface.
Vec3 Tracer::atInterface(const Ray& ray, const Meeting& at, const Vec3& own) const {
  const scene::Material& material = *at.face.material;
  const Vec3 direction = glm::normalize(ray.direction);
  std::vector<std::uint32_t> inside = beyond(ray, at.face.triangle);
  const double from = medium(ray.inside), to = medium(inside);
  double thrownBack = reflectance(direction, at.normal, from, to);
  const auto onwards = refracted(direction, at.normal, from, to);
  Vec3 light = material.opacity * own;
  const double clear = 1.0 - material.opacity;
  if (!onwards) {
    Ray back = turned(ray, at, reflected(direction, at.normal), ray.weight * clear);
    ++back.bent;
    return light + clear * along(back);
  }
  const double counts = ray.weight * clear * thrownBack;
  if (ray.mirrored < options_->reflections && counts >= kLeastWeight) {
    Ray back = turned(ray, at, reflected(direction, at.normal), counts);
    ++back.mirrored;
    light += clear * thrownBack * along(back);
  } else {
    thrownBack = 0.0;
  }
  const Vec3 passes = (1.0 - thrownBack) * scene::transmittance(material);
  const double most = ray.weight * std::max({passes.x, passes.y, passes.z});
  if (most < kLeastWeight) return light;
  Ray on = turned(ray, at, *onwards, most);
  on.inside = std::move(inside);
  ++on.bent;
  return light + passes * along(on);
}

Vec3 Tracer::along(const Ray& ray) const {
  std::vector<trace::Hit> hits;
  rays_.look(ray.from, ray.direction, hits);
  const bool isTurned = ray.mirrored + ray.bent > 0;
  const double own = kOwnResolutions * trace::resolution(trace::largest(ray.from));
  Vec3 light(0.0), through(1.0);
  for (const trace::Hit& hit : hits) {
    if (isTurned && hit.at <= own) continue;
    const Meeting at = meet(ray, hit);
    const scene::Material& material = *at.face.material;
    const Vec3 look = material.opacity > 0.0 ? ownLook(ray, at) : Vec3(0.0);
    if (!rays_.geometry().filters.isVeil(hit.triangle)) return light + through * look;
    if (material.ior > 1.0 && options_->refractions > 0) {
      if (ray.bent < options_->refractions) return light + through * atInterface(ray, at, look);
      if (isThrownBack(ray, at)) return light + through * material.opacity * look;
    }
    light += through * material.opacity * look;
    through *= scene::transmittance(material);
  }
  return light + through * background_;
}

Result<image::RgbImage> paint(const scene::Scene& scene, const std::shared_ptr<const shadow::Geometry>& geometry,
                              const scene::Camera& camera, std::span<const scene::Light> lights,
                              const Options& options) {
  const auto tracer = Tracer::build(scene, geometry, lights, options);
  if (!tracer) return tl::unexpected(tracer.error());
  const scene::PixelRays rays = scene::pixelRays(camera);
  const Tracer::From eye = tracer->from(camera.eye - geometry->surfaces.origin);
  image::RgbImage picture(camera.width, camera.height);
  const auto done = trace::forEachTile(camera.width, camera.height, [&](const trace::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const Vec3 c = eye.colour(rays.through(x + 0.5, y + 0.5));
        picture(x, y) = {shadow::encodeSrgb(c.x), shadow::encodeSrgb(c.y), shadow::encodeSrgb(c.z)};
      }
    }
  });
  if (!done) return tl::unexpected(done.error());
  return picture;
}

}  // namespace umbrage::optics
