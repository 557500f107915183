#include "umbrage/render/seen_receivers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace umbrage::render {
namespace {

constexpr int kColumns = 48, kRows = 27;  ///< of the coarse grid
constexpr double kNone = std::numeric_limits<double>::infinity();

double heightOver(const HalfSpace& h, const Vec3& p) { return glm::dot(Vec3(h), p) + h.w; }

// The borders of the picture and the plane of the eye.
std::array<HalfSpace, 5> bordersOf(const View& view) {
  const auto row = [&](int r) { return Vec4(view.toClip[0][r], view.toClip[1][r], view.toClip[2][r], 0.0); };
  return {row(3) - row(0), row(3) + row(0), row(3) - row(1), row(3) + row(1), row(3)};
}

// The nearest triangle at each point of the grid.
class Grid {
 public:
  Grid(const View& view, const scene::Camera& camera)
      : view_(view), rays_(scene::pixelRays(camera)), width_(camera.width), height_(camera.height) {}

  // A triangle and what is left of it inside the picture.
  void add(std::uint32_t triangle, const Vec3& a, const Vec3& normal, std::span<const Vec3> polygon) {
    double left = kNone, right = -kNone, top = kNone, bottom = -kNone;
    for (const Vec3& p : polygon) {
      const Vec4 clip = view_.toClip * Vec4(p, 1.0);
      if (!(clip.w > 0.0)) return addAt(0, kColumns - 1, 0, kRows - 1, triangle, a, normal, polygon);
      left = std::min(left, clip.x / clip.w), right = std::max(right, clip.x / clip.w);
      top = std::min(top, -clip.y / clip.w), bottom = std::max(bottom, -clip.y / clip.w);
    }
    const auto first = [](double ndc, int cells) {
      return std::clamp(int(std::ceil((0.5 + 0.5 * ndc) * cells - 0.5 - 1e-9)), 0, cells);
    };
    const auto last = [](double ndc, int cells) {
      return std::clamp(int(std::floor((0.5 + 0.5 * ndc) * cells - 0.5 + 1e-9)), -1, cells - 1);
    };
    addAt(first(left, kColumns), last(right, kColumns), first(top, kRows), last(bottom, kRows), triangle, a, normal,
          polygon);
  }

  [[nodiscard]] std::vector<ViewSample> samples() const {
    std::vector<ViewSample> out;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x)
        if (distance_[at(x, y)] < kNone) out.push_back({pixel(x, y), triangle_[at(x, y)]});
    return out;
  }

 private:
  static std::size_t at(int x, int y) { return static_cast<std::size_t>(y * kColumns + x); }
  [[nodiscard]] Vec2 pixel(int x, int y) const { return {(x + 0.5) * width_ / kColumns, (y + 0.5) * height_ / kRows}; }

  void addAt(int left, int right, int top, int bottom, std::uint32_t triangle, const Vec3& a, const Vec3& normal,
             std::span<const Vec3> polygon) {
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const Vec2 where = pixel(x, y);
        const Vec3 ray = rays_.through(where.x, where.y);
        const double along = glm::dot(normal, ray), distance = along != 0.0 ? glm::dot(normal, a) / along : kNone;
        if (!(distance > 0.0 && distance < distance_[at(x, y)]) || !covers(polygon, ray)) continue;
        distance_[at(x, y)] = distance;
        triangle_[at(x, y)] = triangle;
      }
  }

  // Whether the ray passes on one side of all edges.
  static bool covers(std::span<const Vec3> polygon, const Vec3& ray) {
    bool left = true, right = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const double side = glm::dot(glm::cross(polygon[i], polygon[(i + 1) % polygon.size()]), ray);
      left = left && side >= 0.0;
      right = right && side <= 0.0;
    }
    return left || right;
  }

  const View& view_;
  scene::PixelRays rays_;
  double width_, height_;
  std::array<double, kColumns* kRows> distance_ = filled();
  std::array<std::uint32_t, kColumns * kRows> triangle_{};
  static std::array<double, kColumns * kRows> filled() {
    std::array<double, kColumns * kRows> all{};
    all.fill(kNone);
    return all;
  }
};

}  // namespace

void clip(std::span<const Vec3> polygon, const HalfSpace& inside, std::vector<Vec3>& out) {
  out.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = heightOver(inside, p), hq = heightOver(inside, q);
    if (hp >= 0.0) out.push_back(p);
    if ((hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0)) out.push_back(p + (hp / (hp - hq)) * (q - p));
  }
}

SeenReceivers seenReceivers(const scene::Surfaces& surfaces, const View& view, const scene::Camera& camera) {
  const Vec3 eye = view.eye - surfaces.origin;
  const auto borders = bordersOf(view);
  std::vector<std::uint8_t> beyond;  // per position, one bit a border
  beyond.reserve(surfaces.positions.size());
  for (const Vec3f& position : surfaces.positions) {
    unsigned code = 0;
    for (std::size_t b = 0; b < borders.size(); ++b)
      code |= (heightOver(borders[b], Vec3(position) - eye) < 0.0 ? 1u : 0u) << b;
    beyond.push_back(static_cast<std::uint8_t>(code));
  }
  SeenReceivers out;
  Grid grid(view, camera);
  std::vector<Vec3> polygon, clipped;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const mesh::Triangle& c = surfaces.triangles[t];
    if ((beyond[c[0]] & beyond[c[1]] & beyond[c[2]]) != 0) continue;
    polygon = {surfaces.corner(t, 0) - eye, surfaces.corner(t, 1) - eye, surfaces.corner(t, 2) - eye};
    const Vec3 a = polygon[0];
    const unsigned crossed = beyond[c[0]] | beyond[c[1]] | beyond[c[2]];
    for (std::size_t b = 0; b < borders.size() && !polygon.empty(); ++b) {
      if ((crossed >> b & 1u) == 0) continue;
      clip(polygon, borders[b], clipped);
      std::swap(polygon, clipped);
    }
    if (polygon.size() < 3) continue;
    const auto begin = static_cast<std::uint32_t>(out.points.size());
    out.points.insert(out.points.end(), polygon.begin(), polygon.end());
    out.polygons.push_back({t, begin, static_cast<std::uint32_t>(out.points.size())});
    grid.add(t, a, surfaces.normal(t), polygon);
  }
  out.samples = grid.samples();
  return out;
}

}  // namespace umbrage::render
