#include "umbrage/report/profile_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "umbrage/report/colours.hpp"
#include "umbrage/report/detail/layers.hpp"
#include "umbrage/report/detail/panel.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::report {
namespace {

using detail::Canvas;
using detail::Layer;
using detail::Panel;

constexpr std::size_t kMostRows = 16;

// ---- colours of steps

// The numbers of the steps with the sun up.
std::vector<std::size_t> sunnySteps(const study::Profile& profile) {
  std::vector<std::size_t> up;
  for (std::size_t i = 0; i < profile.steps.size(); ++i)
    if (profile.steps[i].moment.sunIsUp()) up.push_back(i);
  return up;
}

// 0 for the first step with the sun up, 1 for the last.
std::vector<double> timesOfDay(const study::Profile& profile) {
  std::vector<double> times(profile.steps.size(), 0.5);
  const auto up = sunnySteps(profile);
  for (std::size_t k = 0; k < up.size(); ++k) times[up[k]] = up.size() > 1 ? double(k) / double(up.size() - 1) : 0.5;
  return times;
}

// Those of steps without sun are never drawn.
std::vector<image::Rgb8> stepColours(const study::Profile& profile) {
  std::vector<image::Rgb8> colours;
  for (const double time : timesOfDay(profile)) colours.push_back(timeColour(time));
  return colours;
}

// ---- the shadows of all steps

struct Stroke {
  float fill, width, alpha;
};

// The more steps, the fainter each, so that all of them on one spot make about the same darkness.
Stroke strokeFor(std::size_t steps, double scale) {
  const double n = double(std::max<std::size_t>(steps, 1));
  return {static_cast<float>(std::clamp(1.0 - std::pow(0.10, 1.0 / n), 0.03, 0.55)),
          static_cast<float>(std::clamp(2.2 - 0.02 * n, 1.0, 2.0) * scale),
          static_cast<float>(std::clamp(1.1 - 0.008 * n, 0.5, 1.0))};
}

Layer shadowLayer(const scene::Scene& scene, const study::Profile& profile, double scale) {
  Layer layer = detail::paleModel(scene, profile);
  const image::GreyImage edges = detail::formEdges(profile);
  detail::drawForm(layer, edges);
  const auto times = timesOfDay(profile);
  const Stroke stroke = strokeFor(sunnySteps(profile).size() * std::max<std::size_t>(1, profile.parts.size()), scale);
  detail::Lines lines(edges, stroke.width, stroke.alpha);
  const auto draw = [&](const study::ProfileStep& step, const image::GreyImage& light, image::Rgb8 colour) {
    const auto shadow = detail::castShadow(profile, step, light, scene);
    if (shadow.empty()) return;
    detail::stain(layer, shadow, detail::toVec(colour), stroke.fill);
    const auto field = detail::smoothed(shadow);
    lines.addBorder(field, 0.5f, detail::toVec(colour), detail::solidBorders(field));
  };
  for (std::size_t i = 0; i < profile.steps.size(); ++i) {
    const study::ProfileStep& step = profile.steps[i];
    if (profile.parts.empty()) draw(step, step.light, timeColour(times[i]));
    for (std::size_t p = 0; p < step.parts.size(); ++p) draw(step, step.parts[p], partColour(p, times[i]));
  }
  lines.over(layer);
  return layer;
}

// ---- legends

std::string sunText(const study::PeriodStep& moment) {
  return fmt::format("{:.1f}\u00b0 high, {:.1f}\u00b0 {}", moment.sun.elevation.degrees(), moment.sun.azimuth.degrees(),
                     sun::compassPoint(moment.sun.azimuth));
}

std::string titleOf(const scene::Scene& scene) {
  const std::size_t slash = scene.source.find_last_of("/\\");
  return slash == std::string::npos ? scene.source : scene.source.substr(slash + 1);
}

std::string ledgerText(const study::Profile& profile, std::string_view subject) {
  for (const study::LedgerLine& line : profile.ledger)
    if (line.subject == subject) return line.text;
  return {};
}

std::string subtitleOf(const scene::Scene& scene, const study::Profile& profile) {
  const std::string name = titleOf(scene);
  const std::string period = ledgerText(profile, "Period");
  const std::string when = ledgerText(profile, "Date") + ", " + period.substr(0, period.find(','));
  return name.empty() ? when : name + ", " + when;
}

// Every k-th step, so that the legend is not longer than kMostRows.
std::size_t rowStride(std::size_t steps) {
  for (const std::size_t stride : {1, 2, 3, 4, 6, 12, 24, 30, 60, 120})
    if ((steps + stride - 1) / stride <= kMostRows) return stride;
  return steps;
}

// Where to begin with every stride-th step: at a full hour, if one of the first is.
std::size_t rowOffset(const study::Profile& profile, const std::vector<std::size_t>& sunny, std::size_t stride) {
  for (std::size_t k = 0; k < std::min(stride, sunny.size()); ++k)
    if (profile.steps[sunny[k]].moment.label.substr(2, 3) == ":00") return k;
  return 0;
}

void writeTimes(Panel& panel, const study::Profile& profile) {
  const auto colours = stepColours(profile);
  const auto times = timesOfDay(profile);
  const auto sunny = sunnySteps(profile);
  if (sunny.empty()) return panel.paragraph("The sun is below the horizon at all times of the period.");
  const std::size_t stride = rowStride(sunny.size());
  const std::size_t offset = stride > 1 ? rowOffset(profile, sunny, stride) : 0;
  panel.heading(stride == 1 ? "Shadows at, with the sun"
                            : fmt::format("Shadows at {} times, with the sun", sunny.size()));
  if (stride > 1) {
    std::vector<Panel::Tick> ticks;
    for (std::size_t k = offset; k < sunny.size(); k += stride)
      ticks.push_back({(double(k) + 0.5) / double(sunny.size()), profile.steps[sunny[k]].moment.label});
    panel.bar(
        sunny.size(), [&](std::size_t k) { return colours[sunny[k]]; }, ticks);
  } else {
    panel.gap(4);
  }
  for (std::size_t k = offset; k < sunny.size(); k += stride) {
    const study::ProfileStep& step = profile.steps[sunny[k]];
    std::vector<image::Rgb8> swatches;
    for (std::size_t p = 0; p < step.parts.size(); ++p) swatches.push_back(partColour(p, times[sunny[k]]));
    if (swatches.empty()) swatches.push_back(colours[sunny[k]]);
    panel.row(swatches, step.moment.label, sunText(step.moment));
  }
}

void writeParts(Panel& panel, const study::Profile& profile) {
  if (profile.parts.empty()) return;
  panel.heading("Casting parts");
  panel.gap(4);
  for (std::size_t p = 0; p < profile.parts.size(); ++p)
    panel.row({partColour(p, 0.0), partColour(p, 0.5), partColour(p, 1.0)}, profile.parts[p].pattern, "early to late");
}

void writeLedger(Panel& panel, const study::Profile& profile) {
  panel.gap(4);
  panel.heading("Conventions");
  panel.ledger(profile.ledger);
}

void domeAtCorner(Canvas& canvas, const scene::Scene& scene, const study::Profile& profile, double scale) {
  const double shorter = std::min(profile.camera.width, profile.camera.height);
  const double radius = std::min(46.0 * scale, 0.09 * shorter), margin = 1.9 * radius;
  if (radius < 16.0) return;
  detail::drawSunDome(canvas, scene, profile, stepColours(profile), {margin, profile.camera.height - margin}, radius);
}

double viewScale(const study::Profile& profile) { return std::clamp(profile.camera.height / 720.0, 0.8, 3.0); }

// ---- hours

// The distance of lines and ticks: at most eight of them.
double hourLine(double hours) {
  for (const double step : {1.0 / 60.0, 1.0 / 12.0, 0.25, 0.5, 1.0, 2.0, 3.0})
    if (hours / step <= 8.0 + 1e-3) return step;
  return 4.0;
}

// Hours come in multiples of about this many, so that a line "at least 1 h" must run a little below 1 h.
double smallestShare(const study::Profile& profile) {
  double hours = 24.0;
  for (const auto& step : profile.steps)
    if (step.moment.sunIsUp()) hours = std::min(hours, double(step.moment.share.count()) / 3.6e6);
  return hours;
}

// REQUIRES: hours > 0.
Layer hoursLayer(const scene::Scene& scene, const study::Profile& profile, double hours, double scale) {
  Layer layer = detail::paleModel(scene, profile);
  const auto relief = detail::relief(layer);
  image::Image<float> inShadow(layer.width(), layer.height());
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (profile.surface.triangle.pixels()[i] == shadow::kNoTriangle) continue;
    inShadow.pixels()[i] = profile.shadowMinutes.pixels()[i] / 60.0f;
    layer.pixels()[i] = relief.pixels()[i] * detail::toVec(heatColour(inShadow.pixels()[i] / hours));
  }
  const image::GreyImage edges = detail::formEdges(profile);
  detail::drawForm(layer, edges);
  const auto field = detail::smoothed(inShadow);
  detail::Lines lines(edges, static_cast<float>(scale), 0.5f);
  const double margin = 0.5 * smallestShare(profile);
  for (double level = hourLine(hours); level < hours - 1e-6; level += hourLine(hours))
    lines.addBorder(field, static_cast<float>(level - margin),
                    detail::toVec(heatColour(level / hours > 0.5 ? 0.15 : 1.0)));
  lines.over(layer);
  return layer;
}

std::string durationText(double hours, double unit) {
  return unit < 1.0 ? fmt::format("{:.0f} min", hours * 60.0) : fmt::format("{:g} h", hours);
}

void writeHours(Panel& panel, double hours) {
  if (hours <= 0.0) return panel.paragraph("The sun is below the horizon at all times of the period.");
  constexpr std::size_t kCells = 97;
  const double line = hourLine(hours);
  std::vector<Panel::Tick> ticks;
  for (double level = 0.0; level <= hours + 1e-6; level += line)
    ticks.push_back({level / hours, durationText(level, line)});
  panel.heading("Time without direct sun");
  panel.bar(
      kCells, [](std::size_t i) { return heatColour(double(i) / double(kCells - 1)); }, ticks);
  panel.paragraph(
      fmt::format("The sun is up for {:.2f} h of the period. Lines enclose at least {}, {} and so on. The shading "
                  "shows form alone.",
                  hours, durationText(line, line), durationText(2.0 * line, line)));
}

}  // namespace

image::RgbImage shadowPicture(const scene::Scene& scene, const study::Profile& profile) {
  const auto view = detail::toRgb(shadowLayer(scene, profile, viewScale(profile)));
  return detail::besidePanel(
      view,
      [&](Panel& panel) {
        panel.title("Shadow profile", subtitleOf(scene, profile));
        writeParts(panel, profile);
        writeTimes(panel, profile);
        writeLedger(panel, profile);
      },
      [&](Canvas& canvas, double scale) { domeAtCorner(canvas, scene, profile, scale); });
}

image::RgbImage hoursPicture(const scene::Scene& scene, const study::Profile& profile) {
  const double hours = profile.sunUpMinutes / 60.0;
  const double scale = viewScale(profile);
  return detail::besidePanel(
      detail::toRgb(hours > 0.0 ? hoursLayer(scene, profile, hours, scale) : shadowLayer(scene, profile, scale)),
      [&](Panel& panel) {
        panel.title("Time in shadow", subtitleOf(scene, profile));
        writeHours(panel, hours);
        writeLedger(panel, profile);
      },
      [&](Canvas& canvas, double canvasScale) { domeAtCorner(canvas, scene, profile, canvasScale); });
}

}  // namespace umbrage::report
