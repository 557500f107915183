#pragma once

#include "umbrage/base/angle.hpp"
#include "umbrage/math/box.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::scene {

/// The axis that points to the sky in a file's own coordinates.
enum class UpAxis { y, z };
[[nodiscard]] Vec3 upVector(UpAxis up);
/// Horizontal east and north of the file's frame: east is +X; north is +Y when up is Z and -Z when up is Y, turned so that true
/// north lies `northOffset` clockwise of it.
[[nodiscard]] Vec3 eastVector(UpAxis up, Angle northOffset = {});
[[nodiscard]] Vec3 northVector(UpAxis up, Angle northOffset = {});

/// A pinhole camera in world coordinates. There is no near and no far plane.
/// Pixel (i, j), from the top left, looks through ((i + 0.5) / width, (j + 0.5) / height).
struct Camera {
  Vec3 eye{0.0};
  Vec3 target{0.0, 0.0, -1.0};
  Vec3 up{0.0, 0.0, 1.0};           ///< any vector; where it is parallel to the view another is taken
  Angle fovY = Angle::degrees(45);  ///< vertical field of view, in (0, 180) degrees
  int width = 1280;
  int height = 720;
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// Unit vectors of a camera: right, up (in the picture) and forward.
struct CameraBasis {
  Vec3 right, up, forward;
};
[[nodiscard]] CameraBasis basis(const Camera& camera);

/// Directions through pixels, prepared once: direction(x, y) = corner + x * dx + y * dy, for pixel coordinates (x, y) that are
/// whole numbers plus 0.5 at centres. Not normalised: the component along forward is 1.
struct PixelRays {
  Vec3 corner, dx, dy;
  [[nodiscard]] Vec3 through(double x, double y) const { return corner + x * dx + y * dy; }
};
[[nodiscard]] PixelRays pixelRays(const Camera& camera);

/// A camera that sees the whole of `bounds` from the (true) south-west at 30 degrees above the horizon, as large as fits into
/// 94 % of the picture. Its target is near the centre of `bounds`.
[[nodiscard]] Camera frameAll(const Box3& bounds, UpAxis up, Angle northOffset, Angle fovY, int width, int height);

}  // namespace umbrage::scene
