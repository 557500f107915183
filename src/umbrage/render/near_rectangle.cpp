#include "umbrage/render/near_rectangle.hpp"

#include <cmath>

namespace umbrage::render {
namespace {

// Sine of the least angle between the light and the rectangle.
constexpr double kLeastSine = 0.02;
// A light nearer than this many distances of the rectangle is too near.
constexpr double kLeastDistances = 64.0;
// Casters are lost only within this share of the way from the light.
constexpr double kNearLight = 0x1p-20;
constexpr double kMargin = 1.25;

Vec4 row(const View& view, int r) { return {view.toClip[0][r], view.toClip[1][r], view.toClip[2][r], 0.0}; }

}  // namespace

double nearRectangleDistance(const View& view, double radius) {
  const double x = glm::length(row(view, 0)), y = glm::length(row(view, 1));
  return radius / std::sqrt(1.0 + 1.0 / (x * x) + 1.0 / (y * y));
}

std::optional<Mat4> throughNearRectangle(const View& view, double distance, const Vec4& light, double reach) {
  const Vec4 across = row(view, 0), up = row(view, 1), forward = row(view, 3), one(0, 0, 0, 1);
  const Vec4 l(Vec3(light), 0.0);
  const double along = glm::dot(forward, l), size = glm::length(l);
  Vec4 share, depth;  // rows: the divisor, and what is 0 at the rectangle and grows towards the light
  Vec4 x, y;
  if (light.w == 0.0) {
    if (std::abs(along) <= kLeastSine * size) return std::nullopt;
    const Vec4 way = (forward - distance * one) / along;  // from the rectangle to the point, in units of the direction
    share = one;
    depth = way * (size / (2.0 * (reach + distance)));
    x = across - glm::dot(across, l) * way;
    y = up - glm::dot(up, l) * way;
  } else {
    if (std::abs(distance - along) <= kLeastSine * size || size <= kLeastDistances * distance) return std::nullopt;
    share = (forward - along * one) / (distance - along);  // 0 at the light, 1 at the rectangle
    depth = kNearLight * (one - share);
    x = across + glm::dot(across, l) * (share - one);
    y = up + glm::dot(up, l) * (share - one);
  }
  return glm::transpose(Mat4(x / distance, y / distance, depth, share));
}

void appendSeen(const Mat4& fromLight, const std::array<Vec3, 3>& corners, std::vector<Vec4f>& out) {
  std::vector<Vec4> polygon;
  for (const Vec3& c : corners) polygon.push_back(fromLight * Vec4(c, 1.0));
  // A little more than the picture, whose border is no edge of anything.
  const std::array<Vec4, 6> inside{Vec4(0, 0, 1, 0),        Vec4(0, 0, -1, 1),      Vec4(1, 0, 0, kMargin),
                                   Vec4(-1, 0, 0, kMargin), Vec4(0, 1, 0, kMargin), Vec4(0, -1, 0, kMargin)};
  for (const Vec4& plane : inside) {
    std::vector<Vec4> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec4& a = polygon[i];
      const Vec4& b = polygon[(i + 1) % polygon.size()];
      const double atA = glm::dot(plane, a), atB = glm::dot(plane, b);
      if (atA >= 0.0) kept.push_back(a);
      if ((atA >= 0.0) != (atB >= 0.0)) kept.push_back(a + atA / (atA - atB) * (b - a));
    }
    polygon = std::move(kept);
  }
  const auto vertex = [&](std::size_t i) { return Vec4f(Vec2f(Vec2(polygon[i]) / polygon[i].w), 0.5f, 1.0f); };
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    out.push_back(vertex(0));
    out.push_back(vertex(i - 1));
    out.push_back(vertex(i));
  }
}

}  // namespace umbrage::render
