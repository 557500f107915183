#pragma once

#include "umbrage/scene/scene.hpp"

namespace umbrage::support {

/// An axis-parallel box as a closed mesh of twelve triangles.
inline std::shared_ptr<const mesh::Mesh> boxMesh(const Vec3& low, const Vec3& high) {
  auto m = std::make_shared<mesh::Mesh>();
  for (int i = 0; i < 8; ++i)
    m->positions.push_back(
        {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
  m->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

/// Named boxes, up = +Z, one material each.
struct NamedBox {
  std::string name;
  Vec3 low, high;
};
inline scene::Scene boxScene(const std::vector<NamedBox>& boxes) {
  scene::Scene s;
  s.materials = {{"stone", Vec3(0.7, 0.68, 0.64), 1.0}};
  for (const NamedBox& box : boxes) {
    s.instances.push_back({box.name, static_cast<std::uint32_t>(s.meshes.size())});
    s.meshes.push_back(boxMesh(box.low, box.high));
  }
  return s;
}

}  // namespace umbrage::support
