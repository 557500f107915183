#include "umbrage/study/detail/hours_solve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace umbrage::study::detail {
namespace {

constexpr double kPi = std::numbers::pi;

// A direction about the axis, and Newton's steps on it without trigonometry; good where the sun does not rake along the
// plane.
struct Turn {
  double c, s;
  [[nodiscard]] double pseudo() const { return pseudoAngle(c, s); }
  void polish(const SunLeg& leg, const Vec3& plane) {
    for (int i = 0; i < 5; ++i) {
      const SunLeg::Height at = leg.heightAt(pseudo());
      const double step =
          -(plane.x * c + plane.y * s + plane.z * at.height) / (plane.y * c - plane.x * s + plane.z * at.slope);
      const double turnedC = c - s * step, turnedS = s + c * step, scale = 1.0 / std::sqrt(1.0 + step * step);
      c = turnedC * scale, s = turnedS * scale;
      if (std::abs(step) < 1e-6) return;  // each step squares the error
    }
  }
};

struct Side {
  const SunLeg& leg;
  const Vec3& plane;

  [[nodiscard]] double value(double h) const {
    return plane.x * std::cos(h) + plane.y * std::sin(h) + plane.z * leg.height(h);
  }
  [[nodiscard]] double slope(double h) const {
    return plane.y * std::cos(h) - plane.x * std::sin(h) + plane.z * leg.heightSlope(h);
  }

  // Newton's steps, kept between two angles where the value has different signs.
  [[nodiscard]] double root(double a, double b) const {
    const bool rises = value(a) < 0.0;
    double h = 0.5 * (a + b);
    for (int i = 0; i < 60 && b - a > 1e-10; ++i) {
      const double f = value(h);
      ((f < 0.0) == rises ? a : b) = h;
      const double next = h - f / slope(h);
      if (std::abs(next - h) < 1e-11) return next;
      h = next > a && next < b ? next : 0.5 * (a + b);
    }
    return h;
  }

  // Between two angles of one arc, where the value is near to that of a plane section: its roots.
  [[nodiscard]] std::vector<double> roots(const SunArc& arc, double first, double last) const {
    const double b = plane.x + plane.z * arc.cosine, c = plane.y + plane.z * arc.sine, radius = std::hypot(b, c);
    std::vector<double> cuts{first};
    const auto addExtreme = [&](double h, double sign) {
      h += 2.0 * kPi * std::ceil((first - h) / (2.0 * kPi));
      if (h < last && radius > 0.0) cuts.push_back(std::clamp(h + sign * slope(h) / radius, first, last));
    };
    const double top = std::atan2(c, b);
    addExtreme(top, 1.0), addExtreme(top + kPi, -1.0);
    std::sort(cuts.begin(), cuts.end());
    cuts.push_back(last);
    std::vector<double> found;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      if ((value(cuts[i]) < 0.0) != (value(cuts[i + 1]) < 0.0)) found.push_back(root(cuts[i], cuts[i + 1]));
    return found;
  }
};

// The leg's arcs in turn, each from where the last one ends.
template <class Fn>
void overArcs(const SunLeg& leg, Fn&& fn) {
  const double scale = double(leg.arcs.size()) / (leg.last - leg.first);
  for (double from = leg.first; from < leg.last;) {
    std::size_t i = std::min(static_cast<std::size_t>((from - leg.first) * scale), leg.arcs.size() - 1);
    while (i + 1 < leg.arcs.size() && leg.arcs[i + 1].low <= from) ++i;
    const double to = std::min(std::max(leg.arcs[i].high, from + 0.5 / scale), leg.last);
    fn(leg.arcs[i], from, to);
    from = to;
  }
}

Stretches byArcs(const SunLeg& leg, const Vec3& plane) {
  const Side side{leg, plane};
  Stretches out;
  bool inside = side.value(leg.firstAngle) >= 0.0;
  double begin = leg.first;
  overArcs(leg, [&](const SunArc& arc, double from, double to) {
    const double a = from <= leg.first ? leg.firstAngle : angleOf(from);
    for (const double h : side.roots(arc, a, to >= leg.last ? leg.lastAngle : angleOf(to))) {
      const double p = pseudoAngle(h);
      if (inside) out.emplace_back(begin, p);
      inside = !inside, begin = p;
    }
  });
  if (inside) out.emplace_back(begin, leg.last);
  return out;
}

// Where the sun meets the plane at less than this sine, roots are looked for arc by arc.
constexpr double kRaking2 = 0.002;

}  // namespace

Stretches stretchesInside(const SunLeg& leg, const Vec3& plane) {
  const double middle = plane.z * leg.middleHeight, radius2 = plane.x * plane.x + plane.y * plane.y;
  const double d2 = radius2 - middle * middle;
  const double raking =
      (kRaking2 + leg.heightRange + 4.0 * leg.steepest * leg.steepest) * (radius2 + plane.z * plane.z);
  if (d2 < -raking) return middle > 0.0 ? Stretches{{leg.first, leg.last}} : Stretches{};
  if (!(d2 > raking)) return byArcs(leg, plane);
  const double d = std::sqrt(d2), scale = 1.0 / radius2;
  Turn rise{(-middle * plane.x + plane.y * d) * scale, (-middle * plane.y - plane.x * d) * scale};
  Turn set{(-middle * plane.x - plane.y * d) * scale, (-middle * plane.y + plane.x * d) * scale};
  rise.polish(leg, plane), set.polish(leg, plane);
  const double from = rise.pseudo(), to = set.pseudo();
  Stretches out;
  const auto keep = [&](double a, double b) {
    a = std::max(a, leg.first), b = std::min(b, leg.last);
    if (a < b) out.emplace_back(a, b);
  };
  if (from <= to) {
    keep(from, to);
  } else {
    keep(leg.first, to), keep(from, leg.last);
  }
  return out;
}

bool hoursInside(const SunLeg& leg, const SunArc& arc, const Vec3& plane, double first, double last, float& from,
                 float& to) {
  const Side side{leg, plane};
  const double a = first <= leg.first ? leg.firstAngle : angleOf(first);
  const std::vector<double> roots = side.roots(arc, a, last >= leg.last ? leg.lastAngle : angleOf(last));
  const auto pseudo = [&](std::size_t i) { return float(pseudoAngle(roots[i])); };
  from = -4.0f, to = 4.0f;
  if (side.value(a) >= 0.0) {
    if (!roots.empty()) to = pseudo(0);
    if (roots.size() > 1) from = pseudo(1);  // a gap
    return true;
  }
  if (roots.empty()) return false;
  from = pseudo(0);
  if (roots.size() > 1) to = pseudo(1);
  return true;
}

}  // namespace umbrage::study::detail
