#include "umbrage/cut/lit_scene.hpp"

#include <bit>
#include <map>
#include <string>
#include <unordered_map>

namespace umbrage::cut {
namespace {

struct BitsOf {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k)
      hash = (hash ^ std::bit_cast<std::uint64_t>(p[k] + 0.0)) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
    return hash;
  }
};

std::string lightNames(std::uint64_t litBy, std::size_t lights) {
  if (litBy == 0) return "shadow";
  if (static_cast<std::size_t>(std::popcount(litBy)) == lights) return "lit";
  std::string text;
  for (std::size_t k = 0; k < lights; ++k)
    if ((litBy >> k & 1u) != 0) text += (text.empty() ? "lit " : "+") + std::to_string(k + 1);
  return text;
}

/// What grows of one instance and one set of lights.
struct Growing {
  mesh::Mesh mesh;
  std::unordered_map<Vec3, std::uint32_t, BitsOf> known;
};

class Builder {
 public:
  Builder(const scene::Scene& scene, const scene::Surfaces& surfaces, const Pieces& pieces, std::size_t lights,
          double ambient)
      : scene_(scene), surfaces_(surfaces), pieces_(pieces), lights_(lights), ambient_(ambient) {}

  scene::Scene build() {
    out_ = scene_;
    out_.meshes.clear(), out_.materials.clear(), out_.instances.clear();
    std::size_t i = 0;
    // Triangles of one instance stand together.
    while (i < pieces_.pieces.size()) {
      const std::uint32_t instance = surfaces_.instances[pieces_.pieces[i].triangle];
      std::map<std::uint64_t, Growing> growing;
      for (; i < pieces_.pieces.size() && surfaces_.instances[pieces_.pieces[i].triangle] == instance; ++i)
        add(pieces_.pieces[i], growing[pieces_.pieces[i].litBy]);
      // The lit first: names that end in shadow come last.
      for (auto it = growing.rbegin(); it != growing.rend(); ++it)
        place(instance, it->first, std::move(it->second.mesh));
    }
    if (out_.materials.empty()) out_.materials = scene_.materials;
    return std::move(out_);
  }

 private:
  void add(const Piece& piece, Growing& to) {
    const std::uint32_t material = materialOf(surfaces_.materials[piece.triangle], piece.litBy);
    const auto at = [&](std::uint32_t i) { return pieces_.corners[i]; };
    for (std::uint32_t i = piece.begin + 1; i + 1 < piece.end; ++i) {
      if (glm::cross(at(i) - at(piece.begin), at(i + 1) - at(piece.begin)) == Vec3(0.0)) continue;
      to.mesh.triangles.push_back({index(to, at(piece.begin)), index(to, at(i)), index(to, at(i + 1))});
      to.mesh.materials.push_back(material);
    }
  }

  std::uint32_t index(Growing& to, const Vec3& corner) {
    const Vec3 world = corner + surfaces_.origin;
    const auto [it, isNew] = to.known.try_emplace(world, static_cast<std::uint32_t>(to.mesh.positions.size()));
    if (isNew) to.mesh.positions.push_back(world);
    return it->second;
  }

  std::uint32_t materialOf(std::uint32_t material, std::uint64_t litBy) {
    const auto [it, isNew] =
        materials_.try_emplace({material, litBy}, static_cast<std::uint32_t>(out_.materials.size()));
    if (!isNew) return it->second;
    scene::Material& made = out_.materials.emplace_back(scene_.materials[material]);
    const double part = lights_ == 0 ? 1.0 : double(std::popcount(litBy)) / double(lights_);
    made.name += (made.name.empty() ? "" : " ") + lightNames(litBy, lights_);
    made.colour *= ambient_ + (1.0 - ambient_) * part;
    return it->second;
  }

  void place(std::uint32_t instance, std::uint64_t litBy, mesh::Mesh mesh) {
    scene::Instance made = scene_.instances[instance];
    made.name += (made.name.empty() ? "" : "/") + lightNames(litBy, lights_);
    made.mesh = static_cast<std::uint32_t>(out_.meshes.size());
    made.toWorld = Mat4(1.0);
    mesh.name = made.name;
    out_.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(mesh)));
    out_.instances.push_back(std::move(made));
  }

  const scene::Scene& scene_;
  const scene::Surfaces& surfaces_;
  const Pieces& pieces_;
  const std::size_t lights_;
  const double ambient_;
  scene::Scene out_;
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::uint32_t> materials_;
};

}  // namespace

scene::Scene litScene(const scene::Scene& scene, const scene::Surfaces& surfaces, const Pieces& pieces,
                      std::size_t lights, double ambient) {
  return Builder(scene, surfaces, pieces, lights, ambient).build();
}

}  // namespace umbrage::cut
