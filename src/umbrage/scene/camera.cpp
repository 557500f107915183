#include "umbrage/scene/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrage/base/check.hpp"

namespace umbrage::scene {
namespace {

// The coordinate axis farthest from a direction: a stand-in for an up vector that says nothing.
Vec3 leastAlignedAxis(const Vec3& v) {
  const Vec3 a = glm::abs(v);
  if (a.z <= a.x && a.z <= a.y) return {0, 0, 1};
  return a.y <= a.x ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
}

// The part of the picture that frameAll lets a scene fill.
constexpr double kFilled = 0.94;
// How far out the camera stays, in radii of the scene.
constexpr double kOutside = 1.05;

/// How far from the centre of a box, and how far sideways, a camera must stand.
struct Fit {
  double distance = 0.0;
  double shift = 0.0;
};

// A corner at (s, z) from the centre, sideways and forward, is seen from distance d with shift e when |s - e| <= (d + z) t.
// Both senses bound e from above and below; the smallest d that leaves one e is where the two bounds meet.
Fit fitBox(const Box3& box, const Vec3& sideways, const Vec3& forward, double tangent) {
  if (box.empty()) return {};
  double high = -std::numeric_limits<double>::infinity(), low = high;
  const Vec3 half = 0.5 * box.size();
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 c = half * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double s = glm::dot(c, sideways);
    const double z = glm::dot(c, forward) * tangent;
    high = std::max(high, s - z);
    low = std::max(low, -s - z);
  }
  return {(high + low) / (2.0 * tangent), 0.5 * (high - low)};
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
  Camera camera;
  camera.up = upVector(up);
  camera.fovY = fovY;
  camera.width = width;
  camera.height = height;
  const Vec3 southWest = glm::normalize(-northVector(up, northOffset) - eastVector(up, northOffset));
  const Angle elevation = Angle::degrees(30);
  const Vec3 backward = cos(elevation) * southWest + sin(elevation) * camera.up;
  camera.target = bounds.centre();
  camera.eye = camera.target + backward;
  const CameraBasis b = basis(camera);
  const double tangent = kFilled * tan(0.5 * fovY);
  const auto upright = fitBox(bounds, b.up, b.forward, tangent);
  const auto across = fitBox(bounds, b.right, b.forward, tangent * double(width) / double(height));
  camera.target += upright.shift * b.up + across.shift * b.right;
  // A wide view would let the camera touch the scene: it stays outside the sphere around it.
  const double distance = std::max({upright.distance, across.distance, kOutside * bounds.radius(), 1e-6});
  camera.eye = camera.target + distance * backward;
  return camera;
}

}  // namespace umbrage::scene
