#include "umbrage/report/step_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "umbrage/report/colours.hpp"
#include "umbrage/report/detail/canvas.hpp"
#include "umbrage/report/detail/layers.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::report {
namespace {

using detail::Canvas;

constexpr image::Rgb8 kInk{33, 37, 45};
constexpr image::Rgb8 kSoftInk{104, 110, 122};
constexpr image::Rgb8 kPaper{255, 255, 255};

constexpr double kAmbient = 0.3;
constexpr image::Rgb8 kSky{237, 242, 247};

// The shading of shadow::composite, which is the same all over a triangle under a sun: worked out once a triangle, and a frame
// costs a look-up a pixel.
class FlatShading {
 public:
  FlatShading(const scene::Scene& scene, const study::Profile& profile, const Vec3& towardsSun)
      : scene_(scene),
        surfaces_(profile.geometry->surfaces),
        eye_(profile.camera.eye - surfaces_.origin),
        sun_(towardsSun),
        shades_(surfaces_.triangles.size()) {}

  [[nodiscard]] image::Rgb8 at(std::uint32_t triangle, std::uint8_t light) {
    Shade& shade = shades_[triangle];
    if (!shade.known) shade = shadeOf(triangle);
    if (light == 0) return shade.dark;
    return light == 255 ? shade.lit : coded(shade.colour * (shade.sky + shade.sun * light / 255.0));
  }

 private:
  struct Shade {
    bool known = false;
    image::Rgb8 dark, lit;
    Vec3 colour{0.0};
    double sky = 0.0, sun = 0.0;
  };

  static image::Rgb8 coded(const Vec3& c) {
    return {shadow::encodeSrgb(c.x), shadow::encodeSrgb(c.y), shadow::encodeSrgb(c.z)};
  }

  [[nodiscard]] Shade shadeOf(std::uint32_t t) const {
    Vec3 n = glm::normalize(surfaces_.normal(t));
    if (glm::dot(n, surfaces_.corner(t, 0) - eye_) > 0.0) n = -n;
    Shade shade{.known = true, .colour = scene_.materials[surfaces_.materials[t]].colour};
    shade.sky = shadow::skyLight(kAmbient, n, scene::upVector(scene_.up));
    shade.sun = std::abs(glm::dot(n, sun_));
    shade.dark = coded(shade.colour * shade.sky);
    shade.lit = coded(shade.colour * (shade.sky + shade.sun));
    return shade;
  }

  const scene::Scene& scene_;
  const scene::Surfaces& surfaces_;
  Vec3 eye_, sun_;
  std::vector<Shade> shades_;
};

void drawClock(Canvas& canvas, const study::PeriodStep& moment, const std::string& date, double scale) {
  const detail::TextStyle large{24.0 * scale, true, kInk}, small{11.5 * scale, false, kSoftInk};
  const std::string sun =
      moment.sunIsUp() ? fmt::format("{}, sun {:.1f}\u00b0 high, {:.1f}\u00b0 {}", date, moment.sun.elevation.degrees(),
                                     moment.sun.azimuth.degrees(), sun::compassPoint(moment.sun.azimuth))
                       : date + ", sun below the horizon";
  const double width = std::max(canvas.textWidth(moment.label, large), canvas.textWidth(sun, small)) + 28.0 * scale;
  const double x = 16.0 * scale, y = 16.0 * scale;
  canvas.fillRect(x, y, width, 60.0 * scale, kPaper, 0.86, 8.0 * scale);
  canvas.text(x + 14.0 * scale, y + 29.0 * scale, moment.label, large);
  canvas.text(x + 14.0 * scale, y + 48.0 * scale, sun, small);
}

void drawProgress(Canvas& canvas, const study::Profile& profile, std::size_t step, double scale) {
  const double left = 16.0 * scale, width = canvas.width() - 2.0 * left, y = canvas.height() - 14.0 * scale;
  const auto at = [&](std::size_t i) {
    return left + width * (profile.steps.size() > 1 ? double(i) / double(profile.steps.size() - 1) : 0.5);
  };
  canvas.fillRect(left, y, width, 3.0 * scale, kPaper, 0.8, 1.5 * scale);
  for (std::size_t i = 0; i < profile.steps.size(); ++i)
    canvas.fillDisc({at(i), y + 1.5 * scale}, 2.0 * scale, kSoftInk, 0.6);
  canvas.fillDisc({at(step), y + 1.5 * scale}, 6.0 * scale, kPaper);
  canvas.fillDisc({at(step), y + 1.5 * scale}, 4.6 * scale, {222, 110, 30});
}

}  // namespace

StepPictures::StepPictures(const scene::Scene& scene, const study::Profile& profile)
    : scene_(scene), profile_(profile) {
  if (!profile.parts.empty()) model_ = detail::paleModel(scene, profile);
}

// The scene in its own colours under the sun of the step; without a sun, in the light of the sky.
image::RgbImage StepPictures::sunlit(const study::ProfileStep& step) const {
  FlatShading shading(scene_, profile_, study::towardsSun(step.moment.sun, scene_.up, scene_.northOffset));
  image::RgbImage picture(profile_.camera.width, profile_.camera.height, kSky);
  for (std::size_t i = 0; i < picture.size(); ++i)
    if (const std::uint32_t t = profile_.surface.triangle.pixels()[i]; t != shadow::kNoTriangle)
      picture.pixels()[i] = shading.at(t, step.light.empty() ? std::uint8_t{0} : step.light.pixels()[i]);
  return picture;
}

image::RgbImage StepPictures::partsAt(const study::ProfileStep& step) const {
  constexpr float kStrength = 0.62f;
  detail::Layer layer = model_;
  for (std::size_t p = 0; p < step.parts.size(); ++p)
    detail::stain(layer, detail::castShadow(profile_, step, step.parts[p], scene_), detail::toVec(partColour(p)),
                  kStrength);
  return detail::toRgb(layer);
}

image::RgbImage StepPictures::picture(std::size_t index) const {
  UMBRAGE_CHECK(index < profile_.steps.size(), "a step of the profile");
  const study::ProfileStep& step = profile_.steps[index];
  const double scale = std::clamp(profile_.camera.height / 720.0, 0.6, 3.0);
  Canvas canvas(profile_.camera.width, profile_.camera.height, kPaper);
  canvas.paste(profile_.parts.empty() ? sunlit(step) : partsAt(step), 0, 0);
  drawClock(canvas, step.moment, sun::dateText(profile_.date), scale);
  drawProgress(canvas, profile_, index, scale);
  return canvas.picture();
}

}  // namespace umbrage::report
