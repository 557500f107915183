#include "umbrage/report/detail/panel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "umbrage/study/sun_light.hpp"

namespace umbrage::report::detail {
namespace {

constexpr image::Rgb8 kInk{33, 37, 45};
constexpr image::Rgb8 kSoftInk{104, 110, 122};
constexpr image::Rgb8 kRule{222, 225, 230};
constexpr image::Rgb8 kPaper{255, 255, 255};
constexpr double kPanelWidth = 330.0, kMargin = 20.0;

TextStyle ink(double size, bool bold = false) { return {size, bold, kInk}; }
TextStyle soft(double size) { return {size, false, kSoftInk}; }

double scaleFor(int height) { return std::clamp(double(height) / 720.0, 0.8, 3.0); }

// A direction of the world as the picture sees it from afar: right and down in pixels, and depth away from the viewer.
Vec3 seen(const scene::CameraBasis& b, const Vec3& direction) {
  return {glm::dot(direction, b.right), -glm::dot(direction, b.up), glm::dot(direction, b.forward)};
}

}  // namespace

Panel::Panel(Canvas& canvas, double left, double width, double scale)
    : canvas_(canvas), left_(left), width_(width), scale_(scale), y_(kMargin * scale) {}

void Panel::title(const std::string& title, const std::string& subtitle) {
  y_ += 18.0 * scale_;
  canvas_.text(left_, y_, title, ink(20.0 * scale_, true));
  for (const std::string& line : canvas_.wrap(subtitle, width_, soft(12.0 * scale_))) {
    y_ += 18.0 * scale_;
    canvas_.text(left_, y_, line, soft(12.0 * scale_));
  }
  y_ += 8.0 * scale_;
}

void Panel::heading(const std::string& text) {
  y_ += 10.0 * scale_;
  canvas_.fillRect(left_, std::round(y_), width_, std::max(1.0, std::round(scale_)), kRule);
  y_ += 18.0 * scale_;
  canvas_.text(left_, y_, text, ink(11.5 * scale_, true));
  y_ += 6.0 * scale_;
}

void Panel::paragraph(const std::string& text) {
  for (const std::string& line : canvas_.wrap(text, width_, ink(12.0 * scale_))) {
    y_ += 16.0 * scale_;
    canvas_.text(left_, y_, line, ink(12.0 * scale_));
  }
  y_ += 2.0 * scale_;
}

void Panel::bar(std::size_t cells, const std::function<image::Rgb8(std::size_t)>& colour,
                const std::vector<Tick>& ticks) {
  const double height = std::round(16.0 * scale_), top = std::round(y_ + 4.0 * scale_);
  for (std::size_t i = 0; i < cells; ++i) {
    // Whole pixels of the picture, or the joints would shine through.
    const double begin = std::round(left_ + width_ * double(i) / double(cells)),
                 end = std::round(left_ + width_ * double(i + 1) / double(cells));
    canvas_.fillRect(begin, std::round(top), end - begin, std::round(height), colour(i));
  }
  // Labels never run into each other; the last is there in any case, for it says where the scale ends.
  const TextStyle style = soft(10.5 * scale_);
  const double room = 5.0 * scale_;
  const auto placed = [&](const Tick& tick) {
    const double half = 0.5 * canvas_.textWidth(tick.label, style);
    return std::pair(std::clamp(left_ + tick.at * width_, left_ + half, left_ + width_ - half), half);
  };
  double free = -1e9, end = 1e9;
  for (const Tick& tick : ticks) {
    const bool last = &tick == &ticks.back();
    if (!last) end = placed(ticks.back()).first - placed(ticks.back()).second - room;
    canvas_.fillRect(left_ + tick.at * width_ - 0.5 * scale_, top + height, scale_, 4.0 * scale_, kSoftInk);
    const auto [centre, half] = placed(tick);
    if (!last && (centre - half < free || centre + half > end)) continue;
    canvas_.text(centre, top + height + 15.0 * scale_, tick.label, style, Align::centre);
    free = centre + half + room;
  }
  y_ = top + height + 22.0 * scale_;
}

void Panel::row(const std::vector<image::Rgb8>& swatches, const std::string& text, const std::string& right) {
  const double height = 12.0 * scale_, width = (swatches.size() > 2 ? 14.0 : 24.0) * scale_;
  double x = left_;
  for (const image::Rgb8 colour : swatches) {
    canvas_.fillRect(x, y_ + 0.5 * (rowHeight() - height), width, height, colour, 1.0, 2.0 * scale_);
    x += width + 3.0 * scale_;
  }
  const double baseline = y_ + 0.5 * rowHeight() + 4.3 * scale_;
  canvas_.text(x + 6.0 * scale_, baseline, text, ink(12.0 * scale_));
  canvas_.text(left_ + width_, baseline, right, soft(11.5 * scale_), Align::right);
  y_ += rowHeight();
}

void Panel::ledger(const std::vector<study::LedgerLine>& lines) {
  const TextStyle style = soft(10.0 * scale_);
  const double indent = 66.0 * scale_;
  for (const study::LedgerLine& line : lines) {
    canvas_.text(left_, y_ + 13.0 * scale_, line.subject, {10.0 * scale_, true, kSoftInk});
    for (const std::string& part : canvas_.wrap(line.text, width_ - indent, style)) {
      y_ += 13.0 * scale_;
      canvas_.text(left_ + indent, y_, part, style);
    }
    y_ += 2.5 * scale_;
  }
}

void drawSunDome(Canvas& canvas, const scene::Scene& scene, const study::Profile& profile,
                 const std::vector<image::Rgb8>& colours, const Vec2& centre, double radius) {
  const scene::CameraBasis view = scene::basis(profile.camera);
  const Vec3 north = scene::northVector(scene.up, scene.northOffset),
             east = scene::eastVector(scene.up, scene.northOffset);
  const auto onPaper = [&](const Vec3& direction) {
    const Vec3 s = seen(view, direction);
    return centre + radius * Vec2(s.x, s.y);
  };
  const auto horizontal = [&](double degrees) {
    const Angle a = Angle::degrees(degrees);
    return cos(a) * north + sin(a) * east;
  };
  std::vector<Vec2> ring;
  for (int i = 0; i <= 72; ++i) ring.push_back(onPaper(horizontal(5.0 * i)));
  canvas.fillDisc(centre, radius * 1.55, kPaper, 0.85);
  canvas.fillPolygon(ring, {233, 236, 241}, 0.9);
  canvas.strokeLine(ring, kSoftInk, radius / 45.0);
  for (int i = 0; i < 24; ++i) {
    const double inner = i % 6 == 0 ? 0.86 : 0.94;
    const std::vector<Vec2> tick{onPaper(inner * horizontal(15.0 * i)), onPaper(horizontal(15.0 * i))};
    canvas.strokeLine(tick, kSoftInk, radius / 45.0);
  }
  const Vec3 tip = 0.78 * north;
  canvas.fillPolygon(std::vector<Vec2>{onPaper(tip), onPaper(0.13 * east), onPaper(-0.13 * east)}, {198, 44, 44});
  canvas.fillPolygon(std::vector<Vec2>{onPaper(-tip), onPaper(0.13 * east), onPaper(-0.13 * east)}, {150, 156, 166});
  std::vector<Vec2> path;
  for (const auto& step : profile.steps)
    if (step.moment.sunIsUp()) path.push_back(onPaper(study::towardsSun(step.moment.sun, scene.up, scene.northOffset)));
  canvas.strokeLine(path, kSoftInk, radius / 40.0, 0.7);
  const double dot = radius * (path.size() > 30 ? 0.05 : 0.085);
  std::size_t next = 0;
  for (std::size_t i = 0; i < profile.steps.size(); ++i) {
    if (!profile.steps[i].moment.sunIsUp()) continue;
    canvas.fillDisc(path[next], dot + radius / 60.0, kPaper);
    canvas.fillDisc(path[next++], dot, colours[i]);
  }
  const TextStyle letter{radius * 0.25, true, kInk};
  for (const auto& [name, degrees] : {std::pair("N", 0.0), {"E", 90.0}, {"S", 180.0}, {"W", 270.0}}) {
    const Vec2 at = onPaper(1.32 * horizontal(degrees));
    canvas.text(at.x, at.y + 0.09 * radius, name, letter, Align::centre);
  }
}

image::RgbImage besidePanel(const image::RgbImage& view, const std::function<void(Panel&)>& write,
                            const std::function<void(Canvas&, double scale)>& overView) {
  const double scale = scaleFor(view.height());
  const int panelWidth = static_cast<int>(std::lround(kPanelWidth * scale));
  const double left = kMargin * scale, width = panelWidth - 2.0 * kMargin * scale;
  Canvas measure(1, 1, kPaper);
  Panel measured(measure, left, width, scale);
  write(measured);
  const int height = std::max(view.height(), static_cast<int>(std::ceil(measured.bottom() + kMargin * scale)));

  Canvas canvas(view.width() + panelWidth, height, kPaper);
  canvas.paste(view, 0, 0);
  overView(canvas, scale);
  Panel panel(canvas, view.width() + left, width, scale);
  write(panel);
  return canvas.picture();
}

}  // namespace umbrage::report::detail
