// Wavefront OBJ and its material library. World coordinates in double precision; shared meshes are written once per instance.
#include <algorithm>

#include "umbrage/io/writer/common.hpp"
#include "umbrage/io/writer/writers.hpp"

namespace umbrage::io::writer {
namespace {

/// Readers end a name at the first blank.
std::string word(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
  return name.empty() ? "unnamed" : name;
}

/// Materials of one name stay apart.
std::string materialName(const scene::Scene& scene, std::uint32_t index) {
  const std::string name = word(scene.materials[index].name);
  for (std::uint32_t i = 0; i < index; ++i)
    if (word(scene.materials[i].name) == name) return name + "_" + std::to_string(index);
  return name;
}

void appendVector(std::string& text, const Vec3& v) {
  for (int k = 0; k < 3; ++k) append(text += ' ', v[k] + 0.0);
}

std::string library(const scene::Scene& scene) {
  std::string text;
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    text += "newmtl " + materialName(scene, i) + "\nKd";
    appendVector(text, srgbFromLinear(scene.materials[i].colour));
    append(text += "\nd ", scene.materials[i].opacity);
    text += "\n\n";
  }
  return text;
}

void appendFaces(std::string& text, const scene::Scene& scene, const mesh::Mesh& m, std::uint32_t base) {
  for (const std::uint32_t material : usedMaterials(m)) {
    text += "usemtl " + materialName(scene, material) + '\n';
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      if (materialOf(m, t) != material) continue;
      text += 'f';
      for (const std::uint32_t corner : m.triangles[t]) append(text += ' ', base + corner + 1);
      text += '\n';
    }
  }
}

}  // namespace

Result<Document> obj(const scene::Scene& scene, const std::string& stem) {
  const Mat4 turn = toMetres(scene, scene::UpAxis::y);
  std::string text = "# metres, Y up\nmtllib " + stem + ".mtl\n";
  std::uint32_t base = 0;
  for (const scene::Instance& instance : scene.instances) {
    const mesh::Mesh& m = *scene.meshes[instance.mesh];
    if (m.triangles.empty()) continue;
    text += "o " + word(instance.name) + '\n';
    for (const Vec3& p : m.positions) {
      text += 'v';
      appendVector(text, transformPoint(turn, transformPoint(instance.toWorld, p)));
      text += '\n';
    }
    appendFaces(text, scene, m, base);
    base += static_cast<std::uint32_t>(m.positions.size());
  }
  return Document{std::move(text), library(scene), ".mtl"};
}

}  // namespace umbrage::io::writer
