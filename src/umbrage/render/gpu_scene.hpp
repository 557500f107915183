#pragma once

#include <span>

#include "umbrage/gl/objects.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::render {

/// The surfaces of a scene on the graphics card, uploaded once, const afterwards. Shadow volumes share its positions.
class GpuScene {
 public:
  /// Errors: ErrorCode::device when memory is short, or the scene is larger than a buffer of this driver may be.
  [[nodiscard]] static Result<GpuScene> make(const scene::Surfaces& surfaces);

  [[nodiscard]] const gl::Buffer& positions() const { return positions_; }
  [[nodiscard]] const gl::Buffer& corners() const { return corners_; }
  /// Per triangle: unit normal, and the bits of its material index.
  [[nodiscard]] const gl::Buffer& triangles() const { return triangles_; }
  [[nodiscard]] const gl::VertexArray& vertices() const { return vertices_; }
  [[nodiscard]] std::size_t indexCount() const { return indexCount_; }

 private:
  GpuScene() = default;
  gl::Buffer positions_, corners_, triangles_;
  gl::VertexArray vertices_;
  std::size_t indexCount_ = 0;
};

/// A buffer that shaders read, or an error that says what was too large.
[[nodiscard]] Result<void> setStorage(gl::Buffer& buffer, std::span<const std::byte> bytes, const char* what);

}  // namespace umbrage::render
