#include "umbrage/io/reader/tidy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrage/mesh/weld.hpp"

namespace umbrage::io::reader {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMaxComplaints = 1000;
// A single-precision step larger than this part of the scene's radius is worth a warning.
constexpr double kCoarseStep = 1e-5;
// A chain of thousands of named nodes must not make names of megabytes; deeper levels are left out.
constexpr std::size_t kMaxPath = 500;

bool usable(const Vec3& p) {
  // Written so that NaN is not usable.
  return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate && std::abs(p.z) <= kMaxCoordinate;
}

struct Dropped {
  std::size_t notFinite = 0, outOfRange = 0, instances = 0, lights = 0;
};

// Keeps the triangles whose corners exist and are usable.
void keepUsable(mesh::Mesh& m, Dropped& dropped) {
  const bool perTriangle = m.materials.size() == m.triangles.size();
  std::size_t kept = 0;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    const mesh::Triangle corners = m.triangles[t];
    if (std::max({corners[0], corners[1], corners[2]}) >= m.positions.size()) {
      ++dropped.outOfRange;
      continue;
    }
    if (!std::all_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return usable(m.positions[c]); })) {
      ++dropped.notFinite;
      continue;
    }
    if (perTriangle) m.materials[kept] = m.materials[t];
    m.triangles[kept++] = corners;
  }
  m.triangles.resize(kept);
  m.materials.resize(perTriangle ? kept : 0);
}

// Only the points that triangles use, identical ones once, in the order of first use.
void compact(mesh::Mesh& m) {
  std::vector<std::uint32_t> place(m.positions.size(), kNone);
  std::vector<Vec3> used;
  for (mesh::Triangle& corners : m.triangles)
    for (std::uint32_t& corner : corners) {
      if (place[corner] == kNone) {
        place[corner] = static_cast<std::uint32_t>(used.size());
        used.push_back(m.positions[corner]);
      }
      corner = place[corner];
    }
  const mesh::Weld weld = mesh::weld(used);
  m.positions.clear();
  for (const std::uint32_t first : weld.first) m.positions.push_back(used[first]);
  for (mesh::Triangle& corners : m.triangles)
    for (std::uint32_t& corner : corners) corner = weld.remap[corner];
}

constexpr double kBrightest = 1e6, kDensest = 10.0;

void tidyMaterials(scene::Scene& s) {
  if (s.materials.empty()) s.materials.push_back({"default", Vec3(0.8), 1.0});
  for (scene::Material& m : s.materials) {
    for (int k = 0; k < 3; ++k) m.colour[k] = std::isfinite(m.colour[k]) ? std::clamp(m.colour[k], 0.0, 1.0) : 0.8;
    m.opacity = std::isfinite(m.opacity) ? std::clamp(m.opacity, 0.0, 1.0) : 1.0;
    for (int k = 0; m.filter && k < 3; ++k)
      (*m.filter)[k] = std::isfinite((*m.filter)[k]) ? std::clamp((*m.filter)[k], 0.0, 1.0) : 0.0;
    for (int k = 0; k < 3; ++k)
      m.emission[k] = std::isfinite(m.emission[k]) ? std::clamp(m.emission[k], 0.0, kBrightest) : 0.0;
    m.mirror = std::isfinite(m.mirror) ? std::clamp(m.mirror, 0.0, 1.0) : 0.0;
    m.ior = std::isfinite(m.ior) ? std::clamp(m.ior, 1.0, kDensest) : 1.0;
    if (m.opacity == 0.0 && !m.filter)
      m.filter = Vec3(1.0);  // nothing is there; what is seen of its colour is nothing too
  }
}

void tidyMeshes(scene::Scene& s, Dropped& dropped) {
  for (auto& shared : s.meshes) {
    mesh::Mesh m = *shared;
    shared.reset();
    keepUsable(m, dropped);
    compact(m);
    for (std::uint32_t& material : m.materials) material = material < s.materials.size() ? material : 0;
    shared = std::make_shared<const mesh::Mesh>(std::move(m));
  }
}

bool lands(const scene::Instance& instance, const mesh::Mesh& m) {
  return std::all_of(m.positions.begin(), m.positions.end(),
                     [&](const Vec3& p) { return usable(transformPoint(instance.toWorld, p)); });
}

// Keeps instances that show something and lie where numbers are, then the meshes they use.
void tidyInstances(scene::Scene& s, Dropped& dropped) {
  std::vector<std::uint32_t> place(s.meshes.size(), kNone);
  std::vector<std::shared_ptr<const mesh::Mesh>> meshes;
  std::vector<scene::Instance> instances;
  for (scene::Instance& instance : s.instances) {
    if (instance.mesh >= s.meshes.size() || s.meshes[instance.mesh]->triangles.empty()) continue;
    if (!lands(instance, *s.meshes[instance.mesh])) {
      ++dropped.instances;
      continue;
    }
    if (place[instance.mesh] == kNone) {
      place[instance.mesh] = static_cast<std::uint32_t>(meshes.size());
      meshes.push_back(s.meshes[instance.mesh]);
    }
    instance.mesh = place[instance.mesh];
    instances.push_back(std::move(instance));
  }
  s.meshes = std::move(meshes);
  s.instances = std::move(instances);
}

void warn(scene::Scene& s, const Dropped& dropped, std::size_t triangles) {
  const std::string of = " of " + counted(triangles, "triangle") + " dropped: ";
  if (dropped.notFinite > 0) s.warnings.push_back(std::to_string(dropped.notFinite) + of + "coordinates not finite");
  if (dropped.outOfRange > 0)
    s.warnings.push_back(std::to_string(dropped.outOfRange) + of + "corners that do not exist");
  if (dropped.instances > 0)
    s.warnings.push_back(counted(dropped.instances, "part") + " dropped: the placement is not finite");
  if (dropped.lights > 0) s.warnings.push_back(counted(dropped.lights, "light") + " dropped: out of range");
  if (s.instances.empty()) s.warnings.push_back("there are no triangles in it");
}

}  // namespace

scene::Scene tidy(scene::Scene s) {
  std::size_t triangles = 0;
  for (const auto& m : s.meshes) triangles += m->triangles.size();
  Dropped dropped;
  tidyMaterials(s);
  tidyMeshes(s, dropped);
  tidyInstances(s, dropped);
  dropped.lights = std::erase_if(s.lights, [](const scene::Light& light) { return !scene::isValid(light); });
  if (!std::isfinite(s.metresPerUnit) || s.metresPerUnit <= 0.0) s.metresPerUnit = 1.0;
  warn(s, dropped, triangles);
  return s;
}

void warnOfCoarseness(scene::Scene& s) {
  const Box3 box = scene::bounds(s);
  if (box.empty()) return;
  double far = 0.0;
  for (int k = 0; k < 3; ++k) far = std::max({far, std::abs(box.min[k]), std::abs(box.max[k])});
  const double step = std::ldexp(far, -23);
  if (box.radius() > 0.0 && step > kCoarseStep * box.radius())
    s.warnings.push_back("the coordinates are far from the origin: they are read in steps of up to " +
                         std::to_string(step) + " units");
}

std::string childPath(const std::string& parent, std::string_view name) {
  std::string own(name.substr(0, kMaxPath));
  std::replace(own.begin(), own.end(), '/', '_');
  if (own.empty() || parent.size() > kMaxPath) return parent;
  return parent.empty() ? own : parent + "/" + own;
}

Vec3 linearFromSrgb(const Vec3& srgb) {
  Vec3 linear;
  for (int k = 0; k < 3; ++k)
    linear[k] = srgb[k] <= 0.04045 ? srgb[k] / 12.92 : std::pow((srgb[k] + 0.055) / 1.055, 2.4);
  return linear;
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void Complaints::add(const std::string& text) {
  if (text.empty() || (times_.size() >= kMaxComplaints && !times_.contains(text))) return;
  if (++times_[text] == 1) order_.push_back(text);
}

void Complaints::appendTo(std::vector<std::string>& warnings, std::size_t limit) const {
  for (std::size_t i = 0; i < std::min(limit, order_.size()); ++i) {
    const std::size_t times = times_.at(order_[i]);
    warnings.push_back(order_[i] + (times > 1 ? " (" + std::to_string(times) + " times)" : ""));
  }
  if (order_.size() > limit) warnings.push_back("and " + counted(order_.size() - limit, "more complaint"));
}

}  // namespace umbrage::io::reader
