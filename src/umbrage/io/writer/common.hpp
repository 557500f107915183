#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "umbrage/scene/scene.hpp"

namespace umbrage::io::writer {

/// The levels of an instance's path; empty ones are left out, and nothing at all is "part".
[[nodiscard]] std::vector<std::string> levels(const std::string& path);

/// From a scene's own frame and unit to metres with that axis up: exact but for the unit.
[[nodiscard]] Mat4 toMetres(const scene::Scene& scene, scene::UpAxis up);

/// A mesh in single precision around an origin; the origin is 0 where single precision holds the mesh exactly.
struct SinglePrecision {
  Vec3 origin{0.0};
  std::vector<Vec3f> positions;
};
[[nodiscard]] SinglePrecision inSinglePrecision(const mesh::Mesh& m);

/// The materials that a mesh uses, ascending.
[[nodiscard]] std::vector<std::uint32_t> usedMaterials(const mesh::Mesh& m);
[[nodiscard]] inline std::uint32_t materialOf(const mesh::Mesh& m, std::size_t triangle) {
  return m.materials.empty() ? 0 : m.materials[triangle];
}

[[nodiscard]] Vec3 srgbFromLinear(const Vec3& linear);

/// The shortest text that reads back as the same number, whatever the locale.
void append(std::string& text, double number);
void append(std::string& text, float number);
void append(std::string& text, std::uint32_t number);

}  // namespace umbrage::io::writer
