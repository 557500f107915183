#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "umbrage/math/box.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::mesh {

/// Three indices of corners.
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle mesh in its own coordinates. Any topology; nothing is promised but
/// 1. every index is below positions.size(), 2. every coordinate is finite, 3. materials is empty or one entry a triangle.
struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> materials;  ///< index into Scene::materials per triangle; empty: all 0

  [[nodiscard]] Box3 bounds() const {
    Box3 box;
    for (const Vec3& p : positions) box.add(p);
    return box;
  }
};

}  // namespace umbrage::mesh
