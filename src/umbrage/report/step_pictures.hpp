#pragma once

#include "umbrage/image/image.hpp"
#include "umbrage/math/vec.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::report {

/// The steps one by one, as the sun lights the scene (with parts: their shadows on the pale model), with the time and the sun's
/// position written on them; as large as the view.
class StepPictures {
 public:
  /// REQUIRES: `scene` is the one the profile was made of; both outlive this.
  StepPictures(const scene::Scene& scene, const study::Profile& profile);
  /// REQUIRES: step < profile.steps.size().
  [[nodiscard]] image::RgbImage picture(std::size_t step) const;

 private:
  [[nodiscard]] image::RgbImage sunlit(const study::ProfileStep& step) const;
  [[nodiscard]] image::RgbImage partsAt(const study::ProfileStep& step) const;

  const scene::Scene& scene_;
  const study::Profile& profile_;
  image::Image<Vec3f> model_;  // for profiles with parts
};

}  // namespace umbrage::report
