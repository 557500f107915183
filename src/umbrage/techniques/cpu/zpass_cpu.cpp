#include "umbrage/techniques/cpu/detail/zpass_cpu.hpp"

#include <optional>

#include "umbrage/techniques/cpu/detail/cpu_volumes.hpp"

namespace umbrage::techniques::detail {
namespace {

class ZPassCpu final : public shadow::Technique {
 public:
  ZPassCpu() : traits_(zpassCpuTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    volumes_ ? volumes_->use(std::move(geometry)) : void(volumes_.emplace(std::move(geometry)));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(volumes_.has_value(), "shade() before prepare()");
    shadow::Shading out;
    shadow::PhaseClock clock(out.stats.phases);
    out.stats.surfaceKept = volumes_->hasSeen(frame.camera);
    if (auto done = volumes_->see(frame.camera); !done) return tl::unexpected(done.error());
    if (frame.surfaceWanted) {
      auto surface = volumes_->surface();
      if (!surface) return tl::unexpected(surface.error());
      out.surface = std::move(*surface);
    }
    clock.end("surface");
    for (const scene::Light& light : frame.lights) {
      if (auto done = volumes_->look(light, frame.silhouettes, clock); !done) return tl::unexpected(done.error());
      if (auto work = volumes_->plan(clock); !work) return tl::unexpected(work.error());
      auto mask = volumes_->mask(frame.camera, light, clock);
      if (!mask) return tl::unexpected(mask.error());
      out.masks.push_back(std::move(*mask));
      out.stats.lights.push_back(volumes_->stats(frame.detailed));
    }
    return out;
  }

 private:
  shadow::Traits traits_;
  std::optional<CpuVolumes> volumes_;
};

}  // namespace

shadow::Traits zpassCpuTraits() {
  shadow::Traits traits;
  traits.name = "zpass_cpu";
  traits.summary = "Shadow volumes by z-pass, rasterised on the processor in blocks of pixels; exact for every eye.";
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeZPassCpu() { return std::make_unique<ZPassCpu>(); }

}  // namespace umbrage::techniques::detail
