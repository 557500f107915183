#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/math/exact_sign.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::raster {

/// A camera as a linear map from the scene to homogeneous pixels, with the eye in the origin: (x, y, w) is seen at the point
/// (x / w, y / w) of the picture, at depth w / scale; whole numbers plus 0.5 are centres of pixels. Behind the eye w is negative.
/// 1. Determinants keep their sign.
/// 2. Each point is rounded once, in double precision, so whoever asks about it sees the same one.
struct PixelSpace {
  Mat3 fromScene{1.0};
  Vec3 eye{0.0};       ///< relative to the origin of what is mapped
  double scale = 1.0;  ///< a power of two that keeps coordinates near 1
  int width = 0, height = 0;

  [[nodiscard]] Vec3 map(const Vec3& point) const { return fromScene * (point - eye); }
  /// A light, homogeneous.
  [[nodiscard]] Sighted map(const Vec4& light) const { return {fromScene * (Vec3(light) - eye * light.w), light.w}; }
  /// From distance along the view to what patches compare: w = 1 / nearness.
  [[nodiscard]] float depth(float nearness) const { return static_cast<float>(1.0 / (double(nearness) * scale)); }
};

/// `origin`: that of what will be mapped. `radius`: of the scene, in scene units, for the scale.
[[nodiscard]] PixelSpace pixelSpace(const scene::Camera& camera, const Vec3& origin, double radius);
/// Of surfaces. An eye on one of them, from where its corners have no direction or its plane no side, is moved by 2^-40 of the triangle's size.
[[nodiscard]] PixelSpace pixelSpace(const scene::Camera& camera, const scene::Surfaces& surfaces);

/// The positions of a scene for one camera.
struct SeenPositions {
  std::vector<Vec3> mapped;
  std::vector<std::uint8_t>
      outside;  ///< per position: a bit for each of the picture's sides that it lies beyond, one for behind the eye
};
/// Errors: ErrorCode::device when memory runs out.
[[nodiscard]] Result<void> mapPositions(const PixelSpace& space, std::span<const Vec3f> positions, SeenPositions& out);

}  // namespace umbrage::raster
