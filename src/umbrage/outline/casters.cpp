#include "umbrage/outline/casters.hpp"

#include <unordered_map>

#include "umbrage/study/georeference.hpp"

namespace umbrage::outline {
namespace {

void append(CasterPart& part, const scene::Instance& instance, const mesh::Mesh& mesh, scene::UpAxis up) {
  const auto first = static_cast<std::uint32_t>(part.points.size());
  for (const Vec3& p : mesh.positions) {
    const Vec3 world = transformPoint(instance.toWorld, p);
    part.points.emplace_back(study::mapPoint(world, up), study::mapHeight(world, up));
    part.bounds.add(part.points.back());
  }
  for (const mesh::Triangle& t : mesh.triangles) part.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

std::vector<CasterPart> castersOf(const scene::Scene& scene) {
  std::vector<CasterPart> parts;
  std::unordered_map<std::string, std::size_t> known;
  for (const scene::Instance& instance : scene.instances) {
    if (!instance.casts) continue;
    const std::string& name = instance.group.empty() ? instance.name : instance.group;
    const auto [at, isNew] = known.try_emplace(name, parts.size());
    if (isNew) parts.push_back({name, {}, {}, {}});
    append(parts[at->second], instance, *scene.meshes[instance.mesh], scene.up);
  }
  return parts;
}

}  // namespace umbrage::outline
