#include <chrono>

#include "bare_rays.hpp"
#include "contestant.hpp"
#include "median.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::benchmarks {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

scene::Light moved(scene::Light light, double shift) {
  if (auto* lamp = std::get_if<scene::PointLight>(&light.shape)) lamp->position.x += shift;
  return light;
}

class OwnFrame : public Contestant {
 public:
  OwnFrame(const Stage& stage, const Shot& shot, std::unique_ptr<shadow::Technique> technique, bool shaded)
      : stage_(stage), shot_(shot), technique_(std::move(technique)), shaded_(shaded) {}

  Result<double> frame(double shift) override {
    const scene::Light light = moved(shot_.light, shift);
    const auto start = Clock::now();
    auto shading = technique_->shade({shot_.camera, {&light, 1}});
    if (!shading) return tl::unexpected(shading.error());
    const double masked = millisecondsSince(start);
    if (shaded_) picture_ = composed(*shading, light);
    const double time = millisecondsSince(start);
    if (shaded_) phases_["shading"].push_back(time - masked);
    for (const shadow::PhaseTime& p : shading->stats.phases) phases_[p.name].push_back(p.milliseconds);
    last_ = std::move(*shading);
    return time;
  }

  std::map<std::string, double> phases() const override {
    std::map<std::string, double> medians;
    for (const auto& [name, times] : phases_) medians[name] = median(times);
    return medians;
  }

  Result<void> picture(const std::filesystem::path& path) override {
    return png::write(path, composed(last_, shot_.light));
  }

 private:
  [[nodiscard]] image::RgbImage composed(const shadow::Shading& shading, const scene::Light& light) const {
    return shadow::composite(stage_.staged.scene, stage_.geometry->surfaces, shot_.camera, shading.surface, {&light, 1},
                             shading.masks);
  }

  const Stage& stage_;
  Shot shot_;
  std::unique_ptr<shadow::Technique> technique_;
  bool shaded_;
  shadow::Shading last_;
  image::RgbImage picture_;
  std::map<std::string, std::vector<double>> phases_;
};

Result<std::unique_ptr<shadow::Technique>> prepared(const shadow::TechniqueEntry& entry, const Stage& stage) {
  auto technique = entry.create();
  if (!technique) return tl::unexpected(technique.error());
  if (auto done = (*technique)->prepare(stage.geometry); !done) return tl::unexpected(done.error());
  return technique;
}

class BareFrame : public Contestant {
 public:
  BareFrame(const View& view, shadow::SurfaceBuffer seen) : rays_(view), seen_(std::move(seen)) {}

  Result<double> frame(double) override {
    const auto start = Clock::now();
    const image::GreyImage mask = rays_.mask(seen_);
    return millisecondsSince(start);
  }

 private:
  BareRays rays_;
  shadow::SurfaceBuffer seen_;
};

}  // namespace

Entry techniqueEntry(const shadow::TechniqueEntry& technique, bool shaded) {
  return {technique.traits.name + (shaded ? "_picture" : ""),
          [technique, shaded](const Stage& stage, const Shot& shot) -> Result<std::unique_ptr<Contestant>> {
            auto made = prepared(technique, stage);
            if (!made) return tl::unexpected(made.error());
            return std::make_unique<OwnFrame>(stage, shot, std::move(*made), shaded);
          }};
}

Entry bareRaysEntry() {
  return {"bare_rays", [](const Stage& stage, const Shot& shot) -> Result<std::unique_ptr<Contestant>> {
            auto technique = prepared(techniques::cpuTechniques().front(), stage);
            if (!technique) return tl::unexpected(technique.error());
            auto shading = (*technique)->shade({shot.camera, {}});
            if (!shading) return tl::unexpected(shading.error());
            return std::make_unique<BareFrame>(View{shot.name, stage.geometry, shot.camera, shot.light},
                                               std::move(shading->surface));
          }};
}

}  // namespace umbrage::benchmarks
