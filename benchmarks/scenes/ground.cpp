#include "ground.hpp"

namespace umbrage::benchmarks {

Vec3 snapped(const Vec3& p) { return glm::round(p * 1024.0) / 1024.0; }

void addGround(scene::Scene& scene, double halfSide, std::uint32_t material) {
  mesh::Mesh m;
  m.name = scene::kGroundName;
  m.positions = {
      {-halfSide, -halfSide, 0}, {halfSide, -halfSide, 0}, {halfSide, halfSide, 0}, {-halfSide, halfSide, 0}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  m.materials = {material, material};
  scene.instances.push_back({m.name, static_cast<std::uint32_t>(scene.meshes.size()), Mat4(1.0), false});
  scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
}

}  // namespace umbrage::benchmarks
