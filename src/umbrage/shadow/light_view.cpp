#include "umbrage/shadow/light_view.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace umbrage::shadow {
namespace {

// Of no triangles, or of triangles in one point: the scale stays finite, so that 0 times it is 0.
constexpr double kSmallestExtent = 1e-280;

// What a grid over one coordinate should cover: all points, but for those that lie so far off the others that they would take
// the grid away from them; the outermost cells hold these.
std::pair<double, double> extentOfMost(const std::vector<Vec2>& points, double Vec2::*coordinate) {
  if (points.empty()) return {0.0, 0.0};
  double low = points[0].*coordinate, high = low;
  for (const Vec2& p : points) {
    low = std::min(low, p.*coordinate);
    high = std::max(high, p.*coordinate);
  }
  constexpr std::size_t kSample = 512;
  std::vector<double> sample;
  for (std::size_t i = 0; i < points.size(); i += points.size() / kSample + 1) sample.push_back(points[i].*coordinate);
  std::sort(sample.begin(), sample.end());
  const double first = sample[sample.size() / 20], last = sample[sample.size() - 1 - sample.size() / 20];
  const double wide = 4.0 * (last - first);
  return wide > 0.0 ? std::pair(std::max(low, first - wide), std::min(high, last + wide)) : std::pair(low, high);
}

// A triangle, cut by up to four planes.
struct Cut {
  std::array<Vec3, 8> corners;
  int size = 0;
  void add(const Vec3& p) { corners[size++] = p; }
};

// The part of a polygon in front of a plane through the light.
Cut clipped(const Cut& polygon, const Vec3& inward) {
  Cut kept;
  for (int i = 0; i < polygon.size; ++i) {
    const Vec3 &a = polygon.corners[i], &b = polygon.corners[i + 1 < polygon.size ? i + 1 : 0];
    const double da = glm::dot(inward, a), db = glm::dot(inward, b);
    if (da >= 0.0) kept.add(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) kept.add(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

// One face of the cube around a point light: +x, +y, +z, -x, -y, -z.
struct CubeFace {
  int axis, u, v;
  double sign;
  explicit CubeFace(int index)
      : axis(index % 3), u((index + 1) % 3), v((index + 2) % 3), sign(index < 3 ? 1.0 : -1.0) {}

  [[nodiscard]] bool mayTouch(const std::array<Vec3, 3>& corners) const {
    const auto allBeyond = [&](int other, double side) {
      return std::all_of(corners.begin(), corners.end(),
                         [&](const Vec3& c) { return side * c[other] > sign * c[axis]; });
    };
    return !allBeyond(u, 1.0) && !allBeyond(u, -1.0) && !allBeyond(v, 1.0) && !allBeyond(v, -1.0);
  }

  // The triangle as the face sees it, in cells. A corner at the light itself cannot be projected; a triangle with one is edge-on.
  [[nodiscard]] GridPolygon project(const std::array<Vec3, 3>& corners, int resolution) const {
    Cut cut;
    for (const Vec3& c : corners) cut.add(c);
    if (!holds(corners)) cut = clippedToFace(cut);
    GridPolygon polygon;
    for (int i = 0; i < cut.size; ++i)
      if (sign * cut.corners[i][axis] > 0.0) polygon.add(see(cut.corners[i], resolution));
    return polygon;
  }

  [[nodiscard]] Vec2 see(const Vec3& p, int resolution) const {
    return (Vec2(p[u], p[v]) / (sign * p[axis]) * 0.5 + 0.5) * double(resolution);
  }

  // Most triangles lie within one face, and need no cutting.
  [[nodiscard]] bool holds(const std::array<Vec3, 3>& corners) const {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vec3& c) { return std::max(std::abs(c[u]), std::abs(c[v])) <= sign * c[axis]; });
  }

  [[nodiscard]] Cut clippedToFace(Cut cut) const {
    for (const int other : {u, v}) {
      for (const double side : {1.0, -1.0}) {
        Vec3 inward(0.0);
        inward[axis] = sign;
        inward[other] = side;
        cut = clipped(cut, inward);
      }
    }
    return cut;
  }
};

}  // namespace

ParallelView::ParallelView(const CasterSet& casters, const Silhouette& silhouette, int resolution) {
  const Vec3 direction = glm::normalize(Vec3(silhouette.light));
  const Vec3 helper = std::abs(direction.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  u_ = glm::normalize(glm::cross(direction, helper));
  v_ = glm::cross(direction, u_);
  std::vector<Vec2> all;
  forEachCounted(casters, silhouette, [&](std::uint32_t, const std::array<Vec3, 3>& corners) {
    for (const Vec3& c : corners) all.push_back(flat(c));
  });
  const auto [lowX, highX] = extentOfMost(all, &Vec2::x);
  const auto [lowY, highY] = extentOfMost(all, &Vec2::y);
  low_ = {lowX, lowY};
  scale_ = resolution / std::max({highX - lowX, highY - lowY, kSmallestExtent});
}

GridPolygon CubeView::project(int face, const std::array<Vec3, 3>& corners) const {
  const CubeFace cube(face);
  return cube.mayTouch(corners) ? cube.project(corners, resolution_) : GridPolygon{};
}

std::optional<GridPlace> CubeView::placeOf(const Vec3& point) const {
  const Vec3 size = glm::abs(point);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (!(size[axis] > 0.0)) return std::nullopt;
  const int face = point[axis] > 0.0 ? axis : axis + 3;
  return GridPlace{face, CubeFace(face).see(point, resolution_)};
}

}  // namespace umbrage::shadow
