#include "umbrage/techniques/cpu/detail/cpu_volumes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <variant>

#include "umbrage/techniques/cpu/detail/facing_memo.hpp"

namespace umbrage::techniques::detail {
using raster::Int8;
using raster::kBlock;

CpuVolumes::CpuVolumes(std::shared_ptr<const shadow::Geometry> geometry)
    : geometry_(std::move(geometry)), surfaces_(*geometry_), count_(geometry_->casters) {
  findCasters();
}

void CpuVolumes::use(std::shared_ptr<const shadow::Geometry> geometry) {
  surfaces_.use(*geometry);
  count_.use(geometry->casters);
  geometry_ = std::move(geometry);
  camera_.reset();
  finder_.reset();
  findCasters();
}

void CpuVolumes::findCasters() {
  casterOf_.assign(geometry_->surfaces.triangles.size(), shadow::kNoTriangle);
  const std::vector<std::uint32_t>& origin = geometry_->casters.surfaceTriangle;
  for (std::uint32_t t = 0; t < origin.size(); ++t) casterOf_[origin[t]] = t;
}

Result<void> CpuVolumes::see(const scene::Camera& camera) {
  if (hasSeen(camera)) return {};
  camera_.reset();
  const scene::Surfaces& surfaces = geometry_->surfaces;
  space_ = raster::pixelSpace(camera, surfaces);
  if (auto done = raster::mapPositions(space_, surfaces.positions, positions_); !done) return done;
  if (auto done = surfaces_.draw(space_, positions_, seen_); !done) return done;
  invisible_.clear();
  for (const std::uint32_t t : surfaces_.edgeOn())
    if (casterOf_[t] != shadow::kNoTriangle) invisible_.push_back(casterOf_[t]);
  camera_ = camera;
  return {};
}

std::uint64_t CpuVolumes::receiversIn(std::size_t block, FacingMemo& facing) const {
  const raster::BlockSummary& summary = seen_.summary[block];
  if (summary.covered == 0) return 0;
  if (summary.triangle == raster::BlockSummary::kSeveral)
    return receiversOf(seen_.triangle.blocks[block].pixel, facing);
  return facing.faces(summary.triangle) ? summary.covered : 0;
}

Result<void> CpuVolumes::findReceivers(const Vec4& light) {
  FacingMemo facing(geometry_->surfaces, Vec4(space_.eye, 1.0), light);
  receivers_.resize(seen_.triangle.blocks.size());
  const auto columns = static_cast<std::size_t>(seen_.triangle.columns);
  return parallel::forEach(seen_.triangle.rows, [&](int row) {
    for (std::size_t i = static_cast<std::size_t>(row) * columns, end = i + columns; i < end; ++i)
      receivers_[i] = receiversIn(i, facing);
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

namespace {

using Bytes = std::uint8_t __attribute__((vector_size(8), may_alias));
using Signs = std::int8_t __attribute__((vector_size(8), may_alias));

// All bits of a byte where its lane's bit is set.
UMBRAGE_IN_BLOCKS Bytes spread(std::uint64_t bits) {
  const Bytes own{1, 2, 4, 8, 16, 32, 64, 128};
  return reinterpret_cast<Bytes>(((Bytes{} + static_cast<std::uint8_t>(bits)) & own) != Bytes{});
}

/// A block of a mask, row by row.
struct MaskBlock {
  std::array<std::uint8_t, 64> light, covered;
};

// Lit are those of `receivers` with nothing counted.
UMBRAGE_VECTOR_UNITS void paintBlock(const raster::ShadowCount::Counted& counted, std::uint64_t receivers,
                                     std::uint64_t covered, MaskBlock& out) {
  if (counted.pixels == nullptr) {
    if (counted.whole != 0) receivers = 0;
    if ((receivers == 0 || receivers == ~std::uint64_t{0}) && covered == ~std::uint64_t{0}) {
      out.light.fill(receivers == 0 ? 0 : 255), out.covered.fill(1);
      return;
    }
  }
  for (int row = 0; row < kBlock; ++row) {
    Bytes lit = spread(receivers >> (row * kBlock) & 0xff);
    if (counted.pixels != nullptr) {
      const Int8 counts = reinterpret_cast<const Int8&>(counted.pixels[row * kBlock]);
      lit &= reinterpret_cast<Bytes>(__builtin_convertvector(counts == Int8{} - counted.whole, Signs));
    }
    const Bytes seen = spread(covered >> (row * kBlock) & 0xff) & std::uint8_t{1};
    __builtin_memcpy(out.light.data() + row * kBlock, &lit, kBlock);
    __builtin_memcpy(out.covered.data() + row * kBlock, &seen, kBlock);
  }
}

void store(const MaskBlock& block, int x, int y, shadow::LightMask& mask) {
  const int width = std::min(kBlock, mask.light.width() - x), height = std::min(kBlock, mask.light.height() - y);
  if (width == kBlock) {  // a row is one number
    for (int row = 0; row < height; ++row) {
      std::memcpy(mask.light.row(y + row) + x, block.light.data() + row * kBlock, kBlock);
      std::memcpy(mask.covered.row(y + row) + x, block.covered.data() + row * kBlock, kBlock);
    }
    return;
  }
  for (int row = 0; row < height; ++row) {
    std::copy_n(block.light.data() + row * kBlock, width, mask.light.row(y + row) + x);
    std::copy_n(block.covered.data() + row * kBlock, width, mask.covered.row(y + row) + x);
  }
}

}  // namespace

Result<shadow::LightMask> CpuVolumes::mask(const scene::Camera& camera, const scene::Light& light,
                                           shadow::PhaseClock& clock) {
  shadow::LightMask mask{
      image::GreyImage::unset(camera.width, camera.height), {}, image::GreyImage::unset(camera.width, camera.height)};
  const bool isSpot = std::holds_alternative<scene::SpotLight>(light.shape);
  const scene::PixelRays rays = scene::pixelRays(camera);
  const auto inCone = [&](std::uint32_t triangle, int x, int y) {
    const Vec3 ray = rays.through(x + 0.5, y + 0.5);
    return scene::insideCone(light, camera.eye + depthOf(triangle, ray) * ray);
  };
  const auto columns = static_cast<std::size_t>(seen_.triangle.columns);
  auto done = count_.count([&](const raster::ShadowCount::Counted& counted) {
    const std::size_t i = counted.block;
    const int x = static_cast<int>(i % columns) * kBlock, y = static_cast<int>(i / columns) * kBlock;
    MaskBlock block;
    paintBlock(counted, receivers_[i], seen_.summary[i].covered, block);
    for (int k = 0; isSpot && k < kBlock * kBlock; ++k) {
      std::uint8_t& lit = block.light[static_cast<std::size_t>(k)];
      const std::uint32_t triangle = seen_.triangle.blocks[i].pixel[static_cast<std::size_t>(k)];
      if (lit != 0 && !inCone(triangle, x + k % kBlock, y + k / kBlock)) lit = 0;
    }
    store(block, x, y, mask);
  });
  if (!done) return tl::unexpected(done.error());
  clock.end("volumes");
  return mask;
}

}  // namespace umbrage::techniques::detail
