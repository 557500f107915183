#include "umbrage/cut/detail/cover.hpp"

#include <cmath>

namespace umbrage::cut::detail {
namespace {

// Of the casters over a point so many are tried.
constexpr int kTried = 8;

bool isHidden(const Casters& casters, const Face& face, const Vec3& point, std::int64_t& steps) {
  bool hidden = false;
  visitHiding(casters, face, point, steps, [&](std::uint32_t) {
    hidden = true;
    return false;
  });
  return hidden;
}

/// A plane that has to have a polygon on the same side as a point.
struct Wall {
  Vec3 normal, on;
};

bool holds(const Wall& wall, const Face& face, const Vec3& point, const Polygon& polygon) {
  const FaceFrame& f = face.frame;
  const double sign = glm::dot(wall.normal, point - wall.on) < 0.0 ? -1.0 : 1.0;
  const Vec3 line =
      sign * Vec3(glm::dot(wall.normal, f.e1), glm::dot(wall.normal, f.e2), glm::dot(wall.normal, f.origin - wall.on));
  const double nothing = face.tolerance * glm::length(Vec2(line));
  for (const Vec2& p : polygon)
    if (!(line.x * p.x + line.y * p.y + line.z >= -nothing)) return false;
  return true;
}

// Whether a caster that hides a point hides all of the polygon around it.
bool covers(const Casters& casters, std::uint32_t t, const Face& face, const Vec3& point, const Polygon& polygon) {
  const trace::Corners c = casters.corners(t);
  if (!holds({glm::cross(c.b - c.a, c.c - c.a), c.a}, face, point, polygon)) return false;
  const std::array<Vec3, 3> corners{c.a, c.b, c.c};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 towards = Vec3(casters.light) - corners[k] * casters.light.w;
    if (!holds({glm::cross(corners[(k + 1) % 3] - corners[k], towards), corners[k]}, face, point, polygon))
      return false;
  }
  return true;
}

}  // namespace

Vec3 innerPoint(const Face& face, const Polygon& polygon, int which) {
  constexpr double kGolden = 0.6180339887498949;
  Vec2 sum(0.0);
  double weights = 0.0, part = 0.31 * (1 + which);
  for (const Vec2& p : polygon) {
    part += kGolden, part -= std::floor(part);
    sum += (1.0 + part) * p, weights += 1.0 + part;
  }
  sum /= weights;
  return face.frame.origin + sum.x * face.frame.e1 + sum.y * face.frame.e2;
}

bool isHidden(const Casters& casters, const Face& face, const Polygon& polygon, std::int64_t& steps) {
  const bool first = isHidden(casters, face, innerPoint(face, polygon, 0), steps);
  const bool second = isHidden(casters, face, innerPoint(face, polygon, 1), steps);
  return first == second ? first : isHidden(casters, face, innerPoint(face, polygon, 2), steps);
}

bool isCovered(const Casters& casters, const Face& face, const Polygon& polygon, std::int64_t& steps) {
  const Vec3 point = innerPoint(face, polygon, 0);
  int tried = 0;
  bool covered = false;
  visitHiding(casters, face, point, steps, [&](std::uint32_t t) {
    covered = covers(casters, t, face, point, polygon);
    return !covered && ++tried < kTried;
  });
  return covered;
}

}  // namespace umbrage::cut::detail
