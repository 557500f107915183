#include "umbrage/study/detail/hours_solve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace umbrage::study::detail {
namespace {

constexpr double kPi = std::numbers::pi;

struct Side {
  const SunLeg& leg;
  const Vec3& plane;

  static double wrapped(double h) { return std::remainder(h, 2.0 * kPi); }
  [[nodiscard]] double value(double h) const {
    return plane.x * std::cos(h) + plane.y * std::sin(h) + plane.z * leg.height(wrapped(h));
  }
  [[nodiscard]] double slope(double h) const {
    return plane.y * std::cos(h) - plane.x * std::sin(h) + plane.z * leg.heightSlope(wrapped(h));
  }

  // Newton's steps, kept between an angle where the value is negative and one where it is not.
  [[nodiscard]] double root(double negative, double positive, double h) const {
    for (int i = 0; i < 60; ++i) {
      if (!((h - negative) * (h - positive) < 0.0)) h = 0.5 * (negative + positive);
      const double f = value(h);
      (f < 0.0 ? negative : positive) = h;
      const double next = h - f / slope(h);
      if (std::abs(next - h) < 1e-10 || std::abs(negative - positive) < 1e-10) return std::isfinite(next) ? next : h;
      h = next;
    }
    return h;
  }
};

SideHours hoursInsideWithin(const SunLeg& leg, const Vec3& plane) {
  const double radius = std::hypot(plane.x, plane.y);
  const Side side{leg, plane};
  if (!(radius > 0.0)) return {side.value(0.0) >= 0.0 ? SideHours::Kind::always : SideHours::Kind::never, 0.0, 0.0};
  // Highest near the plane's own angle, lowest opposite; the sun's drift in height shifts both a little.
  const double top = std::atan2(plane.y, plane.x), bottom = top + kPi;
  const double highest = top + plane.z * leg.heightSlope(Side::wrapped(top)) / radius;
  const double lowest = bottom - plane.z * leg.heightSlope(Side::wrapped(bottom)) / radius;
  if (side.value(highest) < 0.0) return {SideHours::Kind::never, 0.0, 0.0};
  if (side.value(lowest) >= 0.0) return {SideHours::Kind::always, 0.0, 0.0};
  const double half = std::acos(std::clamp(-plane.z * leg.height(Side::wrapped(top)) / radius, -1.0, 1.0));
  const double rise = side.root(lowest - 2.0 * kPi, highest, top - half), set = side.root(lowest, highest, top + half);
  return {SideHours::Kind::between, pseudoAngle(rise), pseudoAngle(set)};
}

// A direction about the axis, and Newton's steps on it without trigonometry; good where the sun does not rake along the plane.
struct Turn {
  double c, s;
  [[nodiscard]] double pseudo() const { return pseudoAngle(c, s); }
  void polish(const SunLeg& leg, const Vec3& plane) {
    for (int i = 0; i < 4; ++i) {
      const SunLeg::Height at = leg.heightAt(pseudo());
      const double step =
          -(plane.x * c + plane.y * s + plane.z * at.height) / (plane.y * c - plane.x * s + plane.z * at.slope);
      const double turnedC = c - s * step, turnedS = s + c * step, scale = 1.0 / std::sqrt(1.0 + step * step);
      c = turnedC * scale, s = turnedS * scale;
      if (std::abs(step) < 1e-6) return;  // each step squares the error
    }
  }
};

// Where the sun meets the plane at less than this sine, the roots are looked for within brackets.
constexpr double kRaking2 = 0.002;

}  // namespace

SideHours hoursInside(const SunLeg& leg, const Vec3& plane) {
  const double middle = plane.z * leg.middleHeight, radius2 = plane.x * plane.x + plane.y * plane.y;
  const double d2 = radius2 - middle * middle, raking = (kRaking2 + leg.heightRange) * (radius2 + plane.z * plane.z);
  if (d2 < -raking) return {middle > 0.0 ? SideHours::Kind::always : SideHours::Kind::never, 0.0, 0.0};
  if (!(d2 > raking)) return hoursInsideWithin(leg, plane);
  const double d = std::sqrt(d2), scale = 1.0 / radius2;
  Turn rise{(-middle * plane.x + plane.y * d) * scale, (-middle * plane.y - plane.x * d) * scale};
  Turn set{(-middle * plane.x - plane.y * d) * scale, (-middle * plane.y + plane.x * d) * scale};
  rise.polish(leg, plane), set.polish(leg, plane);
  return {SideHours::Kind::between, rise.pseudo(), set.pseudo()};
}

}  // namespace umbrage::study::detail
