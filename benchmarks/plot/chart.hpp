#pragma once

#include <string>
#include <utility>
#include <vector>

namespace umbrage::benchmarks {

struct Axis {
  std::string label;
  bool logarithmic = false;
};

/// Curves through measured points; on logarithmic axes only positive coordinates are drawn.
struct LineChart {
  struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points;  ///< by x
  };
  std::string title, subtitle;
  Axis x, y;
  std::vector<Series> series;
};

/// Horizontal bars, a group for each thing measured and in it a bar for each series, with its value; NaN or a missing value: no bar.
struct BarChart {
  struct Series {
    std::string name;
    std::vector<double> values;  ///< one a group
  };
  std::string title, subtitle;
  Axis value;
  std::vector<std::string> groups;
  std::vector<Series> series;
};

/// Pictures for a page of results: text, white background, at most ten colours that colour-blind readers tell apart.
[[nodiscard]] std::string svg(const LineChart& chart);
[[nodiscard]] std::string svg(const BarChart& chart);

/// A number as short as three digits allow: "1200", "84.5", "0.31".
[[nodiscard]] std::string shortNumber(double value);

}  // namespace umbrage::benchmarks
