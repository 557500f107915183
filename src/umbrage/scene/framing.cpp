#include "umbrage/scene/framing.hpp"

#include "umbrage/scene/detail/fit.hpp"

namespace umbrage::scene {

Camera frameScene(const Scene& scene, const Box3& also, Angle fovY, int width, int height) {
  Box3 all = bounds(scene);
  all.add(also);
  return detail::frame(all, scene.up, scene.northOffset, fovY, width, height, [&](const auto& add) {
    for (const Instance& instance : scene.instances) {
      const mesh::Mesh& m = *scene.meshes[instance.mesh];
      for (const mesh::Triangle& t : m.triangles)
        for (const std::uint32_t corner : t) add(transformPoint(instance.toWorld, m.positions[corner]));
    }
    for (int i = 0; i < 8 && !also.empty(); ++i)
      add(Vec3(i & 1 ? also.max.x : also.min.x, i & 2 ? also.max.y : also.min.y, i & 4 ? also.max.z : also.min.z));
  });
}

}  // namespace umbrage::scene
