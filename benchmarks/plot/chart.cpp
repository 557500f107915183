#include "plot/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace umbrage::benchmarks {
namespace {

// Okabe and Ito's palette, then two greys and two browns. Source: Okabe and Ito, Color Universal Design, 2008.
constexpr const char* kColours[] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00",
                                    "#b8a800", "#000000", "#777777", "#bbbbbb", "#8c5a2b", "#d9b38c"};
constexpr double kWidth = 860, kRight = 30, kLineHeight = 20;

const char* colour(std::size_t series) { return kColours[series % std::size(kColours)]; }

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

std::string text(double x, double y, const std::string& anchor, const std::string& what, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     escaped(what));
}

std::string line(double x1, double y1, double x2, double y2, const char* stroke) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2,
                     stroke);
}

std::string tickText(double value) { return value >= 1e6 ? shortNumber(value) : fmt::format("{:g}", value); }

// Values onto pixels, with round ticks.
class Ruler {
 public:
  Ruler(const Axis& axis, double min, double max, double from, double to)
      : logarithmic_(axis.logarithmic), from_(from), to_(to) {
    if (logarithmic_) {
      low_ = std::floor(std::log10(min)), high_ = std::max(low_ + 1, std::ceil(std::log10(max)));
    } else {
      const double raw = std::max(max, 1e-12) / 6, power = std::pow(10, std::floor(std::log10(raw)));
      step_ = power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1);
      high_ = step_ * std::ceil(max / step_);
    }
  }
  [[nodiscard]] double at(double value) const {
    const double v = logarithmic_ ? std::log10(value) : value;
    return from_ + (to_ - from_) * (v - low_) / (high_ - low_);
  }
  [[nodiscard]] bool holds(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
  [[nodiscard]] std::vector<double> ticks() const {
    std::vector<double> all;
    if (logarithmic_)
      for (double e = low_; e <= high_ + 0.5; e += 1) all.push_back(std::pow(10, e));
    else
      for (double v = 0; v <= high_ + step_ / 2; v += step_) all.push_back(v);
    return all;
  }

 private:
  bool logarithmic_;
  double from_, to_, low_ = 0, high_ = 1, step_ = 1;
};

struct Range {
  double min = std::numeric_limits<double>::infinity(), max = 0;
  void add(double v) {
    if (!std::isfinite(v)) return;
    if (v > 0) min = std::min(min, v);
    max = std::max(max, v);
  }
  [[nodiscard]] Ruler ruler(const Axis& axis, double from, double to) const {
    const bool empty = max <= 0;
    return Ruler(axis, empty ? 0.1 : min, empty ? 1 : max, from, to);
  }
};

std::string frame(double height, const std::string& title, const std::string& subtitle, const std::string& content) {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
             "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222222\">\n"
             "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
             kWidth, height) +
         text(20, 28, "start", title, " font-size=\"17\" font-weight=\"bold\"") +
         text(20, 48, "start", subtitle, " fill=\"#666666\"") + content + "</svg>\n";
}

// Coloured squares with names, row by row; the height they take is added to `y`.
std::string legend(const std::vector<std::string>& names, double& y) {
  std::string out;
  double x = 20;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double width = 30 + 8.2 * double(names[i].size());
    if (x + width > kWidth - kRight) x = 20, y += kLineHeight;
    out +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"12\" height=\"12\" fill=\"{}\"/>\n", x, y - 11, colour(i));
    out += text(x + 17, y, "start", names[i]);
    x += width;
  }
  y += kLineHeight;
  return out;
}

template <class Series>
std::vector<std::string> names(const std::vector<Series>& series) {
  std::vector<std::string> all;
  for (const Series& s : series) all.push_back(s.name);
  return all;
}

std::string curve(const LineChart::Series& series, const Ruler& x, const Ruler& y, const char* stroke) {
  std::string path, dots;
  for (const auto& [u, v] : series.points) {
    if (!x.holds(u) || !y.holds(v)) continue;
    path += fmt::format("{}{:.1f},{:.1f} ", path.empty() ? "M" : "L", x.at(u), y.at(v));
    dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x.at(u), y.at(v), stroke);
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path, stroke) + dots;
}

}  // namespace

std::string shortNumber(double value) {
  const double size = std::abs(value);
  if (size >= 1e6) return fmt::format("{:.3g}M", value / 1e6);
  if (size >= 99.95 || value == 0) return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}f}", value, size >= 9.995 ? 1 : size >= 0.095 ? 2 : size >= 0.0095 ? 3 : 4);
}

std::string svg(const LineChart& chart) {
  Range u, v;
  for (const auto& series : chart.series)
    for (const auto& [x, y] : series.points) u.add(x), v.add(y);
  double top = 76;
  std::string out = legend(names(chart.series), top);
  const double left = 80, bottom = top + 400, right = kWidth - kRight;
  const Ruler x = u.ruler(chart.x, left, right), y = v.ruler(chart.y, bottom, top);
  for (double tick : x.ticks())
    out +=
        line(x.at(tick), top, x.at(tick), bottom, "#dddddd") + text(x.at(tick), bottom + 18, "middle", tickText(tick));
  for (double tick : y.ticks())
    out += line(left, y.at(tick), right, y.at(tick), "#dddddd") + text(left - 8, y.at(tick) + 4, "end", tickText(tick));
  for (std::size_t i = 0; i < chart.series.size(); ++i) out += curve(chart.series[i], x, y, colour(i));
  out += text((left + right) / 2, bottom + 42, "middle", chart.x.label);
  out += text(0, 0, "middle", chart.y.label,
              fmt::format(" transform=\"translate(22 {:.1f}) rotate(-90)\"", (top + bottom) / 2));
  return frame(bottom + 60, chart.title, chart.subtitle, out);
}

std::string svg(const BarChart& chart) {
  constexpr double kBar = 16, kGap = 14;
  Range range;
  std::size_t longest = 0;
  for (const auto& series : chart.series)
    for (double v : series.values) range.add(v);
  for (const auto& group : chart.groups) longest = std::max(longest, group.size());
  double top = 76;
  std::string out = legend(names(chart.series), top);
  const double left = 30 + 8.2 * double(longest);
  const Ruler ruler = range.ruler(chart.value, left, kWidth - kRight - 50);
  const double bottom = top + double(chart.groups.size()) * (kBar * double(chart.series.size()) + kGap);
  for (double tick : ruler.ticks())
    out += line(ruler.at(tick), top, ruler.at(tick), bottom, "#dddddd") +
           text(ruler.at(tick), bottom + 18, "middle", tickText(tick));
  double y = top + kGap / 2;
  for (std::size_t g = 0; g < chart.groups.size(); ++g) {
    out += text(left - 8, y + kBar * double(chart.series.size()) / 2 + 4, "end", chart.groups[g]);
    for (std::size_t s = 0; s < chart.series.size(); ++s, y += kBar) {
      const auto& values = chart.series[s].values;
      if (g >= values.size() || !ruler.holds(values[g])) continue;
      const double end = ruler.at(values[g]);
      out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", left,
                         y + 1, std::max(0.0, end - left), kBar - 2, colour(s));
      out += text(end + 5, y + 12, "start", shortNumber(values[g]), " font-size=\"12\"");
    }
    y += kGap;
  }
  out += text((left + kWidth - kRight - 50) / 2, bottom + 42, "middle", chart.value.label);
  return frame(bottom + 60, chart.title, chart.subtitle, out);
}

}  // namespace umbrage::benchmarks
