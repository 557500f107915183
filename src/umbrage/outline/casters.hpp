#pragma once

#include <string>
#include <vector>

#include "umbrage/math/box.hpp"
#include "umbrage/mesh/mesh.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::outline {

/// All casting triangles of one building where the scene knows buildings (Instance::group), else of one name. Points are (east, north, height) in the scene's unit, in double precision.
struct CasterPart {
  std::string name;
  std::vector<Vec3> points;
  std::vector<mesh::Triangle> triangles;
  Box3 bounds;
};

/// The casters of a scene, part by part in the order of their first instances, as a map sees them: x east, y north, z up.
[[nodiscard]] std::vector<CasterPart> castersOf(const scene::Scene& scene);

}  // namespace umbrage::outline
