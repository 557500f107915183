#include <optional>

#include "umbrage/shadow/phase_clock.hpp"
#include "umbrage/techniques/cpu/detail/ray_traced.hpp"
#include "umbrage/techniques/cpu/detail/rays.hpp"

namespace umbrage::techniques::detail {
namespace {

class RayTraced final : public shadow::Technique {
 public:
  RayTraced() : traits_(rayTracedTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    auto built = Rays::build(geometry);
    if (!built) return tl::unexpected(built.error());
    rays_.emplace(std::move(*built));
    sight_.forget();
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(rays_.has_value(), "shade() before prepare()");
    shadow::Shading out;
    shadow::PhaseClock clock(out.stats.phases);
    out.stats.surfaceKept = sight_.isOf(frame.camera);
    if (auto done = sight_.see(*rays_, frame.camera); !done) return tl::unexpected(done.error());
    clock.end("surface");
    for (const scene::Light& light : frame.lights) {
      auto mask = rays_->mask(frame.camera, light, sight_.surface());
      if (!mask) return tl::unexpected(mask.error());
      out.masks.push_back(std::move(*mask));
      out.stats.lights.push_back({.method = "ray_traced", .reason = "one ray per lit-facing pixel towards the light"});
      clock.end("shadow");
    }
    if (frame.surfaceWanted) out.surface = sight_.surface();
    return out;
  }

 private:
  shadow::Traits traits_;
  std::optional<Rays> rays_;
  RaySight sight_;
};

}  // namespace

shadow::Traits rayTracedTraits() {
  shadow::Traits traits;
  traits.name = "ray_traced";
  traits.summary =
      "One ray from every visible surface point to the light (Embree): the truth all others are judged by.";
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeRayTraced() { return std::make_unique<RayTraced>(); }

}  // namespace umbrage::techniques::detail
