#include "umbrage/coin/detail/shape_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrage/mesh/weld.hpp"

namespace umbrage::coin::detail {

std::shared_ptr<const mesh::Mesh> meshOf(std::span<const Vec3> corners) {
  if (corners.empty()) return nullptr;
  const mesh::Weld weld = mesh::weld(corners);
  auto mesh = std::make_shared<mesh::Mesh>();
  for (const std::uint32_t first : weld.first) mesh->positions.push_back(corners[first]);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    mesh->triangles.push_back({weld.remap[i], weld.remap[i + 1], weld.remap[i + 2]});
  return mesh;
}

double reachOf(std::span<const Vec3> corners) {
  double reach = 0.0;
  for (const Vec3& p : corners) {
    for (int k = 0; k < 3; ++k) {
      if (!std::isfinite(p[k])) return std::numeric_limits<double>::infinity();
      reach = std::max(reach, std::abs(p[k]));
    }
  }
  return reach;
}

double reachInWorld(double reach, const Mat4& toWorld) {
  double most = 0.0;
  for (int row = 0; row < 3; ++row) {
    const double bound = reach * (std::abs(toWorld[0][row]) + std::abs(toWorld[1][row]) + std::abs(toWorld[2][row])) +
                         std::abs(toWorld[3][row]);
    if (!(bound <= most)) most = bound;
    if (std::isnan(most)) return most;
  }
  return most;
}

}  // namespace umbrage::coin::detail
