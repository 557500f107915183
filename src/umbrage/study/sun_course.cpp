#include "umbrage/study/sun_course.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "umbrage/base/check.hpp"
#include "umbrage/study/detail/sun_leg.hpp"

namespace umbrage::study {
namespace {

using detail::SunArc;
using detail::SunLeg;
using std::chrono::milliseconds;

constexpr double kPi = std::numbers::pi;
constexpr milliseconds kSampleStep = std::chrono::minutes(10);
constexpr milliseconds kSampleMargin = std::chrono::minutes(120);
constexpr double kStepSeconds = 600.0, kMarginSeconds = 7200.0;

// Six samples, weighted by Lagrange's polynomials; `x` is the place among them, 2 <= x < 3.
Vec3 interpolate(const Vec3* samples, double x) {
  Vec3 sum(0.0);
  for (int i = 0; i < 6; ++i) {
    double weight = 1.0;
    for (int k = 0; k < 6; ++k)
      if (k != i) weight *= (x - k) / double(i - k);
    sum += weight * samples[i];
  }
  return glm::normalize(sum);
}

// Carries a direction towards the zenith.
Vec3 lifted(const Vec3& direction, Angle lift) {
  const double flat = std::hypot(direction.x, direction.y);
  const Angle elevation = Angle::radians(std::atan2(direction.z, flat)) + lift;
  if (flat == 0.0) return direction;
  const double scale = cos(elevation) / flat;
  return {direction.x * scale, direction.y * scale, sin(elevation)};
}

// The axes of SunLeg, in (east, north, up).
struct Axes {
  Vec3 first, west, south;
  explicit Axes(Angle latitude)
      : first(0.0, -sin(latitude), cos(latitude)), west(-1.0, 0.0, 0.0), south(0.0, -cos(latitude), -sin(latitude)) {}
};

// The heights h -> height are given at three angles; the plane section through them.
template <class Height>
SunArc sectionThrough(const Height& height, double middle, double half) {
  const double spread = half * std::sqrt(3.0) / 2.0;
  const double h[3] = {middle - spread, middle, middle + spread};
  const double y[3] = {height(h[0]), height(h[1]), height(h[2])};
  // In the angle from the middle the section is even and odd parts, which the outer two tell apart.
  const double odd = (y[2] - y[0]) / (2.0 * std::sin(spread));
  const double even = (y[1] - 0.5 * (y[0] + y[2])) / (1.0 - std::cos(spread));
  const double c = std::cos(middle), s = std::sin(middle);
  return {y[1] - even, even * c - odd * s, even * s + odd * c, 0.0, 0.0};
}

template <class Height>
double largestError(const SunArc& arc, const Height& height, double low, double high, int probes) {
  double largest = 0.0;
  for (int i = 0; i <= probes; ++i) {
    const double h = low + (high - low) * i / probes;
    largest = std::max(largest, std::abs(arc.rise + arc.cosine * std::cos(h) + arc.sine * std::sin(h) - height(h)));
  }
  return largest;
}

// Towards a sun of this declination at the true sun's hour angle.
Vec3 kept(const sun::Place& place, sun::Instant instant, Angle declination) {
  const Angle h = sun::hourAngle(place, instant);
  const double sinLatitude = sin(place.latitude), cosLatitude = cos(place.latitude);
  const double sinDeclination = sin(declination), cosDeclination = cos(declination);
  return {-cosDeclination * sin(h), sinDeclination * cosLatitude - cosDeclination * cos(h) * sinLatitude,
          sinDeclination * sinLatitude + cosDeclination * cos(h) * cosLatitude};
}

double bounded(double h) { return std::clamp(h, -kPi, kPi); }

}  // namespace

// ---- the legs

struct CourseMaker {
  SunCourse& course;
  Axes axes;

  double seconds(sun::Instant instant) const { return double((instant - course.span_.from).count()) / 1000.0; }
  sun::Instant instant(double seconds) const {
    return course.span_.from + milliseconds(std::llround(seconds * 1000.0));
  }
  double elevation(double t) const { return course.at(t).z; }
  double angle(double t) const {
    const Vec3 s = course.at(t);
    return std::atan2(glm::dot(s, axes.west), glm::dot(s, axes.first));
  }
  double height(double t) const {
    const Vec3 s = course.at(t);
    return glm::dot(s, axes.south) / std::hypot(glm::dot(s, axes.first), glm::dot(s, axes.west));
  }

  // Where the sign of the elevation changes between a and b.
  double crossing(double a, double b) const {
    const bool upAtA = elevation(a) > 0.0;
    for (int i = 0; i < 48 && b - a > 1e-6; ++i) {
      const double middle = 0.5 * (a + b);
      (elevation(middle) > 0.0 ? upAtA : !upAtA) ? a = middle : b = middle;
    }
    return 0.5 * (a + b);
  }

  // The time in [a, b] of the highest or lowest sun there.
  double extreme(double a, double b, double sign) const {
    constexpr double kGolden = 0.6180339887498949;
    for (int i = 0; i < 40; ++i) {
      const double l = b - kGolden * (b - a), r = a + kGolden * (b - a);
      sign* elevation(l) > sign* elevation(r) ? b = r : a = l;
    }
    return 0.5 * (a + b);
  }

  // All changes of sign in the span; between samples the sun may come up, or go down, and back again.
  std::vector<double> horizonTimes() const {
    const double end = seconds(course.span_.to);
    const int steps = std::max(3, static_cast<int>(std::ceil(end / kStepSeconds)));
    std::vector<double> times;
    for (int i = 0; i <= steps; ++i) times.push_back(end * i / steps);
    std::vector<double> probes{times.front()};
    for (int i = 1; i <= steps; ++i) {
      const double a = times[i - 1], b = times[i], low = elevation(a), high = elevation(b);
      if ((low > 0.0) == (high > 0.0) && std::min(std::abs(low), std::abs(high)) < 0.01)
        probes.push_back(extreme(a, b, low > 0.0 ? -1.0 : 1.0));
      probes.push_back(b);
    }
    std::vector<double> crossings;
    for (std::size_t i = 1; i < probes.size(); ++i)
      if ((elevation(probes[i - 1]) > 0.0) != (elevation(probes[i]) > 0.0))
        crossings.push_back(crossing(probes[i - 1], probes[i]));
    return crossings;
  }

  // When the sun passes under the pole within (from, to).
  std::vector<double> wraps(double from, double to) const {
    std::vector<double> found;
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / kStepSeconds)));
    for (int i = 0; i < steps; ++i) {
      double a = from + (to - from) * i / steps, b = from + (to - from) * (i + 1) / steps;
      if (!(angle(a) > 2.0 && angle(b) < -2.0)) continue;
      while (b - a > 1e-6) {
        const double middle = 0.5 * (a + b);
        (angle(middle) > 0.0 ? a : b) = middle;
      }
      found.push_back(b);
    }
    return found;
  }

  // The time near `t` at which the sun is at the angle h, which may lie beyond +-pi.
  double timeOf(double h, double t) const {
    for (int i = 0; i < 6; ++i) {
      const double slope = std::remainder(angle(t + 5.0) - angle(t - 5.0), 2.0 * kPi) / 10.0;
      const double step = std::remainder(h - angle(t), 2.0 * kPi) / slope;
      t += step;
      if (std::abs(step) < 1e-7) break;
    }
    return t;
  }

  SunLeg::Knot knotAt(double h, double near) const {
    constexpr double kSide = 10.0;
    const double t = timeOf(h, near);
    const double turn = std::remainder(angle(t + kSide) - angle(t - kSide), 2.0 * kPi);
    return {height(t), (height(t + kSide) - height(t - kSide)) / turn, t, 2.0 * kSide / turn};
  }

  SunLeg leg(double from, double to, bool wrapsAtStart, bool wrapsAtEnd) const {
    constexpr int kKnots = 512;
    constexpr double kBeyond = 0.02;  // radians, so that tables by pseudo-angle may end beyond the leg
    SunLeg leg;
    leg.firstTime = from, leg.lastTime = to;
    leg.firstAngle = wrapsAtStart ? -kPi : angle(from);
    leg.lastAngle = wrapsAtEnd ? kPi : angle(to);
    leg.first = wrapsAtStart ? -2.0 : detail::pseudoAngle(leg.firstAngle);
    leg.last = wrapsAtEnd ? 2.0 : detail::pseudoAngle(leg.lastAngle);
    leg.knotStep = (leg.lastAngle - leg.firstAngle + 2.0 * kBeyond) / kKnots;
    leg.knotStart = leg.firstAngle - kBeyond;
    double near = timeOf(leg.knotStart, from);
    for (int i = 0; i <= kKnots; ++i) {
      leg.knots.push_back(knotAt(leg.knotStart + i * leg.knotStep, near));
      near = leg.knots.back().time + leg.knots.back().timeSlope * leg.knotStep;
    }
    fillPseudoKnots(leg);
    fitArcs(leg);
    return leg;
  }

  // The knots are the same for all legs, so that the kinks of the pseudo-angle at the quarters fall on some.
  static void fillPseudoKnots(SunLeg& leg) {
    constexpr double kStep = 1.0 / SunLeg::kPseudoKnots;
    leg.pseudoStart = std::floor(leg.first / kStep) * kStep;
    const int cells = static_cast<int>(std::ceil((leg.last - leg.pseudoStart) / kStep));
    double least = leg.height(leg.firstAngle), most = least;
    for (int i = 0; i <= std::max(cells, 1); ++i) {
      const double p = leg.pseudoStart + i * kStep, within = std::clamp(p, -2.0, 2.0), h = detail::angleOf(within);
      // With |x| + |y| = 1 in each quarter, dh = dp / (x^2 + y^2).
      const double x = 1.0 - std::abs(within), y = 1.0 - std::abs(x), perPseudo = 1.0 / (x * x + y * y);
      const double slope = leg.heightSlope(h), height = leg.height(h);
      leg.pseudoKnots.push_back({height, slope * perPseudo, slope, leg.time(h), leg.timeSlope(h) * perPseudo});
      least = std::min(least, height), most = std::max(most, height);
      leg.steepest = std::max(leg.steepest, std::abs(slope));
    }
    leg.middleHeight = 0.5 * (least + most), leg.heightRange = most - least;
  }

  void fitArcs(SunLeg& leg) const {
    const auto height = [&](double h) { return leg.height(h); };
    const double all = leg.lastAngle - leg.firstAngle;
    leg.whole = sectionThrough(height, 0.5 * (leg.firstAngle + leg.lastAngle), std::max(0.5 * all, 1e-3));
    leg.whole.low = leg.first, leg.whole.high = leg.last;
    leg.wholeError = 1.05 * largestError(leg.whole, height, leg.firstAngle, leg.lastAngle, 256) + 1e-7;
    for (int count = SunLeg::kFewestArcs; !fitArcs(leg, count) && count < SunLeg::kMostArcs;) count *= 2;
  }

  // False when parts as narrow as one of `count` are not met.
  static bool fitArcs(SunLeg& leg, int count) {
    const auto height = [&](double h) { return leg.height(h); };
    const double all = leg.lastAngle - leg.firstAngle;
    leg.arcs.clear();
    bool fine = true;
    for (int i = 0; i < count; ++i) {
      const auto edge = [&](double k) { return detail::angleOf(leg.first + (leg.last - leg.first) * k / count); };
      const double middle = edge(i + 0.5);
      SunArc arc{};
      for (double half = std::max(all, 1e-3);; half *= 0.75) {
        const double low = std::max(std::min(middle - half, edge(i)), leg.firstAngle);
        const double high = std::min(std::max(middle + half, edge(i + 1.0)), leg.lastAngle);
        arc = sectionThrough(height, 0.5 * (low + high), std::max(0.5 * (high - low), 1e-5));
        arc.low = low <= leg.firstAngle ? leg.first : detail::pseudoAngle(bounded(low));
        arc.high = high >= leg.lastAngle ? leg.last : detail::pseudoAngle(bounded(high));
        if (largestError(arc, height, low, high, 16) <= SunLeg::kArcError) break;
        if (middle - half > edge(i)) {
          fine = false;
          break;
        }
      }
      leg.arcs.push_back(arc);
    }
    return fine;
  }

  void make() {
    std::vector<SunLeg> legs;
    const double end = seconds(course.span_.to);
    std::vector<double> changes = horizonTimes();
    bool up = elevation(0.0) > 0.0;
    double from = 0.0;
    changes.push_back(end);
    for (const double change : changes) {
      if (up && instant(change) > instant(from)) {
        course.up_.push_back({instant(from), instant(change)});
        addLegs(from, change, legs);
      }
      up = !up;
      from = change;
    }
    course.legs_ = std::make_shared<const std::vector<SunLeg>>(std::move(legs));
  }

  // Cut where the sun passes under the pole, and in the middle where that leaves too long a leg.
  void addLegs(double from, double to, std::vector<SunLeg>& legs) const {
    std::vector<double> cuts = wraps(from, to);
    cuts.push_back(to);
    double begin = from;
    for (const double cut : cuts) {
      const bool under = begin != from, wrapsAtEnd = cut != to;
      if (cut - begin > 1e-3) addLeg(begin, cut, under, wrapsAtEnd, legs);
      begin = cut;
    }
  }

  void addLeg(double from, double to, bool wrapsAtStart, bool wrapsAtEnd, std::vector<SunLeg>& legs) const {
    const double first = wrapsAtStart ? -kPi : angle(from), last = wrapsAtEnd ? kPi : angle(to);
    if (last - first <= SunLeg::kLongest) {
      legs.push_back(leg(from, to, wrapsAtStart, wrapsAtEnd));
      return;
    }
    const double middle = timeOf(0.5 * (first + last), 0.5 * (from + to));
    legs.push_back(leg(from, middle, wrapsAtStart, false));
    legs.push_back(leg(middle, to, false, wrapsAtEnd));
  }
};

// ---- tables

namespace detail {
namespace {

// Hermite's cubic over [0, 1] with slopes per step.
double cubic(double a, double b, double slopeA, double slopeB, double x) {
  const double d = b - a;
  return a + x * (slopeA + x * (3.0 * d - 2.0 * slopeA - slopeB + x * (slopeA + slopeB - 2.0 * d)));
}
double cubicSlope(double a, double b, double slopeA, double slopeB, double x) {
  const double d = b - a;
  return slopeA + x * (2.0 * (3.0 * d - 2.0 * slopeA - slopeB) + x * 3.0 * (slopeA + slopeB - 2.0 * d));
}

// The knot before h, and how far beyond it; h is kept within the table.
struct Cell {
  const SunLeg::Knot *a, *b;
  double x;
};
Cell cellOf(const SunLeg& leg, double h) {
  const double at = std::clamp((h - leg.knotStart) / leg.knotStep, 0.0, double(leg.knots.size() - 1) - 1e-9);
  const auto i = static_cast<std::size_t>(at);
  return {&leg.knots[i], &leg.knots[i + 1], at - double(i)};
}

}  // namespace

double SunLeg::height(double h) const {
  const auto [a, b, x] = cellOf(*this, h);
  return cubic(a->height, b->height, a->heightSlope * knotStep, b->heightSlope * knotStep, x);
}
double SunLeg::heightSlope(double h) const {
  const auto [a, b, x] = cellOf(*this, h);
  return cubicSlope(a->height, b->height, a->heightSlope * knotStep, b->heightSlope * knotStep, x) / knotStep;
}
double SunLeg::timeSlope(double h) const {
  const auto [a, b, x] = cellOf(*this, h);
  return cubicSlope(a->time, b->time, a->timeSlope * knotStep, b->timeSlope * knotStep, x) / knotStep;
}
double SunLeg::time(double h) const {
  const auto [a, b, x] = cellOf(*this, h);
  return cubic(a->time, b->time, a->timeSlope * knotStep, b->timeSlope * knotStep, x);
}

}  // namespace detail

// ---- the course

Angle declinationAt(sun::Instant instant) {
  // At a pole the elevation is the declination, but for the parallax.
  constexpr Angle kParallax = Angle::degrees(8.794143 / 3600.0);
  const Angle seen = sun::sunPosition({Angle::degrees(90.0), Angle{}}, instant).elevation;
  return seen + kParallax * cos(seen);
}

Vec3 SunCourse::at(double secondsFromStart) const {
  const double x = (secondsFromStart + kMarginSeconds) / kStepSeconds;
  const double cell = std::clamp(std::floor(x), 2.0, double(samples_.size()) - 4.0);
  const Vec3 centre = interpolate(samples_.data() + static_cast<std::size_t>(cell) - 2, x - cell + 2.0);
  if (model_.point == SunPoint::centre && model_.refraction == sun::Refraction::none) return centre;
  Angle lift = model_.point == SunPoint::upperLimb ? kSemiDiameter : Angle{};
  const Angle elevation = Angle::radians(std::asin(std::clamp(centre.z, -1.0, 1.0))) + lift;
  if (model_.refraction == sun::Refraction::standard) lift = lift + sun::refractionAt(elevation);
  return lifted(centre, lift);
}

Vec3 SunCourse::towards(sun::Instant instant) const { return at(double((instant - span_.from).count()) / 1000.0); }

milliseconds SunCourse::upTime() const {
  milliseconds sum{0};
  for (const TimeSpan& s : up_) sum += s.length();
  return sum;
}

SunCourse SunCourse::make(const sun::Place& place, const TimeSpan& span, const SunModel& model) {
  UMBRAGE_CHECK(span.from < span.to, "the sun's course needs a stretch of time");
  SunCourse course;
  course.place_ = place, course.span_ = span, course.model_ = model;
  for (sun::Instant t = span.from - kSampleMargin; t <= span.to + kSampleMargin; t += kSampleStep)
    course.samples_.push_back(model.declination ? kept(place, t, *model.declination)
                                                : sun::eastNorthUp(sun::sunPosition(place, t)));
  CourseMaker{course, Axes(place.latitude)}.make();
  return course;
}

}  // namespace umbrage::study
