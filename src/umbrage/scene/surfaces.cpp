#include "umbrage/scene/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "umbrage/mesh/weld.hpp"

namespace umbrage::scene {
namespace {

// Beyond this many radii from the origin, single precision would coarsen the scene by more than 4 bits.
constexpr double kFarRadii = 16.0;

Vec3 chooseOrigin(const Box3& box) {
  const Vec3 centre = box.centre();
  return glm::length(centre) <= kFarRadii * box.radius() ? Vec3(0.0) : glm::round(centre);
}

struct Corners {
  std::vector<Vec3f> positions;
  std::vector<mesh::Triangle> triangles;
};

void append(const Instance& instance, std::uint32_t index, const mesh::Mesh& m, Surfaces& out, Corners& raw) {
  const auto base = static_cast<std::uint32_t>(raw.positions.size());
  for (const Vec3& p : m.positions) raw.positions.push_back(Vec3f(transformPoint(instance.toWorld, p) - out.origin));
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    const mesh::Triangle& corners = m.triangles[t];
    raw.triangles.push_back({base + corners[0], base + corners[1], base + corners[2]});
    out.materials.push_back(m.materials.empty() ? 0 : m.materials[t]);
    out.instances.push_back(index);
    out.casts.push_back(instance.casts ? 1 : 0);
  }
}

void sortCorners(mesh::Triangle& t, const std::vector<Vec3f>& positions) {
  std::sort(t.begin(), t.end(),
            [&](std::uint32_t a, std::uint32_t b) { return lexicographicallyLess(positions[a], positions[b]); });
}

// Drops triangle i from every per-triangle list by moving the kept ones forward.
void keepProper(Surfaces& s) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const mesh::Triangle& c = s.triangles[t];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    s.triangles[kept] = c;
    s.materials[kept] = s.materials[t];
    s.instances[kept] = s.instances[t];
    s.casts[kept] = s.casts[t];
    ++kept;
  }
  s.dropped = s.triangles.size() - kept;
  s.triangles.resize(kept);
  s.materials.resize(kept);
  s.instances.resize(kept);
  s.casts.resize(kept);
}

// False where points that were one no longer are.
bool movePositions(const Scene& scene, const Welding& welding, Surfaces& out) {
  std::vector<std::uint8_t> known(out.positions.size(), 0);
  std::size_t i = 0;
  for (const Instance& instance : scene.instances) {
    for (const Vec3& p : scene.meshes[instance.mesh]->positions) {
      const Vec3f moved = Vec3f(transformPoint(instance.toWorld, p) - out.origin) + Vec3f(0.0f);  // no -0
      const std::uint32_t at = welding.position[i++];
      if (known[at] != 0 && out.positions[at] != moved) return false;
      known[at] = 1;
      out.positions[at] = moved;
    }
  }
  return true;
}

void measure(Surfaces& s) {
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      s.bounds.add(s.corner(t, k));
      if (s.casts[t] != 0) s.casterBounds.add(s.corner(t, k));
    }
  }
}

}  // namespace

Surfaces flatten(const Scene& scene) {
  Welding welding;
  return flatten(scene, welding);
}

Surfaces flatten(const Scene& scene, Welding& welding) {
  Surfaces out;
  out.origin = chooseOrigin(bounds(scene));
  Corners raw;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    append(scene.instances[i], i, *scene.meshes[scene.instances[i].mesh], out, raw);

  mesh::Weld welded = mesh::weld(std::span<const Vec3f>(raw.positions));
  out.positions.reserve(welded.first.size());
  for (const std::uint32_t i : welded.first) out.positions.push_back(raw.positions[i] + Vec3f(0.0f));  // no -0
  out.triangles = std::move(raw.triangles);
  for (mesh::Triangle& t : out.triangles) {
    for (std::uint32_t& corner : t) corner = welded.remap[corner];
    sortCorners(t, out.positions);
  }
  keepProper(out);
  measure(out);
  welding.position = std::move(welded.remap);
  return out;
}

std::optional<Surfaces> flattenMoved(const Scene& scene, const Surfaces& before, const Welding& welding) {
  if (before.dropped > 0) return std::nullopt;  // what had no area may have one now
  Surfaces out = before;
  out.bounds = out.casterBounds = {};
  out.origin = chooseOrigin(bounds(scene));
  if (!movePositions(scene, welding, out)) return std::nullopt;
  if (mesh::weld(std::span<const Vec3f>(out.positions)).first.size() != out.positions.size()) return std::nullopt;
  for (mesh::Triangle& t : out.triangles) sortCorners(t, out.positions);
  measure(out);
  return out;
}

}  // namespace umbrage::scene
