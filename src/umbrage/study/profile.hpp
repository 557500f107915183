#pragma once

#include <memory>
#include <string>
#include <vector>

#include "umbrage/base/progress.hpp"
#include "umbrage/shadow/technique.hpp"
#include "umbrage/study/period.hpp"

namespace umbrage::study {

struct ProfileOptions {
  Period period;
  scene::Camera camera;
  /// Only the parts that match one of these patterns cast, each getting masks of its own (scene::matchesName); empty:
  /// all cast.
  std::vector<std::string> casters;
};

/// What the sun does to one view at one moment. Light as in shadow::LightMask::light.
struct ProfileStep {
  PeriodStep moment;
  image::GreyImage light;  ///< with all casters together; empty while the sun is down
  std::vector<image::GreyImage>
      parts;  ///< with the casters of each pattern alone; as many as Profile::parts, or empty at night
};

/// The casters that one pattern chose.
struct ProfilePart {
  std::string pattern;
  std::vector<std::uint32_t> instances;  ///< those it matches that no pattern before it did
};

/// One line of the conventions a figure rests on.
struct LedgerLine {
  std::string subject;
  std::string text;
};

/// The shadow profile of one view over a period.
/// 1. Where there is a surface: shadowMinutes + sunMinutes = the minutes of the period in which the sun is up, by the
/// steps'
///    shares; elsewhere both are 0.
/// 2. In shadow is what no direct sun reaches, be it a cast shadow or a face turned away.
struct Profile {
  scene::Camera camera;
  std::chrono::year_month_day date;
  std::shared_ptr<const shadow::Geometry> geometry;  ///< what was seen; which of it casts is said by the options
  shadow::SurfaceBuffer surface;
  std::vector<ProfileStep> steps;
  std::vector<ProfilePart> parts;
  image::Image<float> shadowMinutes;
  image::Image<float> sunMinutes;
  double sunUpMinutes = 0.0;
  std::vector<LedgerLine> ledger;
  std::vector<std::string> warnings;
};

/// Computes a profile with any technique; the sun of every step is one directional light.
/// Errors: usage (the period, a pattern that matches nothing, more masks than fit in memory), device, cancelled.
[[nodiscard]] Result<Profile> profile(const scene::Scene& scene, const ProfileOptions& options,
                                      shadow::Technique& technique, const ProgressSink& progress = {});

}  // namespace umbrage::study
