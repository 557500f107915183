#include "umbrage/techniques/cpu/detail/scan_picture.hpp"

#include <algorithm>
#include <limits>
#include <variant>

#include "umbrage/raster/surfaces.hpp"
#include "umbrage/shadow/averted_faces.hpp"
#include "umbrage/techniques/cpu/detail/facing_memo.hpp"

namespace umbrage::techniques::detail {
namespace {

using raster::kBand;
using raster::Patch;
using raster::Run;
using raster::Slope;

}  // namespace

ScanPicture::ScanPicture(std::shared_ptr<const shadow::Geometry> geometry)
    : geometry_(std::move(geometry)), casterOf_(geometry_->surfaces.triangles.size(), shadow::kNoTriangle) {
  const std::vector<std::uint32_t>& origin = geometry_->casters.surfaceTriangle;
  for (std::uint32_t t = 0; t < origin.size(); ++t) casterOf_[origin[t]] = t;
}

Result<shadow::Shading> ScanPicture::shade(const shadow::Frame& frame, const MaskMaker& maskOf) {
  shadow::Shading out;
  shadow::PhaseClock clock(out.stats.phases);
  if (auto done = see(frame.camera); !done) return tl::unexpected(done.error());
  auto seen = surface();
  if (!seen) return tl::unexpected(seen.error());
  out.surface = std::move(*seen);
  clock.end("surface");
  for (const scene::Light& light : frame.lights) {
    auto mask = maskOf(light, out.stats, clock);
    if (!mask) return tl::unexpected(mask.error());
    out.masks.push_back(std::move(*mask));
  }
  return out;
}

Result<void> ScanPicture::see(const scene::Camera& camera) {
  const scene::Surfaces& surfaces = geometry_->surfaces;
  camera_ = camera;
  space_ = raster::pixelSpace(camera, surfaces);
  if (auto done = raster::mapPositions(space_, surfaces.positions, positions_); !done) return done;
  if (auto done = fillBands(); !done) return done;
  rows_.resize(static_cast<std::size_t>(camera.height));
  return parallel::forEach(bands_.count(), [&](int band) { findRuns(band); });
}

// Averted faces of a convex solid hide behind its others.
Result<void> ScanPicture::fillBands() {
  const std::vector<std::uint8_t> averted = shadow::avertedFaces(*geometry_, space_.eye);
  invisible_.clear();
  const auto make = [&](std::size_t i, Patch& patch) {
    const auto triangle = static_cast<std::uint32_t>(i);
    if (averted[i] != 0) return false;
    const raster::Shown shown = raster::makeSurfacePatch(space_, positions_, geometry_->surfaces, triangle, patch);
    if (shown == raster::Shown::edgeOn && casterOf_[i] != shadow::kNoTriangle) {
      const std::lock_guard lock(edgeOnMutex_);
      invisible_.push_back(casterOf_[i]);
    }
    return shown == raster::Shown::yes;
  };
  auto done = bands_.fill(geometry_->surfaces.triangles.size(), space_.height, make,
                          [](const Patch&, int) { return ~std::uint64_t{0}; });
  std::sort(invisible_.begin(), invisible_.end());
  return done;
}

void ScanPicture::findRuns(int band) {
  const int first = band * kBand, end = std::min(space_.height, first + kBand);
  const raster::Corners corners{positions_.mapped, {}};
  raster::ActiveList active(corners, first, end);
  bands_.forEachIn(band, [&](const Patch& patch, std::uint64_t) { active.add(patch); });
  raster::VisibleRuns visible;
  for (int y = first; y < end; ++y) {
    active.moveTo(y);
    visible.find(active.row(), y, rows_[static_cast<std::size_t>(y)]);
  }
}

Result<shadow::SurfaceBuffer> ScanPicture::surface() const {
  shadow::SurfaceBuffer out{image::Image<std::uint32_t>::unset(space_.width, space_.height),
                            image::Image<float>::unset(space_.width, space_.height)};
  auto done = parallel::forEach(bands_.count(), [&](int band) {
    for (int y = band * kBand; y < std::min(space_.height, (band + 1) * kBand); ++y) {
      std::fill_n(out.triangle.row(y), space_.width, shadow::kNoTriangle);
      std::fill_n(out.depth.row(y), space_.width, std::numeric_limits<float>::infinity());
      for (const Run& run : rows_[static_cast<std::size_t>(y)]) {
        const Slope nearness = raster::alongRow(*run.surface, 3, y);
        for (int x = run.pixels.begin; x < run.pixels.end; ++x) {
          out.triangle.row(y)[x] = run.surface->id;
          out.depth.row(y)[x] = static_cast<float>(1.0 / (nearness.at(x) * space_.scale));
        }
      }
    }
  });
  if (!done) return tl::unexpected(done.error());
  return out;
}

void ScanPicture::darkenBeyondCone(const scene::Light& light, int y, std::span<const Run> runs,
                                   std::uint8_t* lit) const {
  const scene::PixelRays rays = scene::pixelRays(camera_);
  for (const Run& run : runs) {
    const Slope nearness = raster::alongRow(*run.surface, 3, y);
    for (int x = run.pixels.begin; x < run.pixels.end; ++x) {
      const Vec3 point = camera_.eye + rays.through(x + 0.5, y + 0.5) / (nearness.at(x) * space_.scale);
      if (lit[x] != 0 && !scene::insideCone(light, point)) lit[x] = 0;
    }
  }
}

Result<shadow::LightMask> ScanPicture::paint(const scene::Light& light, const BandShader& shader) const {
  shadow::LightMask mask{
      image::GreyImage::unset(space_.width, space_.height), {}, image::GreyImage::unset(space_.width, space_.height)};
  const scene::Surfaces& surfaces = geometry_->surfaces;
  FacingMemo facing(surfaces, Vec4(space_.eye, 1.0), scene::homogeneous(light, surfaces.origin));
  const bool isSpot = std::holds_alternative<scene::SpotLight>(light.shape);
  auto done = parallel::forEach(bands_.count(), [&](int band) {
    const int first = band * kBand, end = std::min(space_.height, first + kBand);
    const RowShader shade = shader(band, first, end);
    std::vector<Run> receivers;
    for (int y = first; y < end; ++y) {
      std::uint8_t *lit = mask.light.row(y), *covered = mask.covered.row(y);
      std::fill_n(lit, space_.width, std::uint8_t{0});
      std::fill_n(covered, space_.width, std::uint8_t{0});
      receivers.clear();
      for (const Run& run : rows_[static_cast<std::size_t>(y)]) {
        std::fill(covered + run.pixels.begin, covered + run.pixels.end, std::uint8_t{1});
        if (facing.faces(run.surface->id)) receivers.push_back(run);
      }
      if (receivers.empty()) continue;
      shade(y, receivers, lit);
      if (isSpot) darkenBeyondCone(light, y, receivers, lit);
    }
  });
  if (!done) return tl::unexpected(done.error());
  return mask;
}

}  // namespace umbrage::techniques::detail
