#pragma once

#include <span>

#include "umbrage/gl/objects.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::render {

/// The surfaces of a scene on the graphics card, uploaded once; only which of them are drawn may change. Shadow volumes share its
/// positions.
class GpuScene {
 public:
  /// Errors: ErrorCode::device when memory is short, or the scene is larger than a buffer of this driver may be.
  [[nodiscard]] static Result<GpuScene> make(const scene::Surfaces& surfaces);

  /// Leaves out of what is drawn, until the next call, the triangles in whose plane the eye lies; the others keep their ids.
  /// They are not seen, but single precision might tilt them into view: the ground, for an eye at its very height, would cover
  /// half the picture. `eye` is relative to surfaces.origin. REQUIRES: `surfaces` is what it was made from.
  [[nodiscard]] Result<void> leaveOutEdgeOn(const scene::Surfaces& surfaces, const Vec3& eye);

  [[nodiscard]] const gl::Buffer& positions() const { return positions_; }
  [[nodiscard]] const gl::Buffer& corners() const { return corners_; }
  /// Per triangle: unit normal, and the bits of its material index.
  [[nodiscard]] const gl::Buffer& triangles() const { return triangles_; }
  [[nodiscard]] const gl::VertexArray& vertices() const { return vertices_; }
  [[nodiscard]] std::size_t indexCount() const { return indexCount_; }

 private:
  GpuScene() = default;
  gl::Buffer positions_, corners_, triangles_, drawn_;
  gl::VertexArray vertices_;
  std::size_t indexCount_ = 0;
  bool complete_ = true;  ///< nothing is left out
};

/// A buffer that shaders read, or an error that says what was too large.
[[nodiscard]] Result<void> setStorage(gl::Buffer& buffer, std::span<const std::byte> bytes, const char* what);

}  // namespace umbrage::render
