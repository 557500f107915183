#include "umbrage/study/hours_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "umbrage/study/exact_hours.hpp"

namespace umbrage::study {
namespace {

using namespace std::chrono_literals;

constexpr int kFirstYear = 1972, kLastYear = 2050;
constexpr int kMomentsPerTriangle = 40;
constexpr auto kBorder = 1s;  // nearer to a change light and shade are not asked for

// The point is the origin. `inward[i]` is normal to the plane through it and an edge, towards the triangle's inner side.
struct Triangle {
  std::array<Vec3, 3> corners;
  std::array<Vec3, 3> inward;
};

// Before, above or below the point, 10 to 30 m away, wide enough to matter on most days.
Triangle randomTriangle(std::mt19937& random) {
  const auto between = [&](double low, double high) { return low + (high - low) * (double(random()) / 4294967296.0); };
  const auto aside = [&] { return Vec3(between(-20, 20), between(-20, 20), between(-5, 25)); };
  const double turn = between(0.0, 360.0);
  const Vec3 middle = 15.0 * Vec3(cos(Angle::degrees(turn)), sin(Angle::degrees(turn)), 0.3);
  Triangle t;
  for (Vec3& corner : t.corners) corner = middle + aside();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 plane = glm::normalize(glm::cross(t.corners[i], t.corners[(i + 1) % 3]));
    t.inward[i] = glm::dot(plane, t.corners[(i + 2) % 3]) < 0.0 ? -plane : plane;
  }
  return t;
}

// A triangle that nearly holds the point in its plane is seen as a line: nothing to be timed.
bool isSeenAsLine(const Triangle& t) {
  const double volume = glm::dot(t.corners[0], glm::cross(t.corners[1], t.corners[2]));
  return std::abs(volume) < 200.0;
}

scene::Scene sceneOf(const Triangle& t) {
  mesh::Mesh m;
  m.positions.assign(t.corners.begin(), t.corners.end());
  m.triangles.push_back({0, 1, 2});
  scene::Scene scene;
  scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  scene.materials.emplace_back();
  scene.instances.push_back({.name = "triangle"});
  return scene;
}

Vec3 towardsSun(const sun::Place& place, sun::Instant t) {
  return sun::eastNorthUp(sun::sunPositionByObserver(place, t));
}

// How long the sun of ERFA passed the nearest edge (or the horizon) before this moment.
double secondsOff(const Triangle& triangle, const sun::Place& place, sun::Instant moment) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& plane) {
    const auto side = [&](sun::Instant t) { return glm::dot(plane, towardsSun(place, t)); };
    const double seconds = sun::secondsSinceZero(moment, side);
    if (std::abs(seconds) < std::abs(nearest)) nearest = seconds;
  };
  for (const Vec3& plane : triangle.inward) consider(plane);
  consider({0.0, 0.0, 1.0});
  return nearest;
}

bool isLit(const Triangle& triangle, const Vec3& sun) {
  const auto inside = [&](const Vec3& plane) { return glm::dot(plane, sun) > 0.0; };
  return sun.z > 0.0 && !std::all_of(triangle.inward.begin(), triangle.inward.end(), inside);
}

// Whether the exact hours say light; unknown within kBorder of a change or of the day's ends.
std::optional<bool> saidLit(std::span<const TimeSpan> lit, sun::Instant t) {
  for (const TimeSpan& span : lit) {
    if (std::chrono::abs(t - span.from) < kBorder || std::chrono::abs(t - span.to) < kBorder) return std::nullopt;
    if (span.from < t && t < span.to) return true;
  }
  return false;
}

void compare(const Triangle& triangle, const SunCourse& course, std::span<const TimeSpan> lit, HoursCheck& check) {
  const auto& [from, to] = course.span();
  for (const TimeSpan& span : lit)
    for (const sun::Instant change : {span.from, span.to})
      if (change != from && change != to)
        check.changes.add(secondsOff(triangle, course.place(), change), course.place(), change);
  for (int k = 0; k < kMomentsPerTriangle; ++k) {
    const sun::Instant t = from + (to - from) * (2 * k + 1) / (2 * kMomentsPerTriangle);
    const auto said = saidLit(lit, t);
    if (!said) continue;
    ++check.moments;
    if (*said != isLit(triangle, towardsSun(course.place(), t))) ++check.wrong;
  }
}

}  // namespace

Result<HoursCheck> checkHours(std::size_t triangles) {
  std::mt19937 random(1);
  HoursCheck check;
  for (std::size_t i = 0; check.triangles < triangles; ++i) {
    const Triangle triangle = randomTriangle(random);
    const auto [place, instant] = sun::spreadPlaceAndTime(i, kFirstYear, kLastYear);
    const SunCourse course = SunCourse::make(place, {instant, instant + 24h});
    if (isSeenAsLine(triangle)) continue;
    const auto hours = ExactHours::build(sceneOf(triangle), place, {.threads = 1});
    if (!hours) return tl::unexpected(hours.error());
    const Receiver point;
    const auto lit = hours->at(std::span(&point, 1), course);
    if (!lit) return tl::unexpected(lit.error());
    compare(triangle, course, lit->lit(0), check);
    ++check.triangles;
  }
  return check;
}

bool holds(const HoursCheck& check) { return check.wrong == 0 && check.changes.worst <= kChangeBound; }

}  // namespace umbrage::study
