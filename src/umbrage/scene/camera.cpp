#include "umbrage/scene/camera.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/base/check.hpp"
#include "umbrage/scene/detail/fit.hpp"

namespace umbrage::scene {
namespace {

// The coordinate axis farthest from a direction: a stand-in for an up vector that says nothing.
Vec3 leastAlignedAxis(const Vec3& v) {
  const Vec3 a = glm::abs(v);
  if (a.z <= a.x && a.z <= a.y) return {0, 0, 1};
  return a.y <= a.x ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
}

}  // namespace

Vec3 upVector(UpAxis up) { return up == UpAxis::y ? Vec3(0, 1, 0) : Vec3(0, 0, 1); }

Vec3 eastVector(UpAxis up, Angle northOffset) { return glm::cross(northVector(up, northOffset), upVector(up)); }

Vec3 northVector(UpAxis up, Angle northOffset) {
  // The frame's own north; its true north lies clockwise of it, that is, towards +X.
  const Vec3 frameNorth = up == UpAxis::y ? Vec3(0, 0, -1) : Vec3(0, 1, 0);
  return cos(northOffset) * frameNorth + sin(northOffset) * Vec3(1, 0, 0);
}

CameraBasis basis(const Camera& camera) {
  Vec3 forward = camera.target - camera.eye;
  const double length = glm::length(forward);
  forward = length > 0.0 && std::isfinite(length) ? forward / length : Vec3(0, 0, -1);
  Vec3 right = glm::cross(forward, camera.up);
  if (!(glm::length(right) > 1e-9 * std::max(1e-300, glm::length(camera.up))))
    right = glm::cross(forward, leastAlignedAxis(forward));
  right = glm::normalize(right);
  return {right, glm::cross(right, forward), forward};
}

PixelRays pixelRays(const Camera& camera) {
  UMBRAGE_CHECK(camera.width > 0 && camera.height > 0, "camera size");
  const CameraBasis b = basis(camera);
  const double tangent = tan(0.5 * camera.fovY);
  const double aspect = double(camera.width) / double(camera.height);
  PixelRays rays;
  rays.corner = b.forward - tangent * aspect * b.right + tangent * b.up;
  rays.dx = (2.0 * tangent * aspect / camera.width) * b.right;
  rays.dy = (-2.0 * tangent / camera.height) * b.up;
  return rays;
}

Camera frameAll(const Box3& bounds, UpAxis up, Angle northOffset, Angle fovY, int width, int height) {
  return detail::frame(bounds, up, northOffset, fovY, width, height, [&](const auto& add) {
    for (int i = 0; i < 8; ++i)
      add(Vec3(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
               i & 4 ? bounds.max.z : bounds.min.z));
  });
}

}  // namespace umbrage::scene
