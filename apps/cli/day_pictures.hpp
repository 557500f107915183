#pragma once

#include "console.hpp"
#include "umbrage/report/gif.hpp"
#include "umbrage/report/study_page.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/period.hpp"

namespace umbrage::cli {

/// A day seen from the default camera, or from nearer to what it is about, for pages and as an animation.
struct DayPictures {
  std::vector<std::string> captions;
  std::vector<image::RgbImage> pictures;
};
/// The steps of a period in which the sun is up. `about`: what is to be seen, with its neighbourhood. Errors: those of study::profile.
[[nodiscard]] Result<DayPictures> picturesOf(const scene::Scene& scene, const Box3& about, const study::Period& period,
                                             const Console& console);

/// REQUIRES: there are pictures.
[[nodiscard]] report::Animation animationOf(const DayPictures& day);
[[nodiscard]] Result<std::vector<report::PagePicture>> pagePictures(const DayPictures& day);

}  // namespace umbrage::cli
