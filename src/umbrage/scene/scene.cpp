#include "umbrage/scene/scene.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>

namespace umbrage::scene {
namespace {

constexpr double kGroundRadii = 64.0;

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::optional<std::string> findFault(const mesh::Mesh& m, std::size_t materialCount) {
  for (const Vec3& p : m.positions)
    if (!finite(p)) return "a coordinate is not finite";
  for (const mesh::Triangle& t : m.triangles)
    if (std::max({t[0], t[1], t[2]}) >= m.positions.size()) return "a corner index is out of range";
  if (!m.materials.empty() && m.materials.size() != m.triangles.size())
    return "materials and triangles differ in number";
  for (const std::uint32_t material : m.materials)
    if (material >= materialCount) return "a material index is out of range";
  return std::nullopt;
}

bool finite(const Mat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

}  // namespace

std::size_t triangleCount(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) count += scene.meshes[instance.mesh]->triangles.size();
  return count;
}

Box3 bounds(const Scene& scene, bool castersOnly) {
  Box3 box;
  for (const Instance& instance : scene.instances) {
    if (castersOnly && !instance.casts) continue;
    const mesh::Mesh& m = *scene.meshes[instance.mesh];
    for (const mesh::Triangle& t : m.triangles)
      for (const std::uint32_t corner : t) box.add(transformPoint(instance.toWorld, m.positions[corner]));
  }
  return box;
}

std::optional<std::string> findFault(const Scene& scene) {
  if (scene.materials.empty()) return "no material";
  for (const Material& m : scene.materials) {
    const Vec3 passes = m.filter.value_or(Vec3(0.0));
    const bool passesLess =
        glm::all(glm::greaterThanEqual(passes, Vec3(0.0))) && glm::all(glm::lessThanEqual(passes, Vec3(1.0)));
    const bool shines = finite(m.emission) && glm::all(glm::greaterThanEqual(m.emission, Vec3(0.0)));
    const bool bends = m.mirror >= 0.0 && m.mirror <= 1.0 && m.ior >= 1.0 && std::isfinite(m.ior);
    if (!finite(m.colour) || !(m.opacity >= 0.0 && m.opacity <= 1.0) || !passesLess || !shines || !bends)
      return "material '" + m.name + "' is out of range";
  }
  if (!(scene.metresPerUnit > 0.0) || !std::isfinite(scene.metresPerUnit)) return "the unit is out of range";
  for (const auto& m : scene.meshes) {
    if (m == nullptr) return "a mesh is missing";
    if (auto fault = findFault(*m, scene.materials.size())) return "mesh '" + m->name + "': " + *fault;
  }
  for (const Instance& i : scene.instances) {
    if (i.mesh >= scene.meshes.size()) return "instance '" + i.name + "' names no mesh";
    if (!finite(i.toWorld)) return "instance '" + i.name + "' has a transform that is not finite";
    // A finite matrix times finite points may still overflow.
    for (const Vec3& p : scene.meshes[i.mesh]->positions)
      if (!finite(transformPoint(i.toWorld, p))) return "instance '" + i.name + "' lies outside all numbers";
  }
  for (const Light& light : scene.lights)
    if (!isValid(light)) return "light '" + light.name + "' is out of range";
  return std::nullopt;
}

Scene withGround(Scene scene, std::optional<double> height) {
  const Box3 box = bounds(scene);
  const Vec3 up = upVector(scene.up);
  const double level = height.value_or(box.empty() ? 0.0 : glm::dot(box.min, up));
  const double half = kGroundRadii * std::max(box.radius(), 1e-3);
  const Vec3 centre = box.centre() - up * glm::dot(box.centre(), up) + up * level;
  const Vec3 x = half * eastVector(scene.up), y = half * northVector(scene.up);

  auto plane = std::make_shared<mesh::Mesh>();
  plane->name = kGroundName;
  plane->positions = {centre - x - y, centre + x - y, centre + x + y, centre - x + y};
  plane->triangles = {{0, 1, 2}, {0, 2, 3}};
  plane->materials.assign(2, static_cast<std::uint32_t>(scene.materials.size()));
  scene.materials.push_back({kGroundName, Vec3(0.55, 0.55, 0.52), 1.0});
  scene.instances.push_back({kGroundName, static_cast<std::uint32_t>(scene.meshes.size()), Mat4(1.0), false});
  scene.meshes.push_back(std::move(plane));
  return scene;
}

bool matchesName(const std::string& name, const std::string& pattern) {
  if (fnmatch(pattern.c_str(), name.c_str(), 0) == 0) return true;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    if (fnmatch(pattern.c_str(), name.substr(begin, end - begin).c_str(), 0) == 0) return true;
    begin = end + 1;
  }
  return false;
}

Scene withCasters(Scene scene, const std::vector<std::string>& patterns) {
  for (Instance& instance : scene.instances)
    instance.casts = instance.casts && std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
                       return matchesName(instance.name, pattern);
                     });
  return scene;
}

}  // namespace umbrage::scene
