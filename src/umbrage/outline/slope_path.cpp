#include <algorithm>
#include <cmath>

#include "umbrage/base/check.hpp"
#include "umbrage/outline/envelope.hpp"

namespace umbrage::outline {
namespace {

using std::chrono::milliseconds;

// How far apart the sun's elevation is looked at; it cannot rise and set again within.
constexpr milliseconds kLook{300'000};
// What lies between samples of an arc at its quarters is at most 4/3 of the greatest of them where the arc is traversed evenly;
// twice is enough however it is.
constexpr double kBetweenSamples = 2.0;
constexpr int kDeepest = 24;

double fromSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length = glm::dot(ab, ab);
  const double t = length > 0.0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + t * ab));
}

class Follower {
 public:
  explicit Follower(const SweepPeriod& period) : period_(period) {}

  [[nodiscard]] bool isHigh(sun::Instant t) const {
    return sun::sunPosition(period_.place, t).elevation >= period_.leastElevation;
  }
  // The last moment of the kind of `inside`, to the millisecond.
  [[nodiscard]] sun::Instant border(sun::Instant inside, sun::Instant outside) const {
    while (std::chrono::abs(outside - inside) > milliseconds(1)) {
      const sun::Instant middle = inside + (outside - inside) / 2;
      (isHigh(middle) ? inside : outside) = middle;
    }
    return inside;
  }
  [[nodiscard]] SlopePath follow(sun::Instant from, sun::Instant to) const {
    SlopePath path{{slope(from)}, 0.0, from, to};
    if (from < to) extend(path, from, to, 0);
    return path;
  }

 private:
  [[nodiscard]] Vec2 slope(sun::Instant t) const {
    return shadowSlope(sun::sunPosition(period_.place, t), period_.north);
  }

  void extend(SlopePath& path, sun::Instant from, sun::Instant to, int depth) const {
    const Vec2 a = path.slopes.back(), b = slope(to);
    const auto quarter = (to - from) / 4;
    double off = 0.0;
    for (int k = 1; k < 4; ++k) off = std::max(off, fromSegment(slope(from + k * quarter), a, b));
    off *= kBetweenSamples;
    if (off <= period_.tolerance || depth == kDeepest || quarter < milliseconds(1)) {
      path.slopes.push_back(b);
      path.deviation = std::max(path.deviation, off);
      return;
    }
    extend(path, from, from + 2 * quarter, depth + 1);
    extend(path, from + 2 * quarter, to, depth + 1);
  }

  const SweepPeriod& period_;
};

}  // namespace

std::vector<SlopePath> slopePaths(const SweepPeriod& period) {
  UMBRAGE_CHECK(period.from < period.to, "an empty period");
  UMBRAGE_CHECK(period.leastElevation > Angle{} && period.tolerance > 0.0, "no end of shadows, or no tolerance");
  const Follower follower(period);
  std::vector<SlopePath> paths;
  bool wasHigh = false;
  sun::Instant since = period.from, before = period.from;
  for (sun::Instant t = period.from;; t = std::min(t + kLook, period.to)) {
    const bool high = follower.isHigh(t);
    if (high && !wasHigh) since = t == period.from ? t : follower.border(t, before);
    if (!high && wasHigh) paths.push_back(follower.follow(since, follower.border(before, t)));
    wasHigh = high;
    before = t;
    if (t == period.to) break;
  }
  if (wasHigh) paths.push_back(follower.follow(since, period.to));
  return paths;
}

}  // namespace umbrage::outline
