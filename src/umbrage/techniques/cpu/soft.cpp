#include "umbrage/techniques/cpu/detail/soft.hpp"

#include <algorithm>

#include "umbrage/shadow/phase_clock.hpp"
#include "umbrage/techniques/cpu/detail/soft_mean.hpp"

namespace umbrage::techniques::detail {
namespace {

constexpr std::size_t kPart = 16;  ///< samples that are shaded together, so that the surfaces are drawn once for them

shadow::Traits traitsOf(const SoftParts& parts) {
  shadow::Traits traits;
  traits.name = parts.name;
  traits.summary = parts.summary;
  traits.soft = true;
  traits.tinted = true;
  return traits;
}

class Soft final : public shadow::Technique {
 public:
  explicit Soft(SoftParts parts) : parts_(std::move(parts)), traits_(traitsOf(parts_)) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    auto made = geometry->filters.empty() ? parts_.opaque() : parts_.tinted();
    if (!made) return tl::unexpected(made.error());
    hard_ = std::move(*made);
    const scene::Surfaces& surfaces = geometry->surfaces;
    room_ = surfaces.bounds;
    if (!room_.empty()) room_.min += surfaces.origin, room_.max += surfaces.origin;
    return hard_->prepare(std::move(geometry));
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(hard_ != nullptr, "shade() before prepare()");
    shadow::Frame bare = frame;
    bare.lights = {};
    auto out = hard_->shade(bare);
    if (!out) return out;
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
      if (auto done = addLight(frame, i, *out); !done) return tl::unexpected(done.error());
    return out;
  }

 private:
  [[nodiscard]] Result<void> addLight(const shadow::Frame& frame, std::size_t number, shadow::Shading& out);

  SoftParts parts_;
  shadow::Traits traits_;
  std::unique_ptr<shadow::Technique> hard_;
  Box3 room_;  ///< that holds all surfaces, in the world
};

void addTimes(const std::vector<shadow::PhaseTime>& times, std::vector<shadow::PhaseTime>& sum) {
  for (const shadow::PhaseTime& time : times) {
    const auto known = std::ranges::find(sum, time.name, &shadow::PhaseTime::name);
    if (known != sum.end())
      known->milliseconds += time.milliseconds;
    else
      sum.push_back(time);
  }
}

Result<void> Soft::addLight(const shadow::Frame& frame, std::size_t number, shadow::Shading& out) {
  const scene::Light& light = frame.lights[number];
  const bool isArea = scene::isArea(light);
  const std::size_t most = isArea ? std::max<std::size_t>(1, frame.soft.samples) : 1;
  SoftMean mean(frame.camera, out);
  shadow::LightStats stats;
  for (std::size_t taken = 0; taken < most;) {
    const auto samples = shadow::lightSamples(light, taken, std::min(kPart, most - taken), room_);
    std::vector<scene::Light> lights;
    for (const auto& sample : samples) lights.push_back(sample.light);
    shadow::Frame part = frame;
    part.lights = lights;
    auto shading = hard_->shade(part);
    if (!shading) return tl::unexpected(shading.error());
    addTimes(shading->stats.phases, out.stats.phases);
    if (taken == 0) stats = shading->stats.lights.front();
    if (!isArea) {
      out.masks.push_back(std::move(shading->masks.front()));
      out.stats.lights.push_back(std::move(stats));
      return {};
    }
    shadow::PhaseClock clock(out.stats.phases);
    if (auto done = mean.add(samples, shading->masks); !done) return done;
    clock.end("mean");
    taken += samples.size();
    const double error = mean.error();
    const bool goOn = !frame.soft.progress || frame.soft.progress({number, taken, error});
    if (!goOn || (taken >= 2 * kPart && error <= frame.soft.enough)) break;
  }
  out.masks.push_back(mean.mask());
  stats.reason = "the mean of " + std::to_string(mean.samples()) + " points of the light; each: " + stats.reason;
  stats.soft = mean.stats();
  out.stats.lights.push_back(std::move(stats));
  return {};
}

}  // namespace

shadow::TechniqueEntry softTechnique(SoftParts parts) {
  return {traitsOf(parts),
          [parts]() -> Result<std::unique_ptr<shadow::Technique>> { return std::make_unique<Soft>(parts); }};
}

}  // namespace umbrage::techniques::detail
