#include "umbrage/techniques/cpu/detail/rays.hpp"

#include <algorithm>
#include <array>

#include "umbrage/trace/light_rays.hpp"
#include "umbrage/trace/tiles.hpp"
#include "umbrage/trace/visible_surfaces.hpp"

namespace umbrage::techniques::detail {
namespace {

/// What the pixels of one light's mask are computed from.
struct Shadowing {
  const shadow::SurfaceBuffer& seen;
  const FacingPoints facing;
  const Hidden& hidden;
};

bool isWhole(const trace::Tile& tile, int x, int y) { return x + 4 <= tile.x1 && y + 2 <= tile.y1; }

Seen8 look(const shadow::SurfaceBuffer& seen, const trace::Tile& tile, int x, int y) {
  Seen8 packet;
  if (isWhole(tile, x, y)) {
    for (int row = 0; row < 2; ++row) {
      std::copy_n(seen.triangle.row(y + row) + x, 4, packet.triangle.data() + 4 * row);
      std::copy_n(seen.depth.row(y + row) + x, 4, packet.depth.data() + 4 * row);
    }
    return packet;
  }
  packet.triangle.fill(shadow::kNoTriangle);
  packet.depth.fill(0.0f);
  trace::forEachLane(tile, x, y, [&](int lane, int px, int py) {
    const auto k = static_cast<std::size_t>(lane);
    packet.triangle[k] = seen.triangle(px, py), packet.depth[k] = seen.depth(px, py);
  });
  return packet;
}

void mark(const trace::Tile& tile, int x, int y, std::uint32_t lanes, image::GreyImage& lit) {
  std::array<std::uint8_t, 8> bytes;
  for (std::size_t k = 0; k < 8; ++k) bytes[k] = trace::hasLane(lanes, k) ? 255 : 0;
  if (isWhole(tile, x, y)) {
    std::copy_n(bytes.data(), 4, lit.row(y) + x);
    std::copy_n(bytes.data() + 4, 4, lit.row(y + 1) + x);
  } else {
    trace::forEachLane(tile, x, y, [&](int k, int px, int py) { lit(px, py) = bytes[static_cast<std::size_t>(k)]; });
  }
}

// Two rows of a tile.
void shadeRows(const Shadowing& s, const trace::Tile& tile, int y, FacingPoints::Faces& faces, image::GreyImage& lit) {
  constexpr std::size_t kBatch = trace::LightRays::kBatch;
  std::array<trace::SurfacePoints8, kBatch> points;
  std::array<std::uint32_t, kBatch> hidden;
  std::array<int, kBatch> column;
  for (int x = tile.x0; x < tile.x1;) {
    std::size_t count = 0;
    for (; x < tile.x1 && count < kBatch; x += 4) {
      column[count] = x;
      if (s.facing.place(look(s.seen, tile, x, y), x, y, faces, points[count])) ++count;
    }
    s.hidden({points.data(), count}, {hidden.data(), count});
    for (std::size_t i = 0; i < count; ++i) mark(tile, column[i], y, points[i].active & ~hidden[i], lit);
  }
}

void markCovered(const shadow::SurfaceBuffer& seen, const trace::Tile& tile, image::GreyImage& covered) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    const std::uint32_t* triangle = seen.triangle.row(y);
    std::uint8_t* row = covered.row(y);
    for (int x = tile.x0; x < tile.x1; ++x) row[x] = triangle[x] != shadow::kNoTriangle ? 1 : 0;
  }
}

}  // namespace

Rays::Rays(trace::Occlusion occlusion) : occlusion_(std::move(occlusion)), planes_(planesOf(occlusion_.surfaces())) {}

Result<Rays> Rays::build(const std::shared_ptr<const shadow::Geometry>& geometry) {
  auto built = trace::Occlusion::build({geometry, &geometry->surfaces});
  if (!built) return tl::unexpected(built.error());
  return Rays(std::move(*built));
}

Result<shadow::LightMask> Rays::mask(const scene::Camera& camera, const scene::Light& light,
                                     const shadow::SurfaceBuffer& seen) const {
  const trace::LightRays rays(occlusion_, light);
  return mask(camera, light, seen, [&](auto points, auto hidden) { rays.hidden(points, hidden); });
}

Result<shadow::LightMask> Rays::mask(const scene::Camera& camera, const scene::Light& light,
                                     const shadow::SurfaceBuffer& seen, const Hidden& hidden) const {
  const Shadowing s{seen, FacingPoints(occlusion_.surfaces(), planes_, camera, light), hidden};
  shadow::LightMask mask{{camera.width, camera.height}, {}, {camera.width, camera.height}};
  const auto done = trace::forEachTile(camera.width, camera.height, [&](const trace::Tile& tile) {
    markCovered(seen, tile, mask.covered);
    FacingPoints::Faces faces;
    for (int y = tile.y0; y < tile.y1; y += 2) shadeRows(s, tile, y, faces, mask.light);
  });
  if (!done) return tl::unexpected(done.error());
  return mask;
}

Result<void> RaySight::see(const Rays& rays, const scene::Camera& camera) {
  if (isOf(camera)) return {};
  camera_.reset();
  auto surface = trace::visibleSurfaces(rays.occlusion(), camera);
  if (!surface) return tl::unexpected(surface.error());
  surface_ = std::move(*surface);
  camera_ = camera;
  return {};
}

}  // namespace umbrage::techniques::detail
