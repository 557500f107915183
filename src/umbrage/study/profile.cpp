#include "umbrage/study/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "umbrage/base/check.hpp"
#include "umbrage/study/ledger.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::study {
namespace {

// Lights of one frame: the fewer, the finer the progress; the more, the fewer times the view itself is traced.
constexpr std::size_t kLightsPerFrame = 8;
constexpr double kMostMaskBytes = 1024.0 * 1024.0 * 1024.0;

std::string someNames(const scene::Scene& scene) {
  constexpr std::size_t kShown = 8;
  std::set<std::string> names;
  for (const scene::Instance& instance : scene.instances)
    if (instance.casts) names.insert(instance.name.substr(0, instance.name.find('/')));
  std::string text;
  std::size_t shown = 0;
  for (const std::string& name : names) {
    if (shown++ == kShown) return text + ", ...";
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

Result<std::vector<ProfilePart>> findParts(const scene::Scene& scene, const std::vector<std::string>& patterns) {
  std::vector<ProfilePart> parts;
  std::vector<bool> taken(scene.instances.size(), false);
  for (const std::string& pattern : patterns) {
    ProfilePart part{pattern, {}};
    bool matched = false;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
      if (!scene.instances[i].casts || !scene::matchesName(scene.instances[i].name, pattern)) continue;
      matched = true;
      if (!taken[i]) part.instances.push_back(i);
      taken[i] = true;
    }
    if (!matched)
      return fail(ErrorCode::usage, fmt::format("no caster is called '{}'; there are: {}", pattern, someNames(scene)),
                  scene.source);
    parts.push_back(std::move(part));
  }
  return parts;
}

Result<void> checkMemory(const ProfileOptions& options, std::size_t steps) {
  const double bytes =
      double(options.camera.width) * options.camera.height * double(steps) * double(1 + options.casters.size());
  if (bytes <= kMostMaskBytes) return {};
  return fail(ErrorCode::usage,
              fmt::format("{} steps of {} parts at {} x {} pixels need {:.1f} GiB of masks; ask for fewer steps "
                          "or a smaller picture",
                          steps, 1 + options.casters.size(), options.camera.width, options.camera.height,
                          bytes / kMostMaskBytes));
}

// What is left to do, so that progress runs evenly over all parts.
struct Work {
  const ProgressSink& sink;
  double done = 0.0, total = 1.0;

  [[nodiscard]] Result<void> report(std::string_view what) const {
    if (reportProgress(sink, std::min(1.0, done / total), what)) return {};
    return fail(ErrorCode::cancelled, "cancelled");
  }
};

// The masks of all steps with the sun up, for one choice of casters.
struct StepMasks {
  shadow::SurfaceBuffer surface;
  std::vector<image::GreyImage> light;  ///< in the order of the lights
};

Result<StepMasks> shadeAll(shadow::Technique& technique, const scene::Camera& camera,
                           std::span<const scene::Light> lights, const std::string& what, Work& work) {
  StepMasks masks;
  for (std::size_t begin = 0; begin == 0 || begin < lights.size(); begin += kLightsPerFrame) {
    if (auto goOn = work.report(what); !goOn) return tl::unexpected(goOn.error());
    const auto some = lights.subspan(begin, std::min(kLightsPerFrame, lights.size() - begin));
    auto shading = technique.shade({camera, some});
    if (!shading) return tl::unexpected(shading.error());
    for (shadow::LightMask& mask : shading->masks) masks.light.push_back(std::move(mask.light));
    masks.surface = std::move(shading->surface);
    work.done += double(some.size());
  }
  UMBRAGE_CHECK(masks.light.size() == lights.size(), "a technique gives one mask per light");
  return masks;
}

void addTime(const image::GreyImage& light, const shadow::SurfaceBuffer& surface, double minutes, Profile& out) {
  const auto from = light.pixels();
  const auto seen = surface.triangle.pixels();
  const auto sun = out.sunMinutes.pixels(), shade = out.shadowMinutes.pixels();
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (seen[i] == shadow::kNoTriangle) continue;
    const double lit = double(from[i]) / 255.0;
    sun[i] += static_cast<float>(minutes * lit);
    shade[i] += static_cast<float>(minutes * (1.0 - lit));
  }
}

void accumulate(Profile& profile) {
  profile.sunMinutes = image::Image<float>(profile.camera.width, profile.camera.height, 0.0f);
  profile.shadowMinutes = profile.sunMinutes;
  for (const ProfileStep& step : profile.steps) {
    if (!step.moment.sunIsUp()) continue;
    const double minutes = double(step.moment.share.count()) / 60e3;
    profile.sunUpMinutes += minutes;
    addTime(step.light, profile.surface, minutes, profile);
  }
}

std::vector<scene::Light> sunLights(const scene::Scene& scene, const std::vector<ProfileStep>& steps) {
  std::vector<scene::Light> lights;
  for (const ProfileStep& step : steps)
    if (step.moment.sunIsUp()) lights.push_back(sunLight(step.moment.sun, scene.up, scene.northOffset));
  return lights;
}

}  // namespace

Result<Profile> profile(const scene::Scene& scene, const ProfileOptions& options, shadow::Technique& technique,
                        const ProgressSink& progress) {
  auto moments = stepsOf(options.period);
  if (!moments) return tl::unexpected(moments.error());
  auto parts = findParts(scene, options.casters);
  if (!parts) return tl::unexpected(parts.error());
  if (auto fits = checkMemory(options, moments->steps.size()); !fits) return tl::unexpected(fits.error());

  Profile out;
  out.camera = options.camera;
  out.date = options.period.date;
  out.parts = std::move(*parts);
  out.warnings = std::move(moments->warnings);
  out.ledger = ledgerOf(scene, options, *moments, technique.traits());
  for (PeriodStep& moment : moments->steps) out.steps.push_back({std::move(moment), {}, {}});

  const auto lights = sunLights(scene, out.steps);
  // Alone is the same as together where there is one part only.
  const std::size_t alone = out.parts.size() > 1 ? out.parts.size() : 0;
  Work work{progress, 0.0, double(std::max<std::size_t>(1, lights.size()) * (1 + alone))};
  const auto shade = [&](const scene::Scene& casting, const std::string& what) -> Result<StepMasks> {
    if (auto goOn = work.report("preparing " + what); !goOn) return tl::unexpected(goOn.error());
    auto geometry = shadow::makeGeometry(casting);
    if (auto ready = technique.prepare(geometry); !ready) return tl::unexpected(ready.error());
    if (!out.geometry) out.geometry = std::move(geometry);
    return shadeAll(technique, options.camera, lights, what, work);
  };

  auto together = shade(options.casters.empty() ? scene : scene::withCasters(scene, options.casters), "shadows");
  if (!together) return tl::unexpected(together.error());
  out.surface = std::move(together->surface);
  std::size_t light = 0;
  for (ProfileStep& step : out.steps)
    if (step.moment.sunIsUp()) step.light = std::move(together->light[light++]);

  for (const ProfilePart& part : out.parts) {
    auto masks = alone > 0 ? shade(scene::withCasters(scene, {part.pattern}), "shadows of " + part.pattern)
                           : Result<StepMasks>();
    if (!masks) return tl::unexpected(masks.error());
    light = 0;
    for (ProfileStep& step : out.steps)
      if (step.moment.sunIsUp()) step.parts.push_back(alone > 0 ? std::move(masks->light[light++]) : step.light);
  }
  accumulate(out);
  static_cast<void>(reportProgress(progress, 1.0, "shadows"));
  return out;
}

}  // namespace umbrage::study
