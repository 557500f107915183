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

}  // namespace

image::RgbImage hoursPlan(const scene::Scene& scene, const study::HoursTable& table) {
  const study::Lattice& l = table.set.lattice;
  const int longer = std::max(l.columns, l.rows), pixels = std::max(1, kView / longer),
            shrink = std::max(1, (longer + 4095) / 4096);
  const int width = std::max(1, l.columns * pixels / shrink), rows = std::max(1, l.rows * pixels / shrink);
  const double most = detail::scaleTop(table);
  image::RgbImage view(width, rows, {228, 231, 236});
  const double height =
      table.set.receivers.empty() ? 0.0 : glm::dot(table.set.receivers[0].position, scene::upVector(scene.up));
  const bool level = std::all_of(table.set.receivers.begin(), table.set.receivers.end(), [&](const auto& r) {
    return std::abs(glm::dot(r.position, scene::upVector(scene.up)) - height) < 1e-9;
  });
  const image::GreyImage cover =
      level && shrink == 1 ? coverOf(scene, l, height + 1e-6, pixels, width, rows) : image::GreyImage(width, rows, 0);
  std::vector<double> shown;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < width; ++x) {
      const int column = std::min(l.columns - 1, x * shrink / pixels), row = std::min(l.rows - 1, y * shrink / pixels);
      const std::int32_t r = l.receiver[static_cast<std::size_t>(row) * static_cast<std::size_t>(l.columns) +
                                        static_cast<std::size_t>(column)];
      if (r < 0) continue;
      const bool built = cover(x, y) != 0;
      view(x, y) =
          built ? image::Rgb8{214, 214, 218} : detail::hoursColour(table.hours[static_cast<std::size_t>(r)] / most);
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
    const double each = detail::tickStep(most);
    for (double h = 0.0; h <= most + 1e-9; h += each) ticks.push_back({h / most, fmt::format("{:g}", h)});
    panel.bar(
        64, [](std::size_t i) { return detail::hoursColour((double(i) + 0.5) / 64.0); }, ticks);
    panel.gap(6);
    panel.row({}, "least", fmt::format("{:.2f} h", share(0)));
    panel.row({}, "median", fmt::format("{:.2f} h", share(0.5)));
    panel.row({}, "mean", fmt::format("{:.2f} h", mean));
    panel.row({}, "most", fmt::format("{:.2f} h", share(1)));
    panel.row({{214, 214, 218}}, "built over", "");
    panel.gap(8);
    panel.heading("What the figures rest on");
    panel.ledger(table.ledger);
  };
  return detail::besidePanel(view, write, [](Canvas& canvas, double scale) {
    // An arrow to the north of the frame.
    const double x = 30 * scale, y = 62 * scale;
    canvas.fillDisc({x, y - 14 * scale}, 27 * scale, {255, 255, 255}, 0.8);
    canvas.fillPolygon(
        std::vector<Vec2>{{x, y - 34 * scale}, {x + 8 * scale, y}, {x, y - 6 * scale}, {x - 8 * scale, y}},
        {198, 44, 44});
    canvas.text(x, y + 9 * scale, "N", {11 * scale, true}, detail::Align::centre);
  });
}

}  // namespace umbrage::report
