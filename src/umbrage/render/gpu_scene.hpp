#pragma once

#include <span>
#include <vector>

#include "umbrage/gl/objects.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::render {

/// The surfaces of a scene on the graphics card, uploaded once; only which of them are drawn may change. Shadow volumes share its
/// positions.
class GpuScene {
 public:
  /// Errors: ErrorCode::device when memory is short, or the scene is larger than a buffer of this driver may be.
  [[nodiscard]] static Result<GpuScene> make(const scene::Surfaces& surfaces);

  /// Sorts what is drawn, until the next call, for an eye (Arrangement); all keep their ids.
  /// `eye` is relative to surfaces.origin. REQUIRES: `surfaces` is what it was made from.
  [[nodiscard]] Result<void> arrangeFor(const scene::Surfaces& surfaces, const Vec3& eye, const Vec3& forward);

  [[nodiscard]] const gl::Buffer& positions() const { return positions_; }
  [[nodiscard]] const gl::Buffer& corners() const { return corners_; }
  /// Per triangle: unit normal, and the bits of its material index.
  [[nodiscard]] const gl::Buffer& triangles() const { return triangles_; }
  [[nodiscard]] const gl::VertexArray& vertices() const { return vertices_; }
  [[nodiscard]] std::size_t indexCount() const { return indexCount_; }
  /// LargeTriangle, and their corners apart from those of the others.
  [[nodiscard]] const gl::Buffer& largeTriangles() const { return large_; }
  [[nodiscard]] const gl::VertexArray& largeVertices() const { return largeVertices_; }
  [[nodiscard]] std::size_t largeIndexCount() const { return largeIndexCount_; }

 private:
  GpuScene() = default;
  gl::Buffer positions_, corners_, triangles_, drawn_, large_, largeDrawn_;
  gl::VertexArray vertices_, largeVertices_;
  std::size_t indexCount_ = 0, largeIndexCount_ = 0;
  std::vector<std::uint32_t> apart_;  ///< triangles that `drawn_` leaves out
};

/// A buffer that shaders read, or an error that says what was too large.
[[nodiscard]] Result<void> setStorage(gl::Buffer& buffer, std::span<const std::byte> bytes, const char* what);

}  // namespace umbrage::render
