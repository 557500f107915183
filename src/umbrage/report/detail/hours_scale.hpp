#pragma once

#include <algorithm>
#include <cmath>

#include "umbrage/report/colours.hpp"
#include "umbrage/study/hours_table.hpp"

namespace umbrage::report::detail {

/// Hours of sun, none (0) to all (1): deep blue to pale yellow. Lightness only rises.
[[nodiscard]] inline image::Rgb8 hoursColour(double t) { return heatColour(1.0 - std::clamp(t, 0.0, 1.0)); }

/// A scale from none to `top`, with a label each `step`; both are round, and the last label stands at the top.
struct HoursScale {
  double step = 0.2, top = 1.0;
};

/// The scale for hours up to `most`, four to nine steps long. It goes hardly further than it must: colours that nothing has would
/// tell less of those that are there.
[[nodiscard]] inline HoursScale scaleFor(double most) {
  if (most < 1e-3) return {};
  // Steps, the less handy ones only where they save more than so much of the scale.
  struct Step {
    double size, price;
  };
  constexpr Step kSteps[] = {{1, 0.0}, {2, 0.0}, {5, 0.0}, {2.5, 0.02}, {3, 0.02}, {4, 0.02}, {1.5, 0.04}};
  HoursScale best;
  double least = 1e9;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double p : {0.1 * power, power})
    for (const Step& s : kSteps) {
      const double step = s.size * p, steps = std::ceil(most / step - 1e-6);
      const double cost = steps * step / most + s.price;
      if (steps >= 4.0 && steps <= 9.0 && cost < least) least = cost, best = {step, steps * step};
    }
  return best;
}

[[nodiscard]] inline HoursScale scaleOf(const study::HoursTable& table) {
  return scaleFor(table.hours.empty() ? 0.0 : *std::max_element(table.hours.begin(), table.hours.end()));
}

}  // namespace umbrage::report::detail
