#pragma once

#include <algorithm>
#include <random>

#include "umbrage/scene/scene.hpp"
#include "umbrage/shadow/technique.hpp"

/// Scenes of coloured glass, and how two pictures of them compare.
namespace umbrage::support {

class Builder {
 public:
  Builder() { scene.up = scene::UpAxis::z; }
  std::uint32_t material(const Vec3& colour, double opacity) {
    scene.materials.push_back({"", colour, opacity});
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  }
  void quad(const Vec3& at, const Vec3& u, const Vec3& v, std::uint32_t material) {
    mesh::Mesh mesh;
    mesh.positions = {at - u - v, at + u - v, at + u + v, at - u + v};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.materials = {material, material};
    scene.instances.push_back({"", static_cast<std::uint32_t>(scene.meshes.size())});
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(mesh)));
  }
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t material) {
    mesh::Mesh mesh;
    mesh.positions = {a, b, c};
    mesh.triangles = {{0, 1, 2}};
    mesh.materials = {material};
    scene.instances.push_back({"", static_cast<std::uint32_t>(scene.meshes.size())});
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(mesh)));
  }
  scene::Scene scene;
};

inline scene::Camera cameraAt(const Vec3& eye, const Vec3& target, int width = 160, int height = 120) {
  scene::Camera camera;
  camera.eye = eye, camera.target = target, camera.up = {0, 0, 1};
  camera.width = width, camera.height = height;
  return camera;
}

inline scene::Scene soup(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto any = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  Builder b;
  for (int i = 0; i < 12; ++i) b.material(any(), i < 9 ? 0.2 + 0.7 * unit(random) : 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 at = 4.0 * any() - 2.0;
    b.triangle(at + size * (any() - 0.5), at + size * (any() - 0.5), at + size * (any() - 0.5),
               static_cast<std::uint32_t>(12 * unit(random)));
  }
  const auto ground = b.material(Vec3(0.8), 1.0);
  b.quad({0, 0, -2.5}, {5, 0, 0}, {0, 5, 0}, ground);
  return b.scene;
}

struct Compared {
  std::size_t surfaces = 0, off = 0, otherVeils = 0, pixels = 0;
};

/// Every surface that a pixel shows, by two techniques.
inline Compared compareAll(const shadow::Shading& a, const shadow::Shading& truth) {
  Compared out;
  const auto differ = [](const shadow::Tint& p, const shadow::Tint& q) {
    const Vec3 d = glm::abs(shadow::partsOf(p) - shadow::partsOf(q));
    return std::max({d.x, d.y, d.z}) > 1.0 / 255.0;
  };
  for (std::size_t i = 0; i < truth.surface.triangle.size(); ++i) {
    ++out.pixels;
    const auto mine = a.veils.at(i), theirs = truth.veils.at(i);
    const bool same = std::ranges::equal(mine, theirs, {}, &shadow::Veil::triangle, &shadow::Veil::triangle) &&
                      a.surface.triangle.pixels()[i] == truth.surface.triangle.pixels()[i];
    if (!same) {
      ++out.otherVeils;
      continue;
    }
    for (std::size_t l = 0; l < truth.masks.size(); ++l) {
      ++out.surfaces;
      out.off += differ(a.masks[l].tint.pixels()[i], truth.masks[l].tint.pixels()[i]);
      for (std::size_t k = 0; k < mine.size(); ++k) {
        ++out.surfaces;
        out.off += differ(a.masks[l].veils[a.veils.first[i] + k], truth.masks[l].veils[truth.veils.first[i] + k]);
      }
    }
  }
  return out;
}

}  // namespace umbrage::support
