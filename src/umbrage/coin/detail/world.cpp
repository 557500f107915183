#include "umbrage/coin/detail/world.hpp"

#include <glm/matrix.hpp>

namespace umbrage::coin::detail {

// As OpenGL decides it, which goes by the signed area on the screen: the sign of the determinant of the corners' x, y and w is that of the area of
// the part before the eye, wherever the corners themselves are.
bool Unseen::isCulled(std::uint32_t triangle) const {
  const scene::Surfaces& surfaces = world_.geometry->surfaces;
  Mat3 corners;
  for (int k = 0; k < 3; ++k) {
    const Vec4 clip = view_.toClip * Vec4(surfaces.corner(triangle, k) + surfaces.origin, 1.0);
    corners[k] = Vec3(clip.x, clip.y, clip.w);
  }
  return glm::determinant(corners) * world_.culled[triangle] > 0.0;
}

std::vector<std::uint8_t> Unseen::all() const {
  std::vector<std::uint8_t> unseen;
  if (world_.veiled.empty() && world_.culled.empty()) return unseen;
  const std::size_t count = world_.geometry->surfaces.triangles.size();
  for (std::uint32_t triangle = 0; triangle < count; ++triangle) unseen.push_back((*this)(triangle) ? 1 : 0);
  return unseen;
}

}  // namespace umbrage::coin::detail
