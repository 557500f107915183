#include <cmath>
#include <numbers>

#include "ground.hpp"
#include "staged_scene.hpp"

namespace umbrage::benchmarks {
namespace {

Vec3 centreLine(double a) {
  const double r = 10 * (std::cos(3 * a) + 2);
  return {r * std::cos(2 * a), -r * std::sin(2 * a), 18 - 10 * std::sin(3 * a)};
}

mesh::Mesh tube(std::uint32_t columns, std::uint32_t rows) {
  mesh::Mesh m;
  m.name = "knot";
  for (std::uint32_t i = 0; i < columns; ++i) {
    const double a = 2 * std::numbers::pi * i / columns;
    const Vec3 along = glm::normalize(centreLine(a + 1e-2) - centreLine(a - 1e-2));
    const Vec3 x = glm::normalize(glm::cross(along, Vec3(0.31, -0.2, 0.9))), y = glm::cross(along, x);
    for (std::uint32_t j = 0; j < rows; ++j) {
      const double b = 2 * std::numbers::pi * j / rows, r = 4 * (1 + 0.06 * std::sin(9 * b) * std::cos(60 * a));
      m.positions.push_back(snapped(centreLine(a) + r * std::cos(b) * x + r * std::sin(b) * y));
      const std::uint32_t here = i * rows, next = (i + 1) % columns * rows, above = (j + 1) % rows;
      m.triangles.push_back({here + j, next + above, next + j});
      m.triangles.push_back({here + j, here + above, next + above});
    }
  }
  return m;
}

}  // namespace

StagedScene groovedKnot(std::uint32_t columns, std::uint32_t rows) {
  scene::Scene s;
  s.source = "knot";
  s.materials.push_back({"knot", Vec3(0.8), 1.0});
  s.materials.push_back({"ground", Vec3(0.6), 1.0});
  s.meshes.push_back(std::make_shared<const mesh::Mesh>(tube(columns, rows)));
  s.instances.push_back({"knot", 0});
  addGround(s, 200, 1);
  scene::Camera camera;
  camera.eye = {-35, 75, 45}, camera.target = {0, 0, 10}, camera.fovY = Angle::radians(0.9);
  const scene::Light light{scene::PointLight{{30, 25, 70}}, Vec3(1.0), 1.0, "light"};
  return {"knot", std::move(s), {{"grooved_knot", camera, light}}};
}

}  // namespace umbrage::benchmarks
