#pragma once

#include <span>
#include <vector>

#include "umbrage/gl/objects.hpp"
#include "umbrage/render/large_triangles.hpp"
#include "umbrage/render/view.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// Those triangles of a scene that are drawn for one view, the large ones apart (Arrangement).
class DrawnTriangles {
 public:
  /// Errors: as GpuScene has them.
  [[nodiscard]] Result<void> set(const std::vector<mesh::Triangle>& triangles, Arrangement arrangement);

  /// Per triangle drawn, the large ones apart: its id.
  [[nodiscard]] const gl::Buffer& ids() const { return ids_; }
  [[nodiscard]] const gl::VertexArray& vertices() const { return vertices_; }
  [[nodiscard]] std::size_t indexCount() const { return indexCount_; }
  /// LargeTriangle, and their corners apart from those of the others.
  [[nodiscard]] const gl::Buffer& largeTriangles() const { return large_; }
  [[nodiscard]] const gl::VertexArray& largeVertices() const { return largeVertices_; }
  [[nodiscard]] std::size_t largeIndexCount() const { return largeIndexCount_; }

 private:
  gl::Buffer drawn_, ids_, large_, largeDrawn_;
  gl::VertexArray vertices_{drawn_}, largeVertices_{largeDrawn_};
  std::size_t indexCount_ = 0, largeIndexCount_ = 0;
  std::vector<std::uint32_t> ordinary_;  ///< as `ids_` has them
};

/// The surfaces of a scene on the graphics card, uploaded once; only which of them are drawn may change. Shadow volumes share its
/// positions.
class GpuScene {
 public:
  /// Errors: ErrorCode::device when memory is short, or the scene is larger than a buffer of this driver may be.
  [[nodiscard]] static Result<GpuScene> make(const scene::Surfaces& surfaces);

  /// Chooses what is drawn for a view (Arrangement); before the first call nothing is. All keep their ids.
  /// REQUIRES: geometry.surfaces is what it was made from.
  [[nodiscard]] Result<void> arrangeFor(const shadow::Geometry& geometry, const View& view, int width, int height);
  /// The same where veils are seen through: drawn() is what is opaque, veils() the rest.
  [[nodiscard]] Result<void> arrangeApart(const shadow::Geometry& geometry, const View& view, int width, int height);

  [[nodiscard]] const gl::Buffer& positions() const { return positions_; }
  [[nodiscard]] const gl::Buffer& corners() const { return corners_; }
  /// Per triangle: unit normal, and the bits of its material index.
  [[nodiscard]] const gl::Buffer& triangles() const { return triangles_; }
  [[nodiscard]] const DrawnTriangles& drawn() const { return drawn_; }
  [[nodiscard]] const DrawnTriangles& veils() const { return veils_; }

 private:
  GpuScene() = default;
  gl::Buffer positions_, corners_, triangles_;
  DrawnTriangles drawn_, veils_;
};

/// A buffer that shaders read, or an error that says what was too large.
[[nodiscard]] Result<void> setStorage(gl::Buffer& buffer, std::span<const std::byte> bytes, const char* what);

}  // namespace umbrage::render
