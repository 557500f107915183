#pragma once

#include "umbrage/image/image.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::report {

/// The shadows of every step over the scene, each with a border in the colour of its time, a legend, the way of the sun and the
/// conventions. With parts, hue says whose shadow it is and lightness the time.
/// The view is the top left camera.width x camera.height pixels; the legend stands to its right.
/// REQUIRES: `scene` is the one the profile was made of.
[[nodiscard]] image::RgbImage shadowPicture(const scene::Scene& scene, const study::Profile& profile);

/// The hours in shadow as a heat map over the scene, with lines at round times, a scale, the way of the sun
/// and the conventions; laid out as shadowPicture.
[[nodiscard]] image::RgbImage hoursPicture(const scene::Scene& scene, const study::Profile& profile);

}  // namespace umbrage::report
