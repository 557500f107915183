#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "umbrage/base/file.hpp"
#include "umbrage/report/html.hpp"
#include "umbrage/report/vector_map.hpp"

namespace umbrage::report {
namespace {

using outline::Polygon;
using outline::Ring;

constexpr double kMapSide = 960.0, kPanel = 320.0, kMargin = 24.0, kLine = 15.5;
constexpr std::size_t kLettersInLine = 46, kLettersInTitle = 25;
constexpr double kNeighbourhood = 25.0;  // metres about the features of a map that is about them
constexpr double kRoom = 0.04;           // around what is drawn, of its size

struct Frame {
  Vec2 origin{0.0};  // of the paths, in the scene's coordinates
  Vec2 low{0.0}, high{1.0};
  double scale = 1.0;  // pixels a unit
  [[nodiscard]] double width() const { return (high.x - low.x) * scale; }
  [[nodiscard]] double height() const { return (high.y - low.y) * scale; }
};

Frame frameOf(const VectorMap& map) {
  Frame frame;
  bool first = true;
  const auto add = [&](const Polygon& polygon) {
    for (const Vec2& p : polygon.outer) {
      frame.low = first ? p : glm::min(frame.low, p);
      frame.high = first ? p : glm::max(frame.high, p);
      first = false;
    }
  };
  for (const MapFeature& feature : map.features)
    std::for_each(feature.region.polygons.begin(), feature.region.polygons.end(), add);
  const Vec2 low = frame.low, high = frame.high;
  std::for_each(map.buildings.begin(), map.buildings.end(), add);
  if (map.aboutFeatures && !map.features.empty()) {
    const double around = 0.5 * std::max(high.x - low.x, high.y - low.y) + kNeighbourhood / map.metresPerUnit;
    frame.low = glm::max(frame.low, low - around);
    frame.high = glm::min(frame.high, high + around);
  }
  const double size = std::max({frame.high.x - frame.low.x, frame.high.y - frame.low.y, 1e-9});
  frame.low -= kRoom * size;
  frame.high += kRoom * size;
  frame.origin = glm::round(0.5 * (frame.low + frame.high));
  frame.scale = kMapSide / ((1.0 + 2.0 * kRoom) * size);
  return frame;
}

std::string hex(const image::Rgb8& c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }
image::Rgb8 darker(const image::Rgb8& c) {
  const auto down = [](std::uint8_t v) { return static_cast<std::uint8_t>(v * 0.62); };
  return {down(c.r), down(c.g), down(c.b)};
}

std::vector<std::string> wrapped(const std::string& text, std::size_t letters = kLettersInLine) {
  std::vector<std::string> lines;
  std::string rest = text;
  while (rest.size() > letters) {
    auto cut = rest.rfind(' ', letters);
    if (cut == std::string::npos || cut < letters / 2) cut = letters;
    // Never within a letter of several bytes.
    while ((static_cast<unsigned char>(rest[cut]) & 0xC0U) == 0x80U) --cut;
    lines.push_back(rest.substr(0, cut));
    rest.erase(0, rest[cut] == ' ' ? cut + 1 : cut);
  }
  lines.push_back(rest);
  return lines;
}

// 1, 2 or 5 times a power of ten, at most `most`.
double roundLength(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0})
    if (step * power <= most) return step * power;
  return power;
}

class Svg {
 public:
  Svg(const VectorMap& map, const Frame& frame) : map_(map), frame_(frame), digits_(digitsOf(frame)) {}

  [[nodiscard]] std::string draw() {
    drawMap();
    drawPanel();
    const double width = frame_.width() + kPanel + 3 * kMargin;
    const double height = std::max(frame_.height() + 2 * kMargin, y_ + kMargin);
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
               "{1:.0f}\" "
               "font-family=\"DejaVu Sans, Helvetica, Arial, "
               "sans-serif\">\n<title>{2}</title>\n<desc>{3}</desc>\n<metadata>{4}</metadata>\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
               width, height, escaped(map_.title), escaped(description()), escaped(ledger())) +
           out_ + "</svg>\n";
  }

 private:
  // A hundredth of what a screen shows at a thousandfold enlargement.
  static int digitsOf(const Frame& frame) {
    return std::clamp(static_cast<int>(std::ceil(std::log10(frame.scale * 1e5))), 0, 9);
  }
  [[nodiscard]] std::string description() const {
    return fmt::format("Paths are in the scene's unit, x east and y north of ({}, {}), at height {}", frame_.origin.x,
                       frame_.origin.y, map_.height);
  }
  // Once more without breaks, for programs.
  [[nodiscard]] std::string ledger() const {
    std::string text;
    for (const auto& line : map_.ledger) text += (text.empty() ? "" : "\n") + line.subject + ": " + line.text;
    return text;
  }
  template <class... T>
  void add(fmt::format_string<T...> form, T&&... values) {
    fmt::format_to(std::back_inserter(out_), form, std::forward<T>(values)...);
  }
  void addNumber(double value) {
    add("{:.{}f}", value, digits_);
    if (digits_ == 0) return;
    while (out_.back() == '0') out_.pop_back();
    if (out_.back() == '.') out_.pop_back();
  }
  void addRing(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      out_ += i == 0 ? "M" : "L";
      addNumber(ring[i].x - frame_.origin.x);
      out_ += ' ';
      addNumber(ring[i].y - frame_.origin.y);
    }
    out_ += "Z";
  }
  void addPolygon(const Polygon& polygon) {
    addRing(polygon.outer);
    for (const Ring& hole : polygon.holes) addRing(hole);
  }

  void drawMap() {
    add("<clipPath id=\"map\"><rect x=\"{0}\" y=\"{0}\" width=\"{1:.2f}\" height=\"{2:.2f}\"/></clipPath>\n", kMargin,
        frame_.width(), frame_.height());
    add("<rect x=\"{0}\" y=\"{0}\" width=\"{1:.2f}\" height=\"{2:.2f}\" fill=\"#faf8f3\" stroke=\"#dedbd2\"/>\n",
        kMargin, frame_.width(), frame_.height());
    add("<g clip-path=\"url(#map)\"><g transform=\"translate({:.4f} {:.4f}) scale({:.8g} {:.8g})\" "
        "fill-rule=\"evenodd\" "
        "stroke-linejoin=\"round\">\n",
        kMargin + (frame_.origin.x - frame_.low.x) * frame_.scale,
        kMargin + (frame_.high.y - frame_.origin.y) * frame_.scale, frame_.scale, -frame_.scale);
    if (map_.aboutFeatures) drawBuildings();
    for (std::size_t layer = 0; layer < map_.layers.size(); ++layer) drawLayer(layer);
    if (!map_.aboutFeatures) drawBuildings();
    out_ += "</g></g>\n";
    drawScale();
    drawNorth();
  }

  void drawBuildings() {
    if (map_.buildings.empty()) return;
    add("<path id=\"buildings\" fill=\"#d8d2c6\" fill-opacity=\"0.92\" stroke=\"#8d867a\" stroke-width=\"{:.4g}\" "
        "d=\"",
        0.5 / frame_.scale);
    for (const Polygon& polygon : map_.buildings) addPolygon(polygon);
    out_ += "\"/>\n";
  }

  void drawLayer(std::size_t layer) {
    const MapLayer& look = map_.layers[layer];
    const double thin = map_.layers.size() < 3 ? 0.55 : std::max(0.18, 0.9 / double(map_.layers.size()));
    const double opacity = look.opacity > 0.0 ? look.opacity : thin;
    add("<g id=\"layer-{}\" fill=\"{}\" fill-opacity=\"{:.2f}\" stroke=\"{}\" stroke-width=\"{:.4g}\" "
        "stroke-opacity=\"0.85\"><title>{}</title>\n",
        layer, hex(look.colour), opacity, hex(darker(look.colour)), 0.8 / frame_.scale, escaped(look.name));
    for (const MapFeature& feature : map_.features) {
      if (feature.layer != layer || feature.region.polygons.empty()) continue;
      out_ += "<path d=\"";
      for (const Polygon& polygon : feature.region.polygons) addPolygon(polygon);
      out_ += "\"/>\n";
    }
    out_ += "</g>\n";
  }

  void drawScale() {
    const double metres = roundLength(0.28 * frame_.width() / frame_.scale * map_.metresPerUnit);
    const double length = metres / map_.metresPerUnit * frame_.scale, x = kMargin + 16,
                 y = kMargin + frame_.height() - 18;
    add("<g><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"34\" rx=\"4\" fill=\"#ffffff\" "
        "fill-opacity=\"0.85\"/>\n",
        x - 8, y - 22, length + 16);
    add("<path d=\"M{0:.2f} {1:.2f}v5h{2:.2f}v-5\" fill=\"none\" stroke=\"#21252d\" stroke-width=\"1.4\"/>\n", x, y - 3,
        length);
    add("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"11\" fill=\"#21252d\">{}</text></g>\n", x, y - 8,
        metres >= 1000.0 ? fmt::format("{:g} km", metres / 1e3) : fmt::format("{:g} m", metres));
  }

  void drawNorth() {
    const double x = kMargin + frame_.width() - 30, y = kMargin + 36;
    add("<g transform=\"translate({:.2f} {:.2f}) rotate({:.3f})\"><circle r=\"24\" fill=\"#ffffff\" "
        "fill-opacity=\"0.85\"/>"
        "<path d=\"M0 -15L6 12L0 7L-6 12Z\" fill=\"#21252d\"/><text y=\"-16\" font-size=\"10\" text-anchor=\"middle\" "
        "fill=\"#21252d\">N</text></g>\n",
        x, y, map_.north.degrees());
  }

  void text(const std::string& words, double size, const char* colour, bool bold = false, double indent = 0.0) {
    add("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>\n", left() + indent, y_, size, colour,
        bold ? " font-weight=\"bold\"" : "", escaped(words));
  }
  [[nodiscard]] double left() const { return frame_.width() + 2 * kMargin; }
  void rule() {
    add("<path d=\"M{:.2f} {:.2f}h{}\" stroke=\"#dee1e6\"/>\n", left(), y_, kPanel);
    y_ += 20;
  }

  void drawPanel() {
    y_ = kMargin + 18;
    const auto title = wrapped(map_.title, kLettersInTitle);
    for (std::size_t i = 0; i < title.size(); ++i) {
      if (i > 0) y_ += 24;
      text(title[i], 20, "#21252d", true);
    }
    for (const std::string& line : wrapped(map_.subtitle)) {
      y_ += 18;
      text(line, 12, "#686e7a");
    }
    y_ += 14;
    rule();
    for (const MapLayer& layer : map_.layers) {
      add("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"22\" height=\"12\" rx=\"2\" fill=\"{}\" fill-opacity=\"{:.2f}\" "
          "stroke=\"{}\"/>\n",
          left(), y_ - 10, hex(layer.colour), layer.opacity > 0.0 ? layer.opacity : 0.75, hex(darker(layer.colour)));
      text(layer.name, 12, "#21252d", false, 32);
      y_ += 18;
    }
    rule();
    for (const auto& line : map_.ledger) {
      text(line.subject, 10.5, "#686e7a");
      for (const std::string& words : wrapped(line.text)) {
        y_ += kLine;
        text(words, 11, "#21252d");
      }
      y_ += kLine + 4;
    }
  }

  const VectorMap& map_;
  const Frame frame_;
  int digits_;
  std::string out_;
  double y_ = 0.0;
};

}  // namespace

std::string svgText(const VectorMap& map) { return Svg(map, frameOf(map)).draw(); }

Result<void> writeSvg(const VectorMap& map, const std::filesystem::path& path) { return writeFile(path, svgText(map)); }

}  // namespace umbrage::report
