#pragma once

#include <cstddef>

#include "umbrage/base/angle.hpp"
#include "umbrage/image/image.hpp"

namespace umbrage::report {

/// A colour by perceived lightness in [0, 1], chroma and hue; chroma is lowered until the colour fits into sRGB.
/// Source: Ottosson, a perceptual color space for image processing, 2020 (OKLCh).
[[nodiscard]] image::Rgb8 perceptual(double lightness, double chroma, Angle hue);

/// Morning (0) to evening (1): indigo, magenta, orange. Lightness only rises: the order survives without colour vision.
[[nodiscard]] image::Rgb8 timeColour(double t);

/// The colour of the i-th part; `t` as in timeColour shades it from dark to light.
[[nodiscard]] image::Rgb8 partColour(std::size_t part, double t = 0.5);

/// Time in shadow, none (0) to all (1): pale yellow to deep blue. Lightness only falls.
[[nodiscard]] image::Rgb8 heatColour(double t);

}  // namespace umbrage::report
