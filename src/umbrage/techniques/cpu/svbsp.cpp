#include "umbrage/techniques/cpu/detail/svbsp.hpp"

#include <atomic>
#include <list>
#include <optional>

#include <fmt/format.h>

#include "umbrage/cut/light_cutter.hpp"
#include "umbrage/parallel/for_each.hpp"
#include "umbrage/shadow/phase_clock.hpp"
#include "umbrage/techniques/cpu/detail/rays.hpp"
#include "umbrage/trace/visible_surfaces.hpp"

namespace umbrage::techniques::detail {
namespace {

// Trees are kept for the next pictures while they have no more nodes than that together (40 bytes each), of so many lights.
constexpr std::size_t kNodesKept = std::size_t{1} << 22, kLightsKept = 16;

/// The faces of a scene under one light, cut as they are asked for.
class LitFaces {
 public:
  LitFaces(const std::shared_ptr<const shadow::Geometry>& geometry, const scene::Light& light)
      : towards_(scene::homogeneous(light, geometry->surfaces.origin)),
        cutter_(geometry, light, cut::ConeSides::none),
        cuts_(geometry->surfaces.triangles.size()) {}

  [[nodiscard]] const Vec4& towards() const { return towards_; }
  [[nodiscard]] std::size_t nodes() const { return nodes_; }

  // Cuts the faces in `triangles`, each named once, that are not yet.
  Result<void> cut(const std::vector<std::uint32_t>& triangles) {
    std::vector<std::uint32_t> missing;
    for (const std::uint32_t t : triangles)
      if (!cuts_[t]) missing.push_back(t);
    cut::Effort effort(cut::Effort::usual(cuts_.size()));
    std::atomic<bool> spent = false;
    const auto done = parallel::forEach(static_cast<int>(missing.size()), [&](int i) {
      const std::uint32_t t = missing[static_cast<std::size_t>(i)];
      if (spent) return;
      if (auto cut = cutter_.cut(t, effort))
        cuts_[t] = std::make_unique<cut::FaceCut>(std::move(*cut));
      else
        spent = true;
    });
    if (!done) return tl::unexpected(done.error());
    if (spent) return fail(ErrorCode::input, "svbsp: the shadows cross too often to be cut out of the surfaces");
    for (const std::uint32_t t : missing) nodes_ += cuts_[t]->nodes().size();
    return {};
  }

  // REQUIRES: their faces were cut.
  void hidden(std::span<const trace::SurfacePoints8> points, std::span<std::uint32_t> hidden) const {
    for (std::size_t i = 0; i < points.size(); ++i)
      hidden[i] = trace::lanesWhere([&](std::size_t k) {
        return trace::hasLane(points[i].active, k) && !cuts_[points[i].triangle[k]]->isLit(points[i].position[k]);
      });
  }

 private:
  Vec4 towards_;
  cut::LightCutter cutter_;
  std::vector<std::unique_ptr<const cut::FaceCut>> cuts_;
  std::size_t nodes_ = 0;
};

class Svbsp final : public shadow::Technique {
 public:
  Svbsp() : traits_(svbspTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    kept_.clear();
    geometry_ = std::move(geometry);
    auto built = Rays::build(geometry_);
    if (!built) return tl::unexpected(built.error());
    rays_.emplace(std::move(*built));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(rays_.has_value(), "shade() before prepare()");
    shadow::Shading out;
    shadow::PhaseClock clock(out.stats.phases);
    auto seen = trace::visibleSurfaces(rays_->occlusion(), frame.camera);
    if (!seen) return tl::unexpected(seen.error());
    out.surface = std::move(*seen);
    const std::vector<std::uint32_t> triangles = trianglesOf(out.surface);
    clock.end("surface");
    for (const scene::Light& light : frame.lights) {
      LitFaces& faces = facesUnder(light);
      if (const auto done = faces.cut(triangles); !done) return tl::unexpected(done.error());
      clock.end("cut");
      auto mask = rays_->mask(frame.camera, light, out.surface,
                              [&](auto points, auto hidden) { faces.hidden(points, hidden); });
      if (!mask) return tl::unexpected(mask.error());
      out.masks.push_back(std::move(*mask));
      out.stats.lights.push_back(
          {.method = "svbsp",
           .reason = fmt::format("{} faces seen, cut by trees of {} planes in all", triangles.size(), faces.nodes())});
      clock.end("shadow");
    }
    return out;
  }

 private:
  std::vector<std::uint32_t> trianglesOf(const shadow::SurfaceBuffer& seen) const {
    std::vector<std::uint8_t> is(geometry_->surfaces.triangles.size(), 0);
    std::vector<std::uint32_t> triangles;
    for (int y = 0; y < seen.triangle.height(); ++y)
      for (int x = 0; x < seen.triangle.width(); ++x) {
        const std::uint32_t t = seen.triangle(x, y);
        if (t == shadow::kNoTriangle || is[t] != 0) continue;
        is[t] = 1;
        triangles.push_back(t);
      }
    return triangles;
  }

  // Those of a picture before where there are such.
  LitFaces& facesUnder(const scene::Light& light) {
    const Vec4 towards = scene::homogeneous(light, geometry_->surfaces.origin);
    for (auto it = kept_.begin(); it != kept_.end(); ++it) {
      if (it->towards() != towards) continue;
      kept_.splice(kept_.begin(), kept_, it);
      return kept_.front();
    }
    std::size_t nodes = 0;
    for (const LitFaces& faces : kept_) nodes += faces.nodes();
    while (!kept_.empty() && (kept_.size() >= kLightsKept || nodes > kNodesKept)) {
      nodes -= kept_.back().nodes();
      kept_.pop_back();
    }
    return kept_.emplace_front(geometry_, light);
  }

  shadow::Traits traits_;
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::optional<Rays> rays_;
  std::list<LitFaces> kept_;  ///< the last used first
};

}  // namespace

shadow::Traits svbspTraits() {
  shadow::Traits traits;
  traits.name = "svbsp";
  traits.summary =
      "Surfaces cut into lit and shadowed polygons by shadow-volume BSP trees, on the processor; sharp at any size.";
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeSvbsp() { return std::make_unique<Svbsp>(); }

}  // namespace umbrage::techniques::detail
