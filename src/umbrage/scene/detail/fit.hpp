#pragma once

#include <algorithm>
#include <limits>

#include "umbrage/scene/camera.hpp"

namespace umbrage::scene::detail {

/// How far from an anchor, and how far sideways of it, a camera must stand to see points within an opening.
///
/// A point at (s, z) from the anchor, sideways and forward, is seen from distance d with shift e when |s - e| <= (d + z) t.
/// Both senses bound e from above and below; the smallest d that leaves one e is where the two bounds meet.
class Fit {
 public:
  /// `tangent`: of half the opening.
  Fit(const Vec3& sideways, const Vec3& forward, double tangent)
      : sideways_(sideways), forward_(forward), tangent_(tangent) {}
  void add(const Vec3& fromAnchor) {
    const double s = glm::dot(fromAnchor, sideways_);
    const double z = glm::dot(fromAnchor, forward_) * tangent_;
    high_ = std::max(high_, s - z);
    low_ = std::max(low_, -s - z);
  }
  /// REQUIRES for both: a point was added.
  [[nodiscard]] double distance() const { return (high_ + low_) / (2.0 * tangent_); }
  [[nodiscard]] double shift() const { return 0.5 * (high_ - low_); }

 private:
  Vec3 sideways_, forward_;
  double tangent_;
  double high_ = -std::numeric_limits<double>::infinity();
  double low_ = -std::numeric_limits<double>::infinity();
};

/// The camera of frameAll for the points that `addAll` adds to a sink of points; `bounds` holds them all.
template <class AddAll>
Camera frame(const Box3& bounds, UpAxis up, Angle northOffset, Angle fovY, int width, int height,
             const AddAll& addAll) {
  constexpr double filled = 0.94;   // the part of the picture that is filled
  constexpr double outside = 1.05;  // how far out the camera stays, in radii of the scene
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
  if (bounds.empty()) return camera;
  const CameraBasis b = basis(camera);
  const double tangent = filled * tan(0.5 * fovY);
  Fit upright(b.up, b.forward, tangent);
  Fit across(b.right, b.forward, tangent * double(width) / double(height));
  addAll([&](const Vec3& point) {
    upright.add(point - bounds.centre());
    across.add(point - bounds.centre());
  });
  camera.target += upright.shift() * b.up + across.shift() * b.right;
  // A wide view would let the camera touch the scene: it stays outside the sphere around it.
  const double distance = std::max({upright.distance(), across.distance(), outside * bounds.radius(), 1e-6});
  camera.eye = camera.target + distance * backward;
  return camera;
}

}  // namespace umbrage::scene::detail
