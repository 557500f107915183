#include "umbrage/techniques/cpu/detail/transparent_cpu.hpp"

#include <new>
#include <optional>

#include "umbrage/techniques/cpu/detail/tinted_volumes.hpp"

namespace umbrage::techniques::detail {
namespace {

class TransparentCpu final : public shadow::Technique {
 public:
  TransparentCpu() : traits_(transparentCpuTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    volumes_.emplace(std::move(geometry));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(volumes_.has_value(), "shade() before prepare()");
    try {
      return shadeAll(frame);
    } catch (const std::bad_alloc&) {
      return fail(ErrorCode::device,
                  "not enough memory for so many transparent surfaces behind each other; choose a smaller picture or "
                  "fewer --veil-layers");
    }
  }

 private:
  Result<shadow::Shading> shadeAll(const shadow::Frame& frame) {
    shadow::Shading out;
    shadow::PhaseClock clock(out.stats.phases);
    if (auto done = volumes_->see(frame.camera, frame.veilLayers, out.veils); !done)
      return tl::unexpected(done.error());
    auto surface = volumes_->surface();
    if (!surface) return tl::unexpected(surface.error());
    out.surface = std::move(*surface);
    clock.end("surface");
    for (const scene::Light& light : frame.lights) {
      auto mask = volumes_->mask(frame.camera, light, out.veils, clock);
      if (!mask) return tl::unexpected(mask.error());
      out.masks.push_back(std::move(*mask));
      out.stats.lights.push_back(volumes_->stats());
    }
    return out;
  }

  shadow::Traits traits_;
  std::optional<TintedVolumes> volumes_;
};

}  // namespace

shadow::Traits transparentCpuTraits() {
  shadow::Traits traits;
  traits.name = "transparent_cpu";
  traits.summary =
      "Coloured light through any number of transparent casters by shadow volumes, on the processor; self-shadows in "
      "every layer.";
  traits.tinted = true;
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeTransparentCpu() { return std::make_unique<TransparentCpu>(); }

}  // namespace umbrage::techniques::detail
