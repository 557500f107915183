#pragma once

#include <cstdint>
#include <string>

#include "umbrage/scene/scene.hpp"

namespace umbrage::samples::detail {

/// A mesh that grows triangle by triangle. Corners snap to multiples of 1/1024 m: shapes that meet in a point meet exactly, and
/// the last bits of the mathematical library do not show.
class Part {
 public:
  Part(std::string name, std::uint32_t material) : material_(material) { mesh_.name = std::move(name); }

  /// Triangles added from now on have this material.
  void use(std::uint32_t material) { material_ = material; }
  std::uint32_t corner(const Vec3& position);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

  [[nodiscard]] mesh::Mesh take() && { return std::move(mesh_); }

 private:
  mesh::Mesh mesh_;
  std::uint32_t material_;
};

/// A scene that grows part by part.
class SceneBuilder {
 public:
  explicit SceneBuilder(std::string name);

  /// `srgb`: 0xRRGGBB as on the screen.
  std::uint32_t material(std::string name, std::uint32_t srgb, double opacity = 1.0);
  /// Of a material: light that it gives off; linear.
  void shine(std::uint32_t material, const Vec3& emission) { scene_.materials[material].emission = emission; }
  void mirror(std::uint32_t material, double part) { scene_.materials[material].mirror = part; }
  /// Its closed surfaces hold something clear: what passes is `filter`, bent by `ior`.
  void fill(std::uint32_t material, const Vec3& filter, double ior);
  void light(scene::Light light) { scene_.lights.push_back(std::move(light)); }
  /// A mesh that several instances share.
  std::uint32_t share(Part part);
  void place(std::string path, std::uint32_t mesh, const Mat4& toWorld);
  /// A mesh of its own at its own coordinates; the path is its parent's, the part's name is added.
  void place(const std::string& parent, Part part);

  [[nodiscard]] scene::Scene take() && { return std::move(scene_); }

 private:
  scene::Scene scene_;
};

/// A turn by quarters about the up axis, a uniform scale, then a shift: exact when the numbers are.
[[nodiscard]] Mat4 placed(const Vec3& at, int quarterTurns = 0, double scale = 1.0);

}  // namespace umbrage::samples::detail
