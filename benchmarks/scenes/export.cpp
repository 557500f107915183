#include <fmt/format.h>

#include <iterator>

#include "staged_scene.hpp"
#include "umbrage/base/check.hpp"

namespace umbrage::benchmarks {
namespace {

std::string text(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

// Of a closed mesh, six times what it encloses; negative when it is wound inwards.
double enclosed(const mesh::Mesh& m) {
  double sum = 0;
  for (const mesh::Triangle& t : m.triangles)
    sum += glm::dot(m.positions[t[0]], glm::cross(m.positions[t[1]], m.positions[t[2]]));
  return sum;
}

}  // namespace

std::vector<StagedScene> stagedScenes() {
  std::vector<StagedScene> all;
  all.push_back(city());
  all.push_back(groovedKnot());
  return all;
}

std::string exported(const StagedScene& stage) {
  std::string out;
  for (const scene::Instance& i : stage.scene.instances) {
    const mesh::Mesh& m = *stage.scene.meshes[i.mesh];
    UMBRAGE_CHECK(!i.casts || enclosed(m) > 0, "other programs cull faces: casters must be wound outwards");
    out += fmt::format("mesh {} {} {} {}\n", i.name, i.casts ? 1 : 0, m.positions.size(), m.triangles.size());
    for (const Vec3& p : m.positions) out += text(transformPoint(i.toWorld, p)) + "\n";
    for (const mesh::Triangle& t : m.triangles) out += fmt::format("{} {} {}\n", t[0], t[1], t[2]);
  }
  for (const Shot& shot : stage.shots) {
    const auto* lamp = std::get_if<scene::PointLight>(&shot.light.shape);
    UMBRAGE_CHECK(lamp != nullptr, "only point lights are exported");
    const scene::Camera& c = shot.camera;
    out += fmt::format("shot {} {} {} {} {}\n", shot.name, text(c.eye), text(c.target), c.fovY.radians(),
                       text(lamp->position));
  }
  return out;
}

}  // namespace umbrage::benchmarks
