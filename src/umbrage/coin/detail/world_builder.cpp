#include "umbrage/coin/detail/world_builder.hpp"

#include <algorithm>

namespace umbrage::coin::detail {
namespace {

std::size_t movedShapes(const std::vector<PlacedShape>& before, const std::vector<PlacedShape>& now) {
  std::size_t moved = 0;
  for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i)
    moved += before[i].triangles == now[i].triangles && before[i].toWorld != now[i].toWorld;
  return moved;
}

/// The veiled parts stand after the opaque ones: instances from `veiled` on are looked through.
struct Parts {
  scene::Scene scene;
  std::vector<std::size_t> shapeOf;
  std::size_t veiled = 0;

  void add(const std::shared_ptr<const mesh::Mesh>& mesh, const PlacedShape& shape, std::size_t index) {
    scene.instances.push_back({"", static_cast<std::uint32_t>(scene.meshes.size()), shape.toWorld, shape.casts});
    scene.meshes.push_back(mesh);
    shapeOf.push_back(index);
  }
};

Parts partsOf(const std::vector<PlacedShape>& shapes, TransparentCasters transparent) {
  Parts parts;
  parts.scene.materials = {{}};
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (const auto& mesh = shapes[i].triangles->opaque; mesh != nullptr) parts.add(mesh, shapes[i], i);
  parts.veiled = parts.scene.instances.size();
  if (transparent != TransparentCasters::opaque) return parts;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (const auto& mesh = shapes[i].triangles->veiled; mesh != nullptr && shapes[i].casts)
      parts.add(mesh, shapes[i], i);
  return parts;
}

World assemble(const Parts& parts, scene::Welding& welding) {
  World world;
  if (parts.scene.instances.empty()) return world;
  world.shapeOf = parts.shapeOf;
  auto surfaces = scene::flatten(parts.scene, welding);
  auto casters = shadow::buildCasters(surfaces);
  world.geometry = std::make_shared<const shadow::Geometry>(shadow::Geometry{std::move(surfaces), std::move(casters)});
  if (parts.veiled == parts.scene.instances.size()) return world;
  for (const std::uint32_t instance : world.geometry->surfaces.instances)
    world.unseen.push_back(instance >= parts.veiled ? 1 : 0);
  return world;
}

bool onlyMoved(const std::vector<PlacedShape>& before, const std::vector<PlacedShape>& now) {
  return std::ranges::equal(before, now, [](const PlacedShape& a, const PlacedShape& b) {
    return a.triangles == b.triangles && a.casts == b.casts;
  });
}

}  // namespace

const World& WorldBuilder::build(const std::vector<PlacedShape>& shapes, TransparentCasters transparent, Work& work) {
  if (shapes == shapes_ && transparent == transparent_) return world_;
  work.poses += movedShapes(shapes_, shapes);
  ++work.geometryBuilds;
  const bool moved = transparent == transparent_ && onlyMoved(shapes_, shapes) && move(shapes);
  shapes_ = shapes;
  transparent_ = transparent;
  if (!moved) world_ = assemble(partsOf(shapes, transparent), welding_);
  return world_;
}

bool WorldBuilder::move(const std::vector<PlacedShape>& shapes) {
  if (world_.geometry == nullptr) return false;
  auto surfaces = scene::flattenMoved(partsOf(shapes, transparent_).scene, world_.geometry->surfaces, welding_);
  if (!surfaces) return false;
  auto casters = shadow::moveCasters(*surfaces, world_.geometry->casters);
  world_.geometry =
      std::make_shared<const shadow::Geometry>(shadow::Geometry{std::move(*surfaces), std::move(casters)});
  return true;
}

}  // namespace umbrage::coin::detail
