#include "umbrage/techniques/cpu/detail/hybrid_cpu.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "umbrage/techniques/cpu/detail/cpu_volumes.hpp"
#include "umbrage/techniques/cpu/detail/rays.hpp"

namespace umbrage::techniques::detail {
namespace {

// Milliseconds that two cores were measured to take (docs/techniques/hybrid_cpu.md). Only their ratios matter, and never a clock: the same
// scene must give the same picture every time, and at true edges the two ways may differ by a pixel.
namespace cost {
double rasterising(double triangles, double pixels) { return 2e-6 * pixels + 60e-6 * triangles; }
double primaryRays(double pixels) { return 22e-6 * pixels; }
double findingSides(double edges) { return 100e-6 * edges; }
double counting(double pieces) { return 80e-6 * pieces; }
double shadowRays(double receivers, double pixels) { return 15e-6 * receivers + 2.5e-6 * pixels; }
double tree(double triangles) { return 250e-6 * triangles; }
}  // namespace cost

// Chooses by what is known when it must be chosen: surfaces by the number of triangles, shadows by the number of silhouette edges, and
// once those are made into sides, by the pieces of sides that may hide something. The tree that rays need is built when
// what it would have saved so far has grown to its cost, so no sequence of frames takes more than about twice what it need have.
class HybridCpu final : public shadow::Technique {
 public:
  HybridCpu() : traits_(hybridCpuTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    geometry_ = std::move(geometry);
    rays_.reset();
    sight_.forget();
    missed_ = 0.0;
    volumes_ ? volumes_->use(geometry_) : void(volumes_.emplace(geometry_));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(volumes_.has_value(), "shade() before prepare()");
    shadow::Shading out;
    shadow::PhaseClock clock(out.stats.phases);
    const double pixels = double(frame.camera.width) * frame.camera.height;
    const auto triangles = double(geometry_->surfaces.triangles.size());
    const bool seen = volumes_->hasSeen(frame.camera);
    const double rasterisingTakes = seen ? 0.0 : cost::rasterising(triangles, pixels);
    const auto tracing = prefersRays(rasterisingTakes, cost::primaryRays(pixels));
    if (!tracing) return tl::unexpected(tracing.error());
    const bool rasterising = !*tracing;
    out.stats.surfaceKept = rasterising ? seen : sight_.isOf(frame.camera);
    if (auto done = rasterising ? volumes_->see(frame.camera) : sight_.see(*rays_, frame.camera); !done)
      return tl::unexpected(done.error());
    if (!rasterising || frame.surfaceWanted)
      if (auto done = addSurface(rasterising, out); !done) return tl::unexpected(done.error());
    clock.end("surface");
    for (const scene::Light& light : frame.lights) {
      out.stats.lights.emplace_back();
      auto mask = rasterising ? cheaper(frame, light, out, clock)
                              : traced(frame, light, out, "so are the surfaces, of so many triangles", clock);
      if (!mask) return tl::unexpected(mask.error());
      out.masks.push_back(std::move(*mask));
    }
    return out;
  }

 private:
  // Whether to trace rays for what takes so long with and without. Builds the tree for them when it is time.
  Result<bool> prefersRays(double without, double with) {
    if (with >= without) return false;
    if (rays_) return true;
    missed_ += without - with;
    if (missed_ < cost::tree(double(geometry_->surfaces.triangles.size()))) return false;
    auto built = Rays::build(geometry_);
    if (!built) return tl::unexpected(built.error());
    rays_.emplace(std::move(*built));
    return true;
  }

  Result<void> addSurface(bool rasterised, shadow::Shading& out) {
    if (!out.surface.triangle.empty()) return {};
    auto surface = rasterised ? volumes_->surface() : Result<shadow::SurfaceBuffer>(sight_.surface());
    if (!surface) return tl::unexpected(surface.error());
    out.surface = std::move(*surface);
    return {};
  }

  Result<shadow::LightMask> traced(const shadow::Frame& frame, const scene::Light& light, shadow::Shading& out,
                                   const std::string& why, shadow::PhaseClock& clock) {
    out.stats.lights.back().method = "ray_traced";
    out.stats.lights.back().reason = "a ray per lit-facing pixel towards the light: " + why;
    if (auto done = addSurface(true, out); !done) return tl::unexpected(done.error());
    auto mask = rays_->mask(frame.camera, light, out.surface);
    clock.end("shadow");
    return mask;
  }

  Result<shadow::LightMask> cheaper(const shadow::Frame& frame, const scene::Light& light, shadow::Shading& out,
                                    shadow::PhaseClock& clock) {
    if (auto done = volumes_->look(light, frame.silhouettes, clock); !done) return tl::unexpected(done.error());
    const double pixels = double(frame.camera.width) * frame.camera.height;
    const double rays = cost::shadowRays(double(volumes_->receiverCount()), pixels);
    const std::size_t edges = volumes_->silhouetteSize();
    const auto tooMany = prefersRays(0.5 * cost::findingSides(double(edges)), rays);
    if (!tooMany) return tl::unexpected(tooMany.error());
    if (*tooMany) return traced(frame, light, out, fmt::format("the silhouette has {} edges", edges), clock);
    const auto pieces = volumes_->plan(clock);
    if (!pieces) return tl::unexpected(pieces.error());
    const auto tooLarge = prefersRays(cost::counting(double(*pieces)), rays);
    if (!tooLarge) return tl::unexpected(tooLarge.error());
    if (*tooLarge)
      return traced(frame, light, out, fmt::format("the volumes' sides would be {} pieces to fill", *pieces), clock);
    auto mask = volumes_->mask(frame.camera, light, clock);
    out.stats.lights.back() = volumes_->stats(frame.detailed);
    return mask;
  }

  shadow::Traits traits_;
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::optional<CpuVolumes> volumes_;
  std::optional<Rays> rays_;
  RaySight sight_;       ///< by these rays
  double missed_ = 0.0;  ///< what rays would have saved so far
};

}  // namespace

shadow::Traits hybridCpuTraits() {
  shadow::Traits traits;
  traits.name = "hybrid_cpu";
  traits.summary =
      "Surfaces and shadows on the processor, each by what costs less there: rasterised, shadow volumes counted, or "
      "rays.";
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeHybridCpu() { return std::make_unique<HybridCpu>(); }

}  // namespace umbrage::techniques::detail
