#include "umbrage/render/gpu_scene.hpp"

#include <bit>
#include <utility>
#include <vector>

#include "umbrage/gl/quirks.hpp"

namespace umbrage::render {
namespace {

std::vector<Vec4f> shadingOf(const scene::Surfaces& surfaces) {
  std::vector<Vec4f> rows;
  rows.reserve(surfaces.triangles.size());
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Vec3 normal = surfaces.normal(t);
    const double length = glm::length(normal);
    rows.emplace_back(length > 0.0 ? Vec3f(normal / length) : Vec3f(0.0f), std::bit_cast<float>(surfaces.materials[t]));
  }
  return rows;
}

}  // namespace

Result<void> setStorage(gl::Buffer& buffer, std::span<const std::byte> bytes, const char* what) {
  if (bytes.size() > gl::findQuirks().maxStorageBytes)
    return fail(ErrorCode::device, std::string("more ") + what + " than a buffer of this driver holds (" +
                                       std::to_string(gl::findQuirks().maxStorageBytes >> 20) + " MiB)");
  return buffer.set(bytes);
}

Result<GpuScene> GpuScene::make(const scene::Surfaces& surfaces) {
  GpuScene scene;
  const std::vector<Vec4f> shading = shadingOf(surfaces);
  for (const auto& done : {setStorage(scene.positions_, std::as_bytes(std::span(surfaces.positions)), "positions"),
                           setStorage(scene.corners_, std::as_bytes(std::span(surfaces.triangles)), "triangles"),
                           setStorage(scene.triangles_, std::as_bytes(std::span(shading)), "triangles")})
    if (!done) return tl::unexpected(done.error());
  return scene;
}

Result<void> DrawnTriangles::set(const std::vector<mesh::Triangle>& triangles, Arrangement arrangement) {
  std::vector<mesh::Triangle> large;
  for (const LargeTriangle& t : arrangement.large) large.push_back(triangles[t.id]);
  largeIndexCount_ = 3 * large.size();
  for (const auto& done : {large_.setAll(arrangement.large), largeDrawn_.setAll(large)})
    if (!done) return done;
  if (arrangement.ordinary == ordinary_) return {};
  ordinary_ = std::move(arrangement.ordinary);
  std::vector<mesh::Triangle> drawn;
  drawn.reserve(ordinary_.size());
  for (const std::uint32_t t : ordinary_) drawn.push_back(triangles[t]);
  indexCount_ = 3 * drawn.size();
  if (auto done = setStorage(ids_, std::as_bytes(std::span(ordinary_)), "triangles"); !done) return done;
  return drawn_.setAll(drawn);
}

Result<void> GpuScene::arrangeFor(const shadow::Geometry& geometry, const View& view, int width, int height) {
  return drawn_.set(geometry.surfaces.triangles, arrange(geometry, view, width, height));
}

Result<void> GpuScene::arrangeApart(const shadow::Geometry& geometry, const View& view, int width, int height) {
  const std::vector<mesh::Triangle>& triangles = geometry.surfaces.triangles;
  if (auto done = drawn_.set(triangles, arrange(geometry, view, width, height, Drawn::opaque)); !done) return done;
  if (geometry.filters.empty()) return {};
  return veils_.set(triangles, arrange(geometry, view, width, height, Drawn::veils));
}

}  // namespace umbrage::render
