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

// The lights of the steps with the sun up, and how to shade them for one choice of casters.
class Shader {
 public:
  Shader(const scene::Scene& scene, const scene::Camera& camera, const std::vector<ProfileStep>& steps,
         shadow::Technique& technique, const ProgressSink& progress, std::size_t choices)
      : camera_(camera), technique_(technique), progress_(progress) {
    for (const ProfileStep& step : steps)
      if (step.moment.sunIsUp()) lights_.push_back(sunLight(step.moment.sun, scene.up, scene.northOffset));
    total_ = std::max<std::size_t>(1, lights_.size()) * choices;
  }

  struct Masks {
    std::shared_ptr<const shadow::Geometry> geometry;
    shadow::SurfaceBuffer surface;
    std::vector<image::GreyImage> light;  // one per step with the sun up
  };

  Result<Masks> shade(const scene::Scene& casting, const std::string& what) {
    Masks masks;
    if (auto goOn = tell("preparing " + what); !goOn) return tl::unexpected(goOn.error());
    masks.geometry = shadow::makeGeometry(casting);
    if (auto ready = technique_.prepare(masks.geometry); !ready) return tl::unexpected(ready.error());
    for (std::size_t begin = 0; begin == 0 || begin < lights_.size(); begin += kLightsPerFrame) {
      if (auto goOn = tell(what); !goOn) return tl::unexpected(goOn.error());
      const auto some = std::span(lights_).subspan(begin, std::min(kLightsPerFrame, lights_.size() - begin));
      auto shading = technique_.shade({camera_, some});
      if (!shading) return tl::unexpected(shading.error());
      for (shadow::LightMask& mask : shading->masks) masks.light.push_back(std::move(mask.light));
      masks.surface = std::move(shading->surface);
      done_ += some.size();
    }
    UMBRAGE_CHECK(masks.light.size() == lights_.size(), "a technique gives one mask per light");
    return masks;
  }

 private:
  [[nodiscard]] Result<void> tell(const std::string& what) const {
    if (reportProgress(progress_, double(done_) / double(total_), what)) return {};
    return fail(ErrorCode::cancelled, "cancelled");
  }

  const scene::Camera& camera_;
  shadow::Technique& technique_;
  const ProgressSink& progress_;
  std::vector<scene::Light> lights_;
  std::size_t done_ = 0, total_ = 1;
};

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

// Hands the masks out to the steps with the sun up, in their order.
void give(std::vector<image::GreyImage> masks, std::vector<ProfileStep>& steps, const auto& place) {
  std::size_t next = 0;
  for (ProfileStep& step : steps)
    if (step.moment.sunIsUp()) place(step, std::move(masks[next++]));
}

// The masks of each part alone; one part alone is the same as all together.
Result<void> shadeParts(const scene::Scene& scene, Shader& shader, Profile& out) {
  if (out.parts.size() == 1)
    for (ProfileStep& step : out.steps)
      if (step.moment.sunIsUp()) step.parts.push_back(step.light);
  if (out.parts.size() < 2) return {};
  for (const ProfilePart& part : out.parts) {
    auto alone = shader.shade(scene::withCasters(scene, {part.pattern}), "shadows of " + part.pattern);
    if (!alone) return tl::unexpected(alone.error());
    give(std::move(alone->light), out.steps,
         [](ProfileStep& step, image::GreyImage mask) { step.parts.push_back(std::move(mask)); });
  }
  return {};
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

  Shader shader(scene, options.camera, out.steps, technique, progress, out.parts.size() > 1 ? 1 + out.parts.size() : 1);
  const auto chosen = options.casters.empty() ? scene : scene::withCasters(scene, options.casters);
  auto together = shader.shade(chosen, "shadows");
  if (!together) return tl::unexpected(together.error());
  out.geometry = std::move(together->geometry);
  out.surface = std::move(together->surface);
  give(std::move(together->light), out.steps,
       [](ProfileStep& step, image::GreyImage mask) { step.light = std::move(mask); });
  if (auto done = shadeParts(scene, shader, out); !done) return tl::unexpected(done.error());
  accumulate(out);
  static_cast<void>(reportProgress(progress, 1.0, "shadows"));
  return out;
}

}  // namespace umbrage::study
