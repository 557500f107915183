#pragma once

#include <algorithm>
#include <cmath>

#include "umbrage/report/colours.hpp"
#include "umbrage/study/hours_table.hpp"

namespace umbrage::report::detail {

/// Hours of sun, none (0) to all (1): deep blue to pale yellow. Lightness only rises.
[[nodiscard]] inline image::Rgb8 hoursColour(double t) { return heatColour(1.0 - std::clamp(t, 0.0, 1.0)); }

/// A round number of hours between labels, some five of them.
[[nodiscard]] inline double tickStep(double most) {
  const double rough = std::max(most, 1e-3) / 6.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double f : {1.0, 2.0, 5.0})
    if (f * power >= rough) return f * power;
  return 10.0 * power;
}

/// The end of the scale: the most that is there, rounded up.
[[nodiscard]] inline double scaleTop(const study::HoursTable& table) {
  const double most = table.hours.empty() ? 1.0 : *std::max_element(table.hours.begin(), table.hours.end());
  const double step = tickStep(std::max(most, 0.1));
  return std::max(step, std::ceil(most / step - 1e-9) * step);
}

}  // namespace umbrage::report::detail
