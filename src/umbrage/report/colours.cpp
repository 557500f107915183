#include "umbrage/report/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "umbrage/math/vec.hpp"
#include "umbrage/shadow/composite.hpp"

namespace umbrage::report {
namespace {

Vec3 linearRgb(double lightness, double chroma, Angle hue) {
  const double a = chroma * cos(hue), b = chroma * sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool fits(const Vec3& c) { return std::min({c.x, c.y, c.z}) >= -1e-4 && std::max({c.x, c.y, c.z}) <= 1.0 + 1e-4; }

double mix(double a, double b, double t) { return a + (b - a) * std::clamp(t, 0.0, 1.0); }

}  // namespace

image::Rgb8 perceptual(double lightness, double chroma, Angle hue) {
  double low = 0.0, high = chroma;
  if (!fits(linearRgb(lightness, chroma, hue)))
    for (int i = 0; i < 24; ++i)
      (fits(linearRgb(lightness, 0.5 * (low + high), hue)) ? low : high) = 0.5 * (low + high);
  else
    low = chroma;
  const Vec3 c = linearRgb(lightness, low, hue);
  return {shadow::encodeSrgb(c.x), shadow::encodeSrgb(c.y), shadow::encodeSrgb(c.z)};
}

image::Rgb8 timeColour(double t) {
  return perceptual(mix(0.36, 0.76, t), mix(0.20, 0.17, t), Angle::degrees(mix(272.0, 430.0, t)));
}

image::Rgb8 partColour(std::size_t part, double t) {
  // Hues as far apart as eight can be, the most different first.
  static constexpr std::array<double, 8> kHues{55, 255, 145, 350, 195, 100, 300, 20};
  return perceptual(mix(0.42, 0.76, t), 0.16, Angle::degrees(kHues[part % kHues.size()]));
}

image::Rgb8 heatColour(double t) {
  return perceptual(mix(0.965, 0.30, t), mix(0.055, 0.13, std::min(1.0, 2.0 * t)),
                    Angle::degrees(mix(105.0, -80.0, t)));
}

}  // namespace umbrage::report
