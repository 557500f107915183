#include <algorithm>

#include "conformance/scenes/scenes.hpp"
#include "umbrage/scene/surfaces.hpp"
#include "umbrage/shadow/caster_set.hpp"
#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::conformance {
namespace {

using scene::Camera;
using scene::Light;

constexpr int kWidth = 160, kHeight = 120;

// The casters' box where there are any: the ground would dwarf them.
Box3 objectBox(const scene::Scene& s) {
  const Box3 casters = scene::bounds(s, true);
  if (!casters.empty()) return casters;
  Box3 box;
  for (const scene::Instance& i : s.instances)
    if (i.name != scene::kGroundName)
      for (const Vec3& p : s.meshes[i.mesh]->positions) box.add(transformPoint(i.toWorld, p));
  return box;
}

Light pointAt(const Vec3& p) { return {scene::PointLight{p}, Vec3(1.0), 1.0, ""}; }
Light sunFrom(const Vec3& towards) { return {scene::DirectionalLight{-towards}, Vec3(1.0), 1.0, ""}; }
Light spotAt(const Vec3& p, const Vec3& target) {
  return {scene::SpotLight{p, target - p, Angle::degrees(25)}, Vec3(1.0), 1.0, ""};
}

Camera view(const Vec3& eye, const Vec3& target, double fov = 60) { return looking(eye, target, fov, kWidth, kHeight); }

// The scene's lowest level as all techniques see it: rounded to single precision once.
double lowestLevel(const scene::Scene& s) {
  const scene::Surfaces surfaces = scene::flatten(s);
  return surfaces.bounds.empty() ? 0.0 : surfaces.origin.z + surfaces.bounds.min.z;
}

Vec3 lightPoint(const Light& light, const Box3& box) {
  const Vec4 l = scene::homogeneous(light, Vec3(0.0));
  return l.w != 0.0 ? Vec3(l) : box.centre() + 20.0 * box.radius() * Vec3(l);
}

/// A side of the shadow volume: an edge on the silhouette and the directions away from the light at its ends (world).
struct Side {
  Vec3 a, b;
  Vec3 away(const Vec4& light, const Vec3& p) const { return -glm::normalize(scene::towardsLight(light, p)); }
};

std::vector<Side> sides(const scene::Scene& s, const Light& light) {
  const auto surfaces = scene::flatten(s);
  const auto casters = shadow::buildCasters(surfaces);
  const auto silhouette = shadow::findSilhouette(casters, scene::homogeneous(light, casters.origin));
  std::vector<Side> out;
  for (const auto& e : silhouette.edges)
    out.push_back({casters.origin + casters.position(e.a), casters.origin + casters.position(e.b)});
  return out;
}

void addSideViews(const scene::Scene& s, const NamedLight& light, const Box3& box, std::vector<NamedView>& views) {
  const auto all = sides(s, light.light);
  if (all.empty()) return;
  const double r = box.radius();
  const Vec4 l = scene::homogeneous(light.light, Vec3(0.0));
  for (const std::size_t which : {std::size_t{0}, all.size() / 2}) {
    const Side& side = all[which];
    const Vec3 middle = 0.5 * (side.a + side.b), away = side.away(l, middle);
    const std::string tag = "_" + light.name + std::to_string(which == 0 ? 0 : 1);
    views.push_back({"eye_on_a_side" + tag, view(middle + 0.6 * r * away, box.centre())});
    views.push_back({"eye_in_a_sides_plane" + tag,
                     view(middle + 0.4 * r * away + 1.7 * r * glm::normalize(side.b - side.a), box.centre())});
  }
}

}  // namespace

scene::Camera looking(const Vec3& eye, const Vec3& target, double fovDegrees, int width, int height) {
  scene::Camera c;
  c.eye = eye, c.target = target, c.fovY = Angle::degrees(fovDegrees), c.width = width, c.height = height;
  return c;
}

std::vector<NamedLight> standardLights(const scene::Scene& s) {
  const Box3 box = objectBox(s);
  const Vec3 c = box.centre();
  const double r = box.radius();
  std::vector<NamedLight> lights{{"lamp", pointAt(c + r * Vec3(0.7, -1.1, 1.6))},
                                 {"sun", sunFrom({-0.5, -0.8, 0.6})},
                                 {"low_sun", sunFrom({0.9, -0.3, 0.08})},
                                 {"spot", spotAt(c + r * Vec3(-1.3, -0.9, 1.8), c)},
                                 {"lamp_inside", pointAt(c + r * Vec3(0.011, 0.017, 0.023))}};
  const auto surfaces = scene::flatten(s);
  const auto caster = std::find(surfaces.casts.begin(), surfaces.casts.end(), 1);
  if (caster == surfaces.casts.end()) return lights;
  const auto t = static_cast<std::uint32_t>(caster - surfaces.casts.begin());
  const Vec3 a = surfaces.origin + surfaces.corner(t, 0), b = surfaces.origin + surfaces.corner(t, 1);
  const Vec3 n = surfaces.normal(t),
             middle = surfaces.origin + (surfaces.corner(t, 0) + surfaces.corner(t, 1) + surfaces.corner(t, 2)) / 3.0;
  const Vec3 unit = glm::length(n) > 0.0 ? glm::normalize(n) : Vec3(0, 0, 1);
  lights.push_back({"lamp_in_a_corner", pointAt(a)});
  lights.push_back({"lamp_in_a_plane", pointAt(b + 2.0 * (b - a))});
  lights.push_back({"lamp_near_a_face", pointAt(middle + 1e-3 * r * unit)});
  return lights;
}

std::vector<NamedView> standardViews(const scene::Scene& s, const std::vector<NamedLight>& lights) {
  const Box3 box = objectBox(s);
  const Vec3 c = box.centre();
  const double r = box.radius();
  const Vec3 lamp = lightPoint(lights.front().light, box), sun = lightPoint(lights[1].light, box);
  const Vec3 behind = c + 0.9 * r * glm::normalize(c - lamp), behindSun = c + 0.7 * r * glm::normalize(c - sun);
  std::vector<NamedView> views{
      {"outside", view(c + r * Vec3(-1.6, -1.9, 1.3), c)},
      {"above", view(c + r * Vec3(0.1, 0.2, 3.0), c)},
      {"grazing", view(c + Vec3(2.4 * r, 0.9 * r, 0.02 * r + box.min.z - c.z), c)},
      {"inside_the_box", view(c + r * Vec3(0.03, 0.05, 0.07), c + r * Vec3(1, 0.4, -0.2), 90)},
      {"in_the_lamps_shadow", view(behind, c + r * Vec3(1.2, 0.2, -1), 90)},
      {"from_its_shadow_to_the_lamp", view(behind, lamp, 90)},
      {"in_the_suns_shadow", view(behindSun, c, 90)},
      {"at_the_lowest_level", view({c.x - 1.7 * r, c.y - 1.9 * r, lowestLevel(s)}, c)},
      {"hardly_above_it", view({c.x - 1.7 * r, c.y - 1.9 * r, lowestLevel(s) + 1e-7 * r}, c)},
      {"almost_touching", view(Vec3(c.x, box.min.y - 1e-3 * r, c.z), c + r * Vec3(0.9, 0.6, -0.7), 90)}};
  addSideViews(s, lights[0], box, views);
  addSideViews(s, lights[1], box, views);
  return views;
}

}  // namespace umbrage::conformance
