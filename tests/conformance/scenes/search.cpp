#include <algorithm>
#include <cmath>
#include <optional>

#include "conformance/scenes/scenes.hpp"
#include "support/shapes.hpp"
#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::conformance {
namespace {

// An eye near a point of a side of the volume of `light`, at one of the distances 0, 1e-6, 1e-5 .. 1e-2 of the scene's size.
std::optional<NamedView> attack(shapes::Random& random, const shadow::CasterSet& casters, const scene::Light& light,
                                double size, int number) {
  const auto silhouette = shadow::findSilhouette(casters, scene::homogeneous(light, casters.origin));
  if (silhouette.edges.empty()) return std::nullopt;
  const auto& edge =
      silhouette.edges[static_cast<std::size_t>(random.whole(0, static_cast<int>(silhouette.edges.size()) - 1))];
  const Vec3 a = casters.position(edge.a), b = casters.position(edge.b);
  const Vec3 on = a + random.unit() * (b - a);
  const Vec3 away = -glm::normalize(scene::towardsLight(silhouette.light, on));
  const Vec3 normal = glm::cross(b - a, away);
  const double length = glm::length(normal);
  const int step = random.whole(0, 5);
  const double distance = step == 0 ? 0.0 : std::pow(10.0, step - 7) * (random.unit() < 0.5 ? -size : size);
  const Vec3 eye = casters.origin + on + random.in(0.02, 1.2) * size * away +
                   (length > 0.0 ? distance / length * normal : Vec3(0.0));
  const Vec3 target = casters.origin + casters.bounds.centre() + size * random.point({Vec3(-0.7), Vec3(0.7)});
  return NamedView{"attack" + std::to_string(number) + "@1e" + std::to_string(step == 0 ? -99 : step - 7),
                   looking(eye, target, random.in(30, 100), 160, 120)};
}

// An eye so near to a large triangle that single precision cannot say on which side of it the eye is: nothing drawn with OpenGL
// can be right there.
bool lostInRounding(const scene::Surfaces& surfaces, const Vec3& eye) {
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Vec3 a = surfaces.corner(t, 0), b = surfaces.corner(t, 1), c = surfaces.corner(t, 2);
    const double reach = std::max({glm::length(a - eye), glm::length(b - eye), glm::length(c - eye)});
    if (distanceToTriangle(eye, a, b, c) <= 0x1p-19 * reach) return true;
  }
  return false;
}

}  // namespace

std::vector<NamedView> searchViews(const Case& c, const shadow::Geometry& geometry, int count) {
  std::uint64_t seed = 0;
  for (const char ch : c.name) seed = 31 * seed + static_cast<unsigned char>(ch);
  shapes::Random random(seed);
  const Box3 box = geometry.casters.bounds;
  const Vec3 centre = geometry.surfaces.origin + box.centre();
  std::vector<NamedView> views;
  for (int i = 0; i < count; ++i) {
    const scene::Light& light = c.lights[static_cast<std::size_t>(i) % c.lights.size()].light;
    auto view = i % 3 != 0 ? attack(random, geometry.casters, light, box.radius(), i) : std::nullopt;
    if (view && lostInRounding(geometry.surfaces, view->camera.eye - geometry.surfaces.origin)) view.reset();
    const Vec3 eye = centre + box.radius() * random.point({Vec3(-2.5), Vec3(2.5)});
    const Vec3 target = centre + box.radius() * random.point({Vec3(-0.7), Vec3(0.7)});
    views.push_back(
        view.value_or(NamedView{"random" + std::to_string(i), looking(eye, target, random.in(20, 100), 160, 120)}));
  }
  return views;
}

}  // namespace umbrage::conformance
