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

constexpr std::size_t kMostRows = 14;

// ---- colours of steps

// 0 for the first step with the sun up, 1 for the last.
std::vector<double> timesOfDay(const study::Profile& profile) {
  std::vector<double> times(profile.steps.size(), 0.5);
  std::vector<std::size_t> up;
  for (std::size_t i = 0; i < profile.steps.size(); ++i)
    if (profile.steps[i].moment.sunIsUp()) up.push_back(i);
  for (std::size_t k = 0; k < up.size(); ++k) times[up[k]] = up.size() > 1 ? double(k) / double(up.size() - 1) : 0.5;
  return times;
}

std::vector<image::Rgb8> stepColours(const study::Profile& profile) {
  const auto times = timesOfDay(profile);
  std::vector<image::Rgb8> colours;
  for (std::size_t i = 0; i < times.size(); ++i)
    colours.push_back(profile.steps[i].moment.sunIsUp() ? timeColour(times[i]) : image::Rgb8{120, 126, 138});
  return colours;
}

std::size_t sunnySteps(const study::Profile& profile) {
  return static_cast<std::size_t>(std::count_if(profile.steps.begin(), profile.steps.end(),
                                                [](const auto& step) { return step.moment.sunIsUp(); }));
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
  const Stroke stroke = strokeFor(sunnySteps(profile) * std::max<std::size_t>(1, profile.parts.size()), scale);
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
  if (!moment.sunIsUp()) return "sun below the horizon";
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
  const std::string when = fmt::format("{}, {} to {}", ledgerText(profile, "Date"), profile.steps.front().moment.label,
                                       profile.steps.back().moment.label);
  return name.empty() ? when : name + ", " + when;
}

// Every k-th step, so that the legend is not longer than kMostRows.
std::size_t rowStride(std::size_t steps) {
  for (const std::size_t stride : {1, 2, 3, 4, 6, 12, 24, 30, 60, 120})
    if ((steps + stride - 1) / stride <= kMostRows) return stride;
  return steps;
}

void writeTimes(Panel& panel, const study::Profile& profile) {
  const auto colours = stepColours(profile);
  const auto times = timesOfDay(profile);
  const std::size_t stride = rowStride(profile.steps.size());
  panel.heading(stride == 1 ? "Shadows at, with the sun"
                            : fmt::format("Shadows at {} times, with the sun", profile.steps.size()));
  if (stride > 1) {
    std::vector<Panel::Tick> ticks;
    for (std::size_t i = 0; i < profile.steps.size(); i += stride)
      ticks.push_back({(double(i) + 0.5) / double(profile.steps.size()), profile.steps[i].moment.label});
    panel.bar(
        profile.steps.size(), [&](std::size_t i) { return colours[i]; }, ticks);
  } else {
    panel.gap(4);
  }
  for (std::size_t i = 0; i < profile.steps.size(); i += stride) {
    std::vector<image::Rgb8> swatches;
    for (std::size_t p = 0; p < profile.steps[i].parts.size(); ++p) swatches.push_back(partColour(p, times[i]));
    if (swatches.empty()) swatches.push_back(colours[i]);
    panel.row(swatches, profile.steps[i].moment.label, sunText(profile.steps[i].moment));
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

// A whole number of these makes the scale of the heat map and its lines: at most eight lines.
double hourLine(double hours) {
  for (const double step : {0.25, 0.5, 1.0, 2.0, 3.0})
    if (hours / step <= 8.0 + 1e-9) return step;
  return 4.0;
}

// Hours come in multiples of about this many, so that a line "at least 1 h" must run a little below 1 h.
double smallestShare(const study::Profile& profile) {
  double hours = 24.0;
  for (const auto& step : profile.steps)
    if (step.moment.sunIsUp()) hours = std::min(hours, double(step.moment.share.count()) / 3.6e6);
  return hours;
}

Layer hoursLayer(const scene::Scene& scene, const study::Profile& profile, double hours, double scale) {
  const Layer model = detail::paleModel(scene, profile);
  const auto relief = detail::relief(model);
  const image::GreyImage edges = detail::formEdges(profile);
  Layer layer = model;
  image::Image<float> inShadow(model.width(), model.height());
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (profile.surface.triangle.pixels()[i] == shadow::kNoTriangle) continue;
    inShadow.pixels()[i] = static_cast<float>(profile.shadowMinutes.pixels()[i] / 60.0);
    const double t = hours > 0.0 ? inShadow.pixels()[i] / hours : 0.0;
    layer.pixels()[i] = relief.pixels()[i] * detail::toVec(heatColour(t));
  }
  detail::drawForm(layer, edges);
  if (hours <= 0.0) return layer;
  const auto field = detail::smoothed(inShadow);
  detail::Lines lines(edges, static_cast<float>(scale), 0.5f);
  const double margin = 0.5 * smallestShare(profile);
  for (double level = hourLine(hours); level < hours - 1e-6; level += hourLine(hours))
    lines.addBorder(field, static_cast<float>(level - margin),
                    detail::toVec(heatColour(level / hours > 0.5 ? 0.15 : 1.0)));
  lines.over(layer);
  return layer;
}

void writeHourScale(Panel& panel, double hours) {
  constexpr std::size_t kCells = 97;
  std::vector<Panel::Tick> ticks;
  for (double level = 0.0; level <= hours + 1e-6; level += hourLine(hours))
    ticks.push_back({level / hours, fmt::format("{:g} h", level)});
  panel.bar(
      kCells, [](std::size_t i) { return heatColour(double(i) / double(kCells - 1)); }, ticks);
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
  const auto view = detail::toRgb(hoursLayer(scene, profile, hours, viewScale(profile)));
  return detail::besidePanel(
      view,
      [&](Panel& panel) {
        panel.title("Hours in shadow", subtitleOf(scene, profile));
        panel.heading("Time without direct sun");
        if (hours > 0.0) writeHourScale(panel, hours);
        panel.paragraph(fmt::format(
            "The sun is up for {:.2f} h of the period.{}", hours,
            hours > 0.0
                ? fmt::format(" Lines enclose at least {0:g} h, {1:g} h and so on. The shading shows form alone.",
                              hourLine(hours), 2.0 * hourLine(hours))
                : ""));
        writeLedger(panel, profile);
      },
      [&](Canvas& canvas, double scale) { domeAtCorner(canvas, scene, profile, scale); });
}

}  // namespace umbrage::report
