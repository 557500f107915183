#pragma once

#include <cmath>
#include <compare>
#include <numbers>

namespace umbrage {

/// A plane angle that says its unit where it is made and where it is read.
class Angle {
 public:
  constexpr Angle() = default;
  static constexpr Angle radians(double value) { return Angle(value); }
  static constexpr Angle degrees(double value) { return Angle(value * std::numbers::pi / 180.0); }

  [[nodiscard]] constexpr double radians() const { return radians_; }
  [[nodiscard]] constexpr double degrees() const { return radians_ * 180.0 / std::numbers::pi; }
  /// The same direction in [0, 360) degrees.
  [[nodiscard]] Angle wrapped() const {
    const double turn = 2.0 * std::numbers::pi;
    const double rest = std::fmod(radians_, turn);
    return Angle(rest < 0.0 ? rest + turn : rest);
  }

  friend constexpr Angle operator+(Angle a, Angle b) { return Angle(a.radians_ + b.radians_); }
  friend constexpr Angle operator-(Angle a, Angle b) { return Angle(a.radians_ - b.radians_); }
  friend constexpr Angle operator-(Angle a) { return Angle(-a.radians_); }
  friend constexpr Angle operator*(Angle a, double s) { return Angle(a.radians_ * s); }
  friend constexpr Angle operator*(double s, Angle a) { return a * s; }
  friend constexpr auto operator<=>(Angle, Angle) = default;

 private:
  explicit constexpr Angle(double value) : radians_(value) {}
  double radians_ = 0.0;
};

inline double sin(Angle a) { return std::sin(a.radians()); }
inline double cos(Angle a) { return std::cos(a.radians()); }
inline double tan(Angle a) { return std::tan(a.radians()); }

}  // namespace umbrage
