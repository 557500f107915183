#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "umbrage/report/detail/hours_scale.hpp"
#include "umbrage/report/detail/panel.hpp"
#include "umbrage/report/write_hours.hpp"

namespace umbrage::report {
namespace {

using detail::Canvas;
using detail::Panel;

constexpr int kView = 900;  // pixels of the longer side
constexpr std::size_t kShades = 256;
constexpr image::Rgb8 kNothing{236, 238, 242}, kBuilt{214, 214, 218};

std::string subtitleOf(const scene::Scene& scene, const study::HoursTable& table) {
  const std::size_t slash = scene.source.find_last_of("/\\");
  const std::string name = slash == std::string::npos ? scene.source : scene.source.substr(slash + 1);
  const std::string date =
      sun::dateText(table.request.date) + (table.request.until ? " to " + sun::dateText(*table.request.until) : "");
  return name.empty() ? date : name + ", " + date;
}

// Which pixels a caster above the plane covers, seen from above.
image::GreyImage coverOf(const scene::Scene& scene, const study::Lattice& l, double height, int pixels, int width,
                         int rows) {
  image::GreyImage cover(width, rows, 0);
  const Vec3 east = scene::eastVector(scene.up), north = scene::northVector(scene.up), up = scene::upVector(scene.up);
  const double scale = pixels / l.step;
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& at) {
    return (q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x);
  };
  for (const scene::Instance& instance : scene.instances) {
    if (!instance.casts) continue;
    const mesh::Mesh& m = *scene.meshes[instance.mesh];
    for (const mesh::Triangle& t : m.triangles) {
      Vec2 c[3];
      double top = -1e300;
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = transformPoint(instance.toWorld, m.positions[t[k]]);
        c[k] = {(glm::dot(p, east) - l.west) * scale, (l.north - glm::dot(p, north)) * scale};
        top = std::max(top, glm::dot(p, up));
      }
      if (top <= height) continue;
      const auto bound = [](double v, int most) { return static_cast<int>(std::clamp(v, 0.0, double(most))); };
      const int x1 = bound(std::ceil(std::max({c[0].x, c[1].x, c[2].x})), width),
                y1 = bound(std::ceil(std::max({c[0].y, c[1].y, c[2].y})), rows);
      for (int y = bound(std::floor(std::min({c[0].y, c[1].y, c[2].y})), rows); y < y1; ++y)
        for (int x = bound(std::floor(std::min({c[0].x, c[1].x, c[2].x})), width); x < x1; ++x) {
          const Vec2 at(x + 0.5, y + 0.5);
          const double u = side(c[0], c[1], at), v = side(c[1], c[2], at), w = side(c[2], c[0], at);
          if (((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) && u + v + w != 0.0) cover(x, y) = 255;
        }
    }
  }
  return cover;
}

// An arrow to the north of the frame.
void drawNorth(Canvas& canvas, double size) {
  const double x = 34 * size, y = 54 * size;
  canvas.fillDisc({x, y - 14 * size}, 27 * size, {255, 255, 255}, 0.8);
  canvas.fillPolygon(std::vector<Vec2>{{x, y - 34 * size}, {x + 8 * size, y}, {x, y - 6 * size}, {x - 8 * size, y}},
                     {198, 44, 44});
  canvas.text(x, y + 9 * size, "N", {11 * size, true}, detail::Align::centre);
}

// How long so much of the picture is: a round number of metres, about a fifth of its width. `pixel`: metres.
void drawLength(Canvas& canvas, double size, int height, int width, double pixel) {
  const double most = 0.25 * width * pixel, power = std::pow(10.0, std::floor(std::log10(most)));
  double length = power;
  for (const double step : {2.0, 5.0})
    if (step * power <= most) length = step * power;
  const double across = length / pixel, left = 18 * size, y = height - 18 * size;
  const std::string text = length < 1000.0 ? fmt::format("{:g} m", length) : fmt::format("{:g} km", length / 1000.0);
  const double room = std::max(across, canvas.textWidth(text, {11 * size}));
  canvas.fillRect(left - 8 * size, y - 24 * size, room + 16 * size, 34 * size, {255, 255, 255}, 0.8, 6 * size);
  canvas.fillRect(left, std::round(y - 1.5 * size), across, std::round(3 * size), {33, 37, 45});
  canvas.text(left, y - 7 * size, text, {11 * size});
}

}  // namespace

image::RgbImage hoursPlan(const scene::Scene& scene, const study::HoursTable& table) {
  const study::Lattice& l = table.set.lattice;
  const int longer = std::max(l.columns, l.rows), pixels = std::max(1, kView / longer),
            shrink = std::max(1, (longer + 4095) / 4096);
  const int width = std::max(1, l.columns * pixels / shrink), rows = std::max(1, l.rows * pixels / shrink);
  const detail::HoursScale scale = detail::scaleOf(table);
  image::RgbImage view(width, rows, kNothing);
  const double height =
      table.set.receivers.empty() ? 0.0 : glm::dot(table.set.receivers[0].position, scene::upVector(scene.up));
  const bool level = std::all_of(table.set.receivers.begin(), table.set.receivers.end(), [&](const auto& r) {
    return std::abs(glm::dot(r.position, scene::upVector(scene.up)) - height) < 1e-9;
  });
  const image::GreyImage cover =
      level && shrink == 1 ? coverOf(scene, l, height + 1e-6, pixels, width, rows) : image::GreyImage(width, rows, 0);
  std::vector<double> shown;
  bool builtOver = false, missing = false;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < width; ++x) {
      const int column = std::min(l.columns - 1, x * shrink / pixels), row = std::min(l.rows - 1, y * shrink / pixels);
      const std::int32_t r = l.receiver[static_cast<std::size_t>(row) * static_cast<std::size_t>(l.columns) +
                                        static_cast<std::size_t>(column)];
      missing = missing || r < 0;
      if (r < 0) continue;
      const bool built = cover(x, y) != 0;
      builtOver = builtOver || built;
      view(x, y) = built ? kBuilt : detail::hoursColour(table.hours[static_cast<std::size_t>(r)] / scale.top);
      if (!built) shown.push_back(table.hours[static_cast<std::size_t>(r)]);
    }
  for (int y = 1; y < rows; ++y)
    for (int x = 1; x < width; ++x)
      if (cover(x, y) != cover(x - 1, y) || cover(x, y) != cover(x, y - 1)) view(x, y) = {96, 100, 110};
  std::sort(shown.begin(), shown.end());
  const auto share = [&](double f) {
    return shown.empty() ? 0.0 : shown[static_cast<std::size_t>(f * double(shown.size() - 1))];
  };
  const double mean = shown.empty() ? 0.0 : std::accumulate(shown.begin(), shown.end(), 0.0) / double(shown.size());

  const auto write = [&](Panel& panel) {
    panel.title("Hours of sun", subtitleOf(scene, table));
    panel.gap(8);
    std::vector<Panel::Tick> ticks;
    const int steps = static_cast<int>(std::lround(scale.top / scale.step));
    for (int i = 0; i <= steps; ++i) ticks.push_back({double(i) / steps, fmt::format("{:g}", i * scale.step)});
    panel.bar(
        kShades, [](std::size_t i) { return detail::hoursColour((double(i) + 0.5) / double(kShades)); }, ticks);
    panel.gap(6);
    panel.row({}, "least", fmt::format("{:.2f} h", share(0)));
    panel.row({}, "median", fmt::format("{:.2f} h", share(0.5)));
    panel.row({}, "mean", fmt::format("{:.2f} h", mean));
    panel.row({}, "most", fmt::format("{:.2f} h", share(1)));
    if (builtOver) panel.row({kBuilt}, "built over", "");
    if (missing) panel.row({kNothing}, "no surface", "");
    panel.gap(8);
    panel.heading("What the figures rest on");
    panel.ledger(table.ledger);
  };
  const double pixel = l.step * shrink / pixels * scene.metresPerUnit;
  return detail::besidePanel(view, write, [&](Canvas& canvas, double size) {
    drawNorth(canvas, size);
    drawLength(canvas, size, rows, width, pixel);
  });
}

}  // namespace umbrage::report
