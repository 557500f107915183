#include "umbrage/techniques/cpu/detail/scanline_projected.hpp"

#include <fmt/format.h>

#include <optional>

#include "umbrage/raster/projected_edges.hpp"
#include "umbrage/techniques/cpu/detail/scan_picture.hpp"
#include "umbrage/techniques/cpu/detail/shadow_lists.hpp"

namespace umbrage::techniques::detail {
namespace {

using raster::Run;
using raster::Stretch;

// Lights the pixels of runs that no caster hides from the light.
class RunLighting {
 public:
  RunLighting(const ScanPicture& picture, const scene::PixelRays& rays, const raster::ProjectedEdges& edges,
              const ShadowLists& lists)
      : picture_(picture), rays_(rays), edges_(edges), lists_(lists) {}

  void light(const Run& run, int y, std::uint8_t* lit) {
    surface_ = raster::surfaceRow(picture_.space(), *run.surface, y);
    itself_ = picture_.casterOf()[run.surface->id];
    lightPiece(run.pixels, cellAt(run.pixels.begin), cellAt(run.pixels.end - 1), lit);
  }

 private:
  using Cell = std::optional<std::size_t>;

  // Relative to the origin of the casters.
  [[nodiscard]] Cell cellAt(int x) const {
    const double depth = 1.0 / (surface_.nearness.at(x) * picture_.space().scale);
    return lists_.cellOf(picture_.space().eye + depth * rays_.through(x + 0.5, surface_.y + 0.5));
  }

  // As the light sees it a run is straight and a cell has no dents: with its ends in one cell, all of it is. Any other is halved.
  void lightPiece(const Stretch& pixels, const Cell& first, const Cell& last, std::uint8_t* lit) {
    if (first == last && first) return lightInCell(pixels, *first, lit);
    if (pixels.end - pixels.begin == 1) return;  // the light itself
    const int middle = pixels.begin + (pixels.end - pixels.begin) / 2;
    lightPiece({pixels.begin, middle}, first, cellAt(middle - 1), lit);
    lightPiece({middle, pixels.end}, cellAt(middle), last, lit);
  }

  void lightInCell(const Stretch& pixels, std::size_t cell, std::uint8_t* lit) {
    lit_.assign(1, pixels);
    for (const std::uint32_t triangle : lists_.of(cell)) {
      if (triangle == itself_) continue;
      const Stretch hull{lit_.front().begin, lit_.back().end};
      const Stretch dark = edges_.shadow(triangle, surface_, hull);
      if (!dark.empty()) cutOut(dark);
      if (lit_.empty()) return;
    }
    for (const Stretch& s : lit_) std::fill(lit + s.begin, lit + s.end, std::uint8_t{255});
  }

  void cutOut(const Stretch& dark) {
    rest_.clear();
    for (const Stretch& s : lit_) {
      const Stretch before = meet(s, {s.begin, dark.begin}), after = meet(s, {dark.end, s.end});
      if (!before.empty()) rest_.push_back(before);
      if (!after.empty()) rest_.push_back(after);
    }
    lit_.swap(rest_);
  }

  const ScanPicture& picture_;
  const scene::PixelRays& rays_;
  const raster::ProjectedEdges& edges_;
  const ShadowLists& lists_;
  raster::SurfaceRow surface_;
  std::uint32_t itself_ = shadow::kNoTriangle;
  std::vector<Stretch> lit_, rest_;  ///< from left to right
};

class ScanlineProjected final : public shadow::Technique {
 public:
  ScanlineProjected() : traits_(scanlineProjectedTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    picture_.emplace(std::move(geometry));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(picture_.has_value(), "shade() before prepare()");
    return picture_->shade(frame, [&](const scene::Light& light, shadow::FrameStats& stats, shadow::PhaseClock& clock) {
      return shadowsOf(frame.camera, light, stats, clock);
    });
  }

 private:
  Result<shadow::LightMask> shadowsOf(const scene::Camera& camera, const scene::Light& light, shadow::FrameStats& stats,
                                      shadow::PhaseClock& clock) const {
    const shadow::CasterSet& casters = picture_->geometry().casters;
    shadow::Silhouette counted;
    counted.light = scene::homogeneous(light, casters.origin);
    counted.side = shadow::findSides(casters, counted.light);
    const raster::PixelSpace& space = picture_->space();
    const raster::Corners corners{picture_->positions().mapped, space.map(counted.light)};
    const ShadowLists lists(casters, counted);
    clock.end("lists");
    const raster::ProjectedEdges edges(space, casters, counted.side, corners);
    const scene::PixelRays rays = scene::pixelRays(camera);
    auto mask = picture_->paint(light, [&](int, int, int) -> ScanPicture::RowShader {
      return [lighting = RunLighting(*picture_, rays, edges, lists)](int y, std::span<const Run> runs,
                                                                     std::uint8_t* lit) mutable {
        for (const Run& run : runs) lighting.light(run, y, lit);
      };
    });
    clock.end("shadows");
    stats.lights.push_back(
        {.method = traits_.name,
         .reason = fmt::format("edges projected onto faces; {} faces in the light's lists", lists.size())});
    return mask;
  }

  shadow::Traits traits_;
  std::optional<ScanPicture> picture_;
};

}  // namespace

shadow::Traits scanlineProjectedTraits() {
  shadow::Traits traits;
  traits.name = "scanline_projected";
  traits.summary =
      "Hidden surfaces by scan lines, with the edges of casters projected onto each face; on the processor.";
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeScanlineProjected() { return std::make_unique<ScanlineProjected>(); }

}  // namespace umbrage::techniques::detail
