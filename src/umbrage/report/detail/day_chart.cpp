// Bars of days as SVG inside a page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "umbrage/report/detail/day_chart.hpp"
#include "umbrage/report/html.hpp"

namespace umbrage::report::detail {
namespace {

constexpr double kWidth = 1000.0, kNames = 250.0, kFigures = 130.0, kTop = 24.0, kRow = 20.0, kBar = 12.0;
constexpr std::size_t kLettersOfName = 34;

/// Cut off where it would run into the bar.
std::string shortened(const std::string& name) {
  std::size_t letters = 0, bytes = 0;
  while (bytes < name.size() && letters < kLettersOfName) {
    ++bytes;
    while (bytes < name.size() && (static_cast<unsigned char>(name[bytes]) & 0xC0) == 0x80) ++bytes;
    ++letters;
  }
  return bytes == name.size() ? name : name.substr(0, bytes) + "\xE2\x80\xA6";
}

class Drawn {
 public:
  explicit Drawn(const DayChart& chart) : chart_(chart) {}

  [[nodiscard]] std::string text() const {
    std::string out =
        fmt::format("<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", kWidth,
                    bottom() + 4, escaped(chart_.title));
    out += outside() + hours();
    for (std::size_t i = 0; i < chart_.bars.size(); ++i) out += bar(chart_.bars[i], kTop + kRow * double(i));
    return out + "</svg>\n";
  }

 private:
  [[nodiscard]] double bottom() const { return kTop + kRow * double(chart_.bars.size()); }
  [[nodiscard]] double at(double hour) const {
    const double part = (hour - chart_.axis.from) / std::max(chart_.axis.to - chart_.axis.from, 1e-9);
    return kNames + std::clamp(part, 0.0, 1.0) * (kWidth - kNames - kFigures);
  }
  [[nodiscard]] std::string box(const DayPart& part, double y, double height, const char* look) const {
    const double x = at(part.from), width = at(part.to) - x;
    if (!(width > 0.0)) return {};
    return fmt::format("<rect class=\"{}\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>", look, x, y,
                       width, height);
  }
  /// What does not count.
  [[nodiscard]] std::string outside() const {
    std::string out;
    double from = chart_.axis.from;
    for (const DayPart& part : chart_.counts) {
      out += box({from, part.from}, kTop - 4, bottom() - kTop + 4, "out");
      from = std::max(from, part.to);
    }
    return out + box({from, chart_.axis.to}, kTop - 4, bottom() - kTop + 4, "out") + "\n";
  }
  [[nodiscard]] std::string hours() const {
    std::string out;
    for (double hour = std::ceil(chart_.axis.from); hour <= chart_.axis.to; hour += 1.0)
      out += fmt::format(
          "<line class=\"grid\" x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1:.0f}\" y2=\"{2:.0f}\"/><text class=\"hour\" "
          "x=\"{0:.2f}\" y=\"12\" text-anchor=\"middle\">{3:.0f}</text>",
          at(hour), kTop - 6, bottom(), std::fmod(hour + 24.0, 24.0));
    return out + "\n";
  }
  [[nodiscard]] std::string bar(const DayBar& bar, double y) const {
    const char* look = chart_.shown == "sun" ? "part" : "part shade";
    std::string out = fmt::format("<g><title>{}: {}</title><text x=\"0\" y=\"{:.1f}\">{}</text>", escaped(bar.name),
                                  escaped(bar.figure), y + 12, escaped(shortened(bar.name)));
    for (const DayPart& part : bar.parts) out += box(part, y + (kRow - kBar) / 2, kBar, look);
    const char* verdict = !bar.passes ? "" : *bar.passes ? "good" : "bad";
    return out + fmt::format("<text class=\"{}\" x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text></g>\n",
                             verdict, kWidth, y + 12, escaped(bar.figure));
  }

  const DayChart& chart_;
};

}  // namespace

std::string chartSvg(const DayChart& chart) { return Drawn(chart).text(); }

}  // namespace umbrage::report::detail
