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

// 1 where the corners go round as those of the row do, else -1; 0 where they are no row, having become one point.
int turnOf(const mesh::Triangle& corners, const mesh::Triangle& row) {
  for (int k = 0; k < 3; ++k) {
    if (corners[k] != row[0]) continue;
    if (corners[(k + 1) % 3] == row[1] && corners[(k + 2) % 3] == row[2]) return 1;
    if (corners[(k + 1) % 3] == row[2] && corners[(k + 2) % 3] == row[1]) return -1;
  }
  return 0;
}

/// Which side of each triangle is culled. Flattening sorts corners and leaves triangles out, but keeps the order of the others.
std::vector<std::int8_t> culledSides(const Parts& parts, const std::vector<PlacedShape>& shapes,
                                     const scene::Surfaces& surfaces, const scene::Welding& welding) {
  std::vector<std::int8_t> sides;
  if (std::ranges::none_of(shapes, [](const PlacedShape& s) { return s.culled != Culled::none; })) return sides;
  sides.resize(surfaces.triangles.size());
  std::size_t first = 0, row = 0;  // of the instance's points; of its triangles
  for (std::size_t i = 0; i < parts.scene.instances.size(); ++i) {
    const mesh::Mesh& mesh = *parts.scene.meshes[parts.scene.instances[i].mesh];
    const Culled culled = shapes[parts.shapeOf[i]].culled;
    const int sign = culled == Culled::none ? 0 : culled == Culled::counterclockwise ? 1 : -1;
    for (const mesh::Triangle& t : mesh.triangles) {
      if (row == surfaces.triangles.size() || surfaces.instances[row] != i) break;
      const int turn =
          turnOf({welding.position[first + t[0]], welding.position[first + t[1]], welding.position[first + t[2]]},
                 surfaces.triangles[row]);
      if (turn != 0) sides[row++] = static_cast<std::int8_t>(turn * sign);
    }
    first += mesh.positions.size();
  }
  return sides;
}

World assemble(const Parts& parts, const std::vector<PlacedShape>& shapes, scene::Welding& welding) {
  World world;
  if (parts.scene.instances.empty()) return world;
  world.shapeOf = parts.shapeOf;
  auto surfaces = scene::flatten(parts.scene, welding);
  auto casters = shadow::buildCasters(surfaces);
  world.geometry = std::make_shared<const shadow::Geometry>(shadow::Geometry{std::move(surfaces), std::move(casters)});
  world.culled = culledSides(parts, shapes, world.geometry->surfaces, welding);
  if (parts.veiled == parts.scene.instances.size()) return world;
  for (const std::uint32_t instance : world.geometry->surfaces.instances)
    world.veiled.push_back(instance >= parts.veiled ? 1 : 0);
  return world;
}

bool onlyMoved(const std::vector<PlacedShape>& before, const std::vector<PlacedShape>& now) {
  return std::ranges::equal(before, now, [](const PlacedShape& a, const PlacedShape& b) {
    return a.triangles == b.triangles && a.casts == b.casts && a.culled == b.culled;
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
  if (!moved) world_ = assemble(partsOf(shapes, transparent), shapes, welding_);
  return world_;
}

bool WorldBuilder::move(const std::vector<PlacedShape>& shapes) {
  if (world_.geometry == nullptr) return false;
  const Parts parts = partsOf(shapes, transparent_);
  auto surfaces = scene::flattenMoved(parts.scene, world_.geometry->surfaces, welding_);
  if (!surfaces) return false;
  world_.culled = culledSides(parts, shapes, *surfaces, welding_);
  auto casters = shadow::moveCasters(*surfaces, world_.geometry->casters);
  world_.geometry =
      std::make_shared<const shadow::Geometry>(shadow::Geometry{std::move(*surfaces), std::move(casters)});
  return true;
}

}  // namespace umbrage::coin::detail
