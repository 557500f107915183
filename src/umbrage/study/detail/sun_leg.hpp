#pragma once

#include <cmath>
#include <vector>

namespace umbrage::study::detail {

/// A measure of an angle without trigonometry: monotone in it, -2 at -180 degrees, 0 at 0, 2 at 180.
[[nodiscard]] inline double pseudoAngle(double x, double y) {
  const double p = 1.0 - x / (std::abs(x) + std::abs(y));
  return y < 0.0 ? -p : p;
}
[[nodiscard]] inline double pseudoAngle(double angle) { return pseudoAngle(std::cos(angle), std::sin(angle)); }
/// The angle of a pseudo-angle in [-2, 2].
[[nodiscard]] inline double angleOf(double p) {
  const double x = 1.0 - std::abs(p), y = 1.0 - std::abs(x);
  return std::atan2(p < 0.0 ? -y : y, x);
}

/// The sun's height over the equator as rise + cosine cos h + sine sin h: a plane section of the sky's cone, right for about
/// [low, high] of the hour angle. In pseudo-angles.
struct SunArc {
  double rise, cosine, sine;
  double low, high;
};

/// One passage of the sun over the sky, in a right-handed frame fixed to the Earth: the first axis to the equator's highest point,
/// the second west, the third to the south pole. The direction to the sun is (cos h, sin h, height(h)) up to its length; h, its
/// angle about the axis, only grows.
struct SunLeg {
  static constexpr int kFewestArcs = 64, kMostArcs = 1024;
  static constexpr double kLongest = 5.0;  ///< radians
  double firstAngle, lastAngle;            ///< h in [-pi, pi]
  double firstTime, lastTime;              ///< seconds from the start of the course
  double first, last;                      ///< pseudo-angles of the ends
  SunArc whole;                            ///< for all of the leg,
  double wholeError;                       ///< the height no farther off than this
  /// Around the middles of equal parts of [first, last], and at least as wide; off by no more than kArcError. Refraction
  /// near the horizon takes many.
  std::vector<SunArc> arcs;

  /// The largest error of an arc, in radians; the sun takes 0.014 s for it.
  static constexpr double kArcError = 1e-6;

  struct Knot {
    double height, heightSlope, time, timeSlope;
  };
  std::vector<Knot> knots;  ///< at equal steps of h
  double knotStart, knotStep;

  double middleHeight = 0.0, heightRange = 0.0,
         steepest = 0.0;  ///< of all heights: the middle, and how far from the least to the greatest; the largest slope

  /// The same at equal steps of pseudo-angles, with slopes by h and by pseudo-angle, for use without trigonometry.
  static constexpr int kPseudoKnots = 512;  ///< per unit
  struct PseudoKnot {
    double height, heightPerPseudo, heightSlope, time, timePerPseudo;
  };
  std::vector<PseudoKnot> pseudoKnots;
  double pseudoStart = 0.0;
  struct Height {
    double height, slope;
  };
  /// At a pseudo-angle; kept within the leg.
  [[nodiscard]] Height heightAt(double pseudo) const {
    const auto [a, b, t] = pseudoCell(pseudo);
    return {hermite(a->height, b->height, a->heightPerPseudo, b->heightPerPseudo, t),
            a->heightSlope + t * (b->heightSlope - a->heightSlope)};
  }
  [[nodiscard]] double timeAt(double pseudo) const {
    const auto [a, b, t] = pseudoCell(pseudo);
    return hermite(a->time, b->time, a->timePerPseudo, b->timePerPseudo, t);
  }

  [[nodiscard]] double height(double h) const;
  [[nodiscard]] double heightSlope(double h) const;
  [[nodiscard]] double time(double h) const;
  [[nodiscard]] double timeSlope(double h) const;

 private:
  struct PseudoCell {
    const PseudoKnot *a, *b;
    double t;
  };
  [[nodiscard]] PseudoCell pseudoCell(double pseudo) const {
    // Beyond the leg the nearer end counts, round the pole where that is shorter.
    if (pseudo > last && pseudo - last > first + 4.0 - pseudo) pseudo = first;
    if (pseudo < first && first - pseudo > pseudo + 4.0 - last) pseudo = last;
    const double end = static_cast<double>(pseudoKnots.size() - 1) - 1e-9, at = (pseudo - pseudoStart) * kPseudoKnots;
    const double x = at < 0.0 ? 0.0 : at > end ? end : at;
    const auto i = static_cast<std::size_t>(x);
    return {&pseudoKnots[i], &pseudoKnots[i + 1], x - static_cast<double>(i)};
  }
  static double hermite(double a, double b, double slopeA, double slopeB, double t) {
    const double d = b - a, p = slopeA / kPseudoKnots, q = slopeB / kPseudoKnots;
    return a + t * (p + t * (3.0 * d - 2.0 * p - q + t * (p + q - 2.0 * d)));
  }
};

}  // namespace umbrage::study::detail
