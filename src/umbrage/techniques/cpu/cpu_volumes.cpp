#include "umbrage/techniques/cpu/detail/cpu_volumes.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <string>
#include <variant>

#include "umbrage/techniques/cpu/detail/facing_memo.hpp"

namespace umbrage::techniques::detail {
using raster::kBand;

CpuVolumes::CpuVolumes(std::shared_ptr<const shadow::Geometry> geometry)
    : geometry_(std::move(geometry)),
      casterOf_(geometry_->surfaces.triangles.size(), shadow::kNoTriangle),
      surfaces_(*geometry_),
      count_(geometry_->casters) {
  const std::vector<std::uint32_t>& origin = geometry_->casters.surfaceTriangle;
  for (std::uint32_t t = 0; t < origin.size(); ++t) casterOf_[origin[t]] = t;
}

Result<void> CpuVolumes::see(const scene::Camera& camera) {
  const scene::Surfaces& surfaces = geometry_->surfaces;
  space_ = raster::pixelSpace(camera, surfaces.origin, surfaces.bounds.radius(), surfaces.positions);
  if (auto done = raster::mapPositions(space_, surfaces.positions, positions_); !done) return done;
  if (auto done = surfaces_.draw(space_, positions_, seen_); !done) return done;
  invisible_.clear();
  for (const std::uint32_t t : surfaces_.edgeOn())
    if (casterOf_[t] != shadow::kNoTriangle) invisible_.push_back(casterOf_[t]);
  return {};
}

Result<void> CpuVolumes::findReceivers(const Vec4& light) {
  FacingMemo facing(geometry_->surfaces, Vec4(space_.eye, 1.0), light);
  receivers_.assign(seen_.triangle.blocks.size(), 0);
  const auto columns = static_cast<std::size_t>(seen_.triangle.columns);
  return parallel::forEach(seen_.triangle.rows, [&](int row) {
    for (std::size_t i = static_cast<std::size_t>(row) * columns, end = i + columns; i < end; ++i)
      receivers_[i] = receiversOf(seen_.triangle.blocks[i].pixel, facing);
  });
}

Result<void> CpuVolumes::look(const scene::Light& light, shadow::FinderKind finder, shadow::PhaseClock& clock) {
  if (finder == shadow::FinderKind::gpu)
    finder = shadow::FinderKind::automatic;  // there is none here, and the edges are the same
  if (finder_ == nullptr || finder_->kind() != finder)
    finder_ = shadow::makeFinder(finder, {geometry_, &geometry_->casters});
  const Vec4 homogeneous = scene::homogeneous(light, geometry_->surfaces.origin);
  if (auto done = findReceivers(homogeneous); !done) return done;
  clock.end("facing");
  silhouette_ = finder_->silhouette(homogeneous);
  clock.end("silhouette");
  return {};
}

std::size_t CpuVolumes::receiverCount() const {
  std::size_t count = 0;
  for (const std::uint64_t bits : receivers_) count += static_cast<std::size_t>(std::popcount(bits));
  return count;
}

Result<std::size_t> CpuVolumes::plan(shadow::PhaseClock& clock) {
  Box3 room = geometry_->surfaces.bounds;
  room.add(space_.eye);
  const raster::ShadowCount::Request request{.space = space_,
                                             .positions = positions_,
                                             .seen = seen_,
                                             .triangles = geometry_->surfaces.triangles,
                                             .receivers = receivers_,
                                             .room = room,
                                             .invisible = invisible_,
                                             .silhouette = silhouette_};
  if (auto done = count_.plan(request); !done) return tl::unexpected(done.error());
  clock.end("sides");
  return count_.pieceCount();
}

Result<shadow::LightMask> CpuVolumes::mask(const scene::Camera& camera, const scene::Light& light,
                                           shadow::PhaseClock& clock) {
  if (auto done = count_.count(counts_); !done) return tl::unexpected(done.error());
  clock.end("volumes");
  auto mask = paint(camera, light);
  clock.end("lit");
  return mask;
}

shadow::LightStats CpuVolumes::stats(bool detailed) const {
  const std::size_t edges = silhouette_.edges.size();
  return {.method = "zpass_cpu",
          .reason = "no caps and no stencil needed; " + std::to_string(count_.eyeCount()) +
                    " surfaces between the eye and the light",
          .edgesTested = silhouette_.edgesTested,
          .silhouetteEdges = edges,
          .volumeTriangles = count_.sideCount(),
          .eyeCount = count_.eyeCount(),
          .finder = std::string(silhouette_.finder),
          .sidesBehind = edges - std::min(edges, count_.sideCount()),
          .choices = std::vector(detailed ? geometry_->casters.componentCount : 0, shadow::CasterChoice::zPass)};
}

// In double precision, as far along `ray` as it takes to meet the triangle's plane.
double CpuVolumes::depthOf(std::uint32_t triangle, const Vec3& ray) const {
  const Vec3 normal = geometry_->surfaces.normal(triangle);
  return glm::dot(normal, geometry_->surfaces.corner(triangle, 0) - space_.eye) / glm::dot(normal, ray);
}

Result<shadow::LightMask> CpuVolumes::paint(const scene::Camera& camera, const scene::Light& light) const {
  shadow::LightMask mask{
      image::GreyImage::unset(camera.width, camera.height), {}, image::GreyImage::unset(camera.width, camera.height)};
  const bool isSpot = std::holds_alternative<scene::SpotLight>(light.shape);
  const scene::PixelRays rays = scene::pixelRays(camera);
  const auto inCone = [&](std::uint32_t triangle, int x, int y) {
    const Vec3 ray = rays.through(x + 0.5, y + 0.5);
    return scene::insideCone(light, camera.eye + depthOf(triangle, ray) * ray);
  };
  auto done = parallel::forEach((camera.height + kBand - 1) / kBand, [&](int band) {
    raster::forEachRowPiece(seen_.triangle.columns, camera.width, camera.height, band,
                            [&](std::size_t block, std::size_t first, int x, int y, int count) {
                              const std::uint32_t* triangle = seen_.triangle.blocks[block].pixel.data() + first;
                              const std::int32_t* hiding = counts_.blocks[block].pixel.data() + first;
                              const auto receivers = static_cast<std::uint32_t>(receivers_[block] >> first);
                              std::uint8_t* lit = mask.light.row(y) + x;
                              std::uint8_t* covered = mask.covered.row(y) + x;
                              for (int k = 0; k < count; ++k) {
                                covered[k] = triangle[k] != shadow::kNoTriangle ? 1 : 0;
                                lit[k] = (receivers >> k & 1u) != 0 && hiding[k] == 0 ? 255 : 0;
                              }
                              if (!isSpot) return;
                              for (int k = 0; k < count; ++k)
                                if (lit[k] != 0 && !inCone(triangle[k], x + k, y)) lit[k] = 0;
                            });
  });
  if (!done) return tl::unexpected(done.error());
  return mask;
}

}  // namespace umbrage::techniques::detail
