#include "umbrage/techniques/cpu/detail/scanline.hpp"

#include <optional>
#include <string>

#include "umbrage/raster/depth_count.hpp"
#include "umbrage/raster/sides.hpp"
#include "umbrage/techniques/cpu/detail/scan_picture.hpp"

namespace umbrage::techniques::detail {
namespace {

using raster::Patch;
using raster::Run;
using raster::Stretch;

class Scanline final : public shadow::Technique {
 public:
  Scanline() : traits_(scanlineTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    finder_.reset();
    geometry_ = geometry;
    picture_.emplace(std::move(geometry));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(picture_.has_value(), "shade() before prepare()");
    return picture_->shade(frame, [&](const scene::Light& light, shadow::FrameStats& stats, shadow::PhaseClock& clock) {
      return shadowsOf(light, frame.silhouettes, stats, clock);
    });
  }

 private:
  Result<shadow::LightMask> shadowsOf(const scene::Light& light, shadow::FinderKind finder, shadow::FrameStats& stats,
                                      shadow::PhaseClock& clock) {
    const shadow::CasterSet& casters = geometry_->casters;
    const shadow::Silhouette silhouette = silhouetteOf(scene::homogeneous(light, casters.origin), finder);
    clock.end("silhouette");
    const raster::PixelSpace& space = picture_->space();
    const raster::Corners corners{picture_->positions().mapped, space.map(silhouette.light)};
    if (auto done = makeSides(silhouette, corners); !done) return tl::unexpected(done.error());
    const int atEye = raster::countAtEye(casters, silhouette, space, corners);
    clock.end("sides");
    auto mask = picture_->paint(light, [&](int band, int first, int end) -> ScanPicture::RowShader {
      auto active = std::make_shared<raster::ActiveList>(corners, first, end, raster::ActiveList::Order::none);
      sides_.forEachIn(band, [&](const Patch& side, std::uint64_t) { active->add(side); });
      return [active, atEye, count = raster::DepthCount(space.width)](int y, std::span<const Run> runs,
                                                                      std::uint8_t* lit) mutable {
        active->moveTo(y);
        count.visit(runs, active->row(), y, atEye, [&](const Stretch& pixels, int surfaces) {
          if (surfaces == 0) std::fill(lit + pixels.begin, lit + pixels.end, std::uint8_t{255});
        });
      };
    });
    clock.end("volumes");
    stats.lights.push_back({.method = traits_.name,
                            .reason = "shadow polygons in the active list; " + std::to_string(atEye) +
                                      " surfaces between the eye and the light",
                            .edgesTested = silhouette.edgesTested,
                            .silhouetteEdges = silhouette.edges.size(),
                            .volumeTriangles = sides_.patchCount(),
                            .eyeCount = atEye,
                            .finder = std::string(silhouette.finder)});
    return mask;
  }

  shadow::Silhouette silhouetteOf(const Vec4& light, shadow::FinderKind kind) {
    if (kind == shadow::FinderKind::gpu) kind = shadow::FinderKind::automatic;  // there is none here
    if (finder_ == nullptr || finder_->kind() != kind)
      finder_ = shadow::makeFinder(kind, {geometry_, &geometry_->casters});
    return finder_->silhouette(light);
  }

  // The shadow polygons, and with them casters in whose plane the eye lies: the way from the eye crosses these, though nobody sees them.
  Result<void> makeSides(const shadow::Silhouette& silhouette, const raster::Corners& corners) {
    Box3 room = geometry_->surfaces.bounds;
    room.add(picture_->space().eye);
    const raster::SideMaker maker(picture_->space(), corners, geometry_->casters, silhouette.light, room);
    const std::vector<std::uint32_t>& invisible = picture_->invisible();
    const std::size_t edges = silhouette.edges.size();
    return sides_.fill(
        edges + invisible.size(), picture_->space().height,
        [&](std::size_t i, Patch& patch) {
          if (i < edges) return maker.side(silhouette.edges[i], patch);
          const std::uint32_t t = invisible[i - edges];
          return maker.cap(t, silhouette.side[t], patch);
        },
        [](const Patch&, int) { return ~std::uint64_t{0}; });
  }

  shadow::Traits traits_;
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::unique_ptr<shadow::SilhouetteFinder> finder_;
  std::optional<ScanPicture> picture_;
  raster::Bands sides_;
};

}  // namespace

shadow::Traits scanlineTraits() {
  shadow::Traits traits;
  traits.name = "scanline";
  traits.summary =
      "Hidden surfaces by scan lines with shadow polygons in the active list, as first proposed; on the processor.";
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeScanline() { return std::make_unique<Scanline>(); }

}  // namespace umbrage::techniques::detail
