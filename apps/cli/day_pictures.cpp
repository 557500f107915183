#include "day_pictures.hpp"

#include <fmt/format.h>

#include "choice.hpp"
#include "options.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/report/step_pictures.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::cli {
namespace {

constexpr Size kSize{960, 540};
constexpr std::chrono::milliseconds kDelay{500};

// From where the whole scene is seen, as much nearer as `about`, with twice the scene's height around it, is smaller than the scene.
void approach(scene::Camera& camera, const scene::Scene& scene, const Box3& about) {
  const Box3 box = scene::bounds(scene);
  if (about.empty() || box.empty()) return;
  const double height = std::abs(glm::dot(box.size(), scene::upVector(scene.up)));
  const double nearer = (glm::length(about.size()) + 4.0 * height) / glm::length(box.size());
  if (nearer >= 1.0) return;
  const Vec3 back = nearer * (camera.eye - camera.target);
  camera.target = about.centre();
  camera.eye = camera.target + back;
}

Result<View> viewOf(const scene::Scene& scene, const Box3& about) {
  ViewOptions options;
  options.size = kSize;
  options.ground = Ground{};
  options.shadowRoom = 0.6;  // a day's shadows go to all sides
  auto view = makeView(scene, options);
  if (view) approach(view->camera, scene, about);
  return view;
}

}  // namespace

Result<DayPictures> picturesOf(const scene::Scene& scene, const Box3& about, const study::Period& period,
                               const Console& console) {
  const auto view = viewOf(scene, about);
  if (!view) return tl::unexpected(view.error());
  auto chosen = chooseTechnique("auto");
  if (!chosen) return tl::unexpected(chosen.error());
  const auto profile = study::profile(view->scene, {period, view->camera, {}}, *chosen->technique, console.progress());
  if (!profile) return tl::unexpected(profile.error());
  const report::StepPictures steps(view->scene, *profile);
  DayPictures day;
  for (std::size_t i = 0; i < profile->steps.size(); ++i) {
    const study::PeriodStep& moment = profile->steps[i].moment;
    if (!moment.sunIsUp()) continue;
    day.captions.push_back(fmt::format("{} {}, the sun {:.1f} degrees high at azimuth {:.1f}",
                                       sun::dateText(period.date), moment.label, moment.sun.elevation.degrees(),
                                       moment.sun.azimuth.degrees()));
    day.pictures.push_back(steps.picture(i));
  }
  return day;
}

report::Animation animationOf(const DayPictures& day) {
  report::Animation animation;
  animation.frames = day.pictures.size();
  animation.frame = [&day](std::size_t i) -> Result<image::RgbImage> { return day.pictures[i]; };
  animation.delay = kDelay;
  return animation;
}

Result<std::vector<report::PagePicture>> pagePictures(const DayPictures& day) {
  std::vector<report::PagePicture> list;
  for (std::size_t i = 0; i < day.pictures.size(); ++i) {
    auto png = png::encode(day.pictures[i]);
    if (!png) return tl::unexpected(png.error());
    list.push_back({day.captions[i], std::move(*png)});
  }
  return list;
}

}  // namespace umbrage::cli
