#include "umbrage/shadow/layering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace umbrage::shadow {
namespace {

// The coarse grid settles most scenes; the fine one looks again only where the coarse one counts too much.
constexpr int kCoarse = 64, kFine = 512;
constexpr std::uint32_t kNobody = ~std::uint32_t{0};

// A convex polygon in the plane of a grid, whose cells are the unit squares; at most a triangle cut by five half-spaces.
struct Polygon {
  std::array<Vec2, 10> corners;
  int size = 0;
  void add(const Vec2& p) { corners[size++] = p; }
};

// Counts per cell, over one square of directions. Triangles of one convex solid count once a cell: a ray meets its lit side once.
class Grid {
 public:
  explicit Grid(int resolution)
      : resolution_(resolution), count_(cells(), 0), last_(cells(), kNobody) {}

  /// `solid`: the convex solid the polygon belongs to, or kNobody.
  void add(const Polygon& polygon, std::uint32_t solid) {
    visit(polygon, [&](std::size_t i) {
      if (solid != kNobody && last_[i] == solid) return true;
      last_[i] = solid;
      ++count_[i];
      return true;
    });
  }

  /// Whether no cell would count more than `limit` with this polygon added.
  [[nodiscard]] bool fits(const Polygon& polygon, std::uint32_t solid, int limit) const {
    return visit(polygon, [&](std::size_t i) { return count_[i] < limit || (solid != kNobody && last_[i] == solid); });
  }

  /// Whether the polygon touches a cell that counts more than `limit`.
  [[nodiscard]] bool exceeds(const Polygon& polygon, int limit) const {
    return !visit(polygon, [&](std::size_t i) { return count_[i] <= limit; });
  }

  [[nodiscard]] int largest() const { return *std::max_element(count_.begin(), count_.end()); }
  /// The largest count that does not exceed `limit`.
  [[nodiscard]] int largestWithin(int limit) const {
    int largest = 0;
    for (const int count : count_)
      if (count <= limit) largest = std::max(largest, count);
    return largest;
  }

 private:
  // Rounding of projected coordinates, in cells: generous, since a cell too many only makes the bound larger.
  static constexpr double kSlack = 1e-6;

  [[nodiscard]] std::size_t cells() const { return std::size_t(resolution_) * std::size_t(resolution_); }
  [[nodiscard]] int cell(double v) const { return static_cast<int>(std::clamp(std::floor(v), 0.0, resolution_ - 1.0)); }

  // Calls fn(index) for the cells that a polygon touches, until fn returns false; true when it never did.
  template <class Fn>
  bool visit(const Polygon& polygon, const Fn& fn) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i < polygon.size; ++i) {
      low = std::min(low, polygon.corners[i].y);
      high = std::max(high, polygon.corners[i].y);
    }
    for (int row = cell(low - kSlack); row <= cell(high + kSlack); ++row)
      if (!visitRow(polygon, row, fn)) return false;
    return true;
  }

  // The cells of one row that the polygon touches: the extent in x of its part between y = row and y = row + 1.
  template <class Fn>
  bool visitRow(const Polygon& polygon, int row, const Fn& fn) const {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    const auto take = [&](double x) {
      left = std::min(left, x);
      right = std::max(right, x);
    };
    // The outermost rows also hold what lies beyond the border.
    constexpr double kBeyond = std::numeric_limits<double>::infinity();
    const double bottom = row == 0 ? -kBeyond : row - kSlack,
                 top = row == resolution_ - 1 ? kBeyond : row + 1 + kSlack;
    for (int i = 0; i < polygon.size; ++i) {
      const Vec2 a = polygon.corners[i], b = polygon.corners[(i + 1) % polygon.size];
      if (a.y >= bottom && a.y <= top) take(a.x);
      for (const double y : {bottom, top})
        if ((a.y < y) != (b.y < y)) take(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    if (left > right) return true;
    for (int column = cell(left - kSlack); column <= cell(right + kSlack); ++column)
      if (!fn(std::size_t(row) * std::size_t(resolution_) + std::size_t(column))) return false;
    return true;
  }

  int resolution_;
  std::vector<int> count_;
  std::vector<std::uint32_t> last_;
};

// Calls visit(triangle, corners relative to the light, solid) for every counted triangle, solids' triangles in succession.
template <class Visit>
void forEachCounted(const CasterSet& casters, const Silhouette& silhouette, const Visit& visit) {
  const Vec4& light = silhouette.light;
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
    if (silhouette.side[t] == 0) continue;
    std::array<Vec3, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = casters.corner(t, k) - (light.w != 0.0 ? Vec3(light) : Vec3(0.0));
    const bool lit = silhouette.side[t] * casters.outward[t] > 0;
    visit(t, corners, lit ? casters.componentOf[t] : kNobody);
  }
}

// How a light sees its casters: one square of parallel rays, or the six faces of a cube around it. `pieces` calls
// fn(face, polygon) for the parts of a triangle on each.
class ParallelView {
 public:
  ParallelView(const CasterSet& casters, const Silhouette& silhouette, int resolution) {
    const Vec3 direction = glm::normalize(Vec3(silhouette.light));
    const Vec3 helper = std::abs(direction.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    u_ = glm::normalize(glm::cross(direction, helper));
    v_ = glm::cross(direction, u_);
    std::vector<Vec2> all;
    forEachCounted(casters, silhouette, [&](std::uint32_t, const std::array<Vec3, 3>& corners, std::uint32_t) {
      for (const Vec3& c : corners) all.push_back(flat(c));
    });
    const auto [lowX, highX] = extentOfMost(all, &Vec2::x);
    const auto [lowY, highY] = extentOfMost(all, &Vec2::y);
    low_ = {lowX, lowY};
    scale_ = resolution / std::max({highX - lowX, highY - lowY, std::numeric_limits<double>::min()});
  }

  static constexpr int kFaces = 1;
  template <class Fn>
  void pieces(const std::array<Vec3, 3>& corners, const Fn& fn) const {
    Polygon polygon;
    for (const Vec3& c : corners) polygon.add((flat(c) - low_) * scale_);
    fn(0, polygon);
  }

 private:
  // What a grid over one coordinate should cover: all points, but for those that lie so far off the others that they would take
  // the grid away from them; the outermost cells hold these.
  static std::pair<double, double> extentOfMost(const std::vector<Vec2>& points, double Vec2::*coordinate) {
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

  [[nodiscard]] Vec2 flat(const Vec3& p) const { return {glm::dot(p, u_), glm::dot(p, v_)}; }
  Vec3 u_, v_;
  Vec2 low_;
  double scale_ = 1.0;
};

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
  explicit CubeFace(int index) : axis(index % 3), u((index + 1) % 3), v((index + 2) % 3), sign(index < 3 ? 1.0 : -1.0) {}

  [[nodiscard]] bool mayTouch(const std::array<Vec3, 3>& corners) const {
    const auto allBeyond = [&](int other, double side) {
      return std::all_of(corners.begin(), corners.end(),
                         [&](const Vec3& c) { return side * c[other] > sign * c[axis]; });
    };
    return !allBeyond(u, 1.0) && !allBeyond(u, -1.0) && !allBeyond(v, 1.0) && !allBeyond(v, -1.0);
  }

  // The triangle as the face sees it, in cells. A corner at the light itself cannot be projected; a triangle with one is edge-on.
  [[nodiscard]] Polygon project(const std::array<Vec3, 3>& corners, int resolution) const {
    Cut cut;
    for (const Vec3& c : corners) cut.add(c);
    if (!holds(corners)) cut = clippedToFace(cut);
    Polygon polygon;
    for (int i = 0; i < cut.size; ++i)
      if (const double depth = sign * cut.corners[i][axis]; depth > 0.0)
        polygon.add((Vec2(cut.corners[i][u], cut.corners[i][v]) / depth * 0.5 + 0.5) * double(resolution));
    return polygon;
  }

  // Most triangles lie within one face, and need no cutting.
  [[nodiscard]] bool holds(const std::array<Vec3, 3>& corners) const {
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& c) {
      return std::max(std::abs(c[u]), std::abs(c[v])) <= sign * c[axis];
    });
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

class CubeView {
 public:
  CubeView(const CasterSet&, const Silhouette&, int resolution) : resolution_(resolution) {}

  static constexpr int kFaces = 6;
  template <class Fn>
  void pieces(const std::array<Vec3, 3>& corners, const Fn& fn) const {
    for (int f = 0; f < kFaces; ++f) {
      const CubeFace face(f);
      if (!face.mayTouch(corners)) continue;
      if (const Polygon polygon = face.project(corners, resolution_); polygon.size > 0) fn(f, polygon);
    }
  }

 private:
  int resolution_;
};

using Grids = std::vector<Grid>;

template <class View>
Grids countAll(const CasterSet& casters, const Silhouette& silhouette, const View& view) {
  Grids grids(View::kFaces, Grid(kCoarse));
  forEachCounted(casters, silhouette, [&](std::uint32_t, const std::array<Vec3, 3>& corners, std::uint32_t solid) {
    view.pieces(corners, [&](int face, const Polygon& polygon) { grids[face].add(polygon, solid); });
  });
  return grids;
}

int largest(const Grids& grids) {
  int value = 0;
  for (const Grid& grid : grids) value = std::max(value, grid.largest());
  return value;
}

// Calls fn(triangle, corners, solid) for the counted triangles that touch a coarse cell of more than `limit`.
template <class View, class Fn>
void forEachCrowded(const CasterSet& casters, const Silhouette& silhouette, const View& view, const Grids& coarse, int limit,
                    const Fn& fn) {
  forEachCounted(casters, silhouette, [&](std::uint32_t t, const std::array<Vec3, 3>& corners, std::uint32_t solid) {
    bool crowded = false;
    view.pieces(corners, [&](int face, const Polygon& p) { crowded = crowded || coarse[face].exceeds(p, limit); });
    if (crowded) fn(t, corners, solid);
  });
}

template <class View>
int boundWith(const CasterSet& casters, const Silhouette& silhouette, int enough) {
  const View view(casters, silhouette, kCoarse);
  const Grids coarse = countAll(casters, silhouette, view);
  if (largest(coarse) <= enough) return largest(coarse);
  const View closer(casters, silhouette, kFine);
  Grids fine(View::kFaces, Grid(kFine));
  forEachCrowded(casters, silhouette, view, coarse, enough,
                 [&](std::uint32_t, const std::array<Vec3, 3>& corners, std::uint32_t solid) {
                   closer.pieces(corners, [&](int face, const Polygon& polygon) { fine[face].add(polygon, solid); });
                 });
  int bound = largest(fine);
  for (const Grid& grid : coarse) bound = std::max(bound, grid.largestWithin(enough));
  return bound;
}

constexpr std::size_t kMostGroups = 256;

// Triangles that touch no crowded cell stay in the first group: where they are, all together are within the limit.
template <class View>
LayerGroups groupWith(const CasterSet& casters, const Silhouette& silhouette, int limit) {
  const View view(casters, silhouette, kCoarse);
  const Grids coarse = countAll(casters, silhouette, view);
  if (largest(coarse) <= limit) return {};
  const View closer(casters, silhouette, kFine);
  std::vector<Grids> groups;
  LayerGroups result;
  result.ofTriangle.assign(casters.triangles.size(), 0);
  const auto place = [&](std::uint32_t t, const std::array<Vec3, 3>& corners, std::uint32_t solid) {
    const auto fits = [&](const Grids& group) {
      bool all = true;
      closer.pieces(corners, [&](int face, const Polygon& p) { all = all && group[face].fits(p, solid, limit); });
      return all;
    };
    std::size_t g = 0;
    while (g < groups.size() && g + 1 < kMostGroups && !fits(groups[g])) ++g;
    if (g == groups.size()) groups.emplace_back(View::kFaces, Grid(kFine));
    closer.pieces(corners, [&](int face, const Polygon& polygon) { groups[g][face].add(polygon, solid); });
    result.ofTriangle[t] = static_cast<std::uint8_t>(g);
  };
  forEachCrowded(casters, silhouette, view, coarse, limit, place);
  if (groups.size() <= 1) return {};
  result.count = static_cast<int>(groups.size());
  return result;
}

}  // namespace

int layeringBound(const CasterSet& casters, const Silhouette& silhouette, int enough) {
  const auto counted =
      static_cast<int>(std::count_if(silhouette.side.begin(), silhouette.side.end(), [](int s) { return s != 0; }));
  if (counted <= enough) return counted;
  return std::min(counted, silhouette.light.w == 0.0 ? boundWith<ParallelView>(casters, silhouette, enough)
                                                     : boundWith<CubeView>(casters, silhouette, enough));
}

LayerGroups groupLayers(const CasterSet& casters, const Silhouette& silhouette, int limit) {
  return silhouette.light.w == 0.0 ? groupWith<ParallelView>(casters, silhouette, limit)
                                   : groupWith<CubeView>(casters, silhouette, limit);
}

Silhouette restrictTo(const CasterSet& casters, const Silhouette& silhouette, const LayerGroups& groups, int group) {
  if (groups.ofTriangle.empty()) return silhouette;
  std::vector<std::int8_t> side = silhouette.side;
  for (std::size_t t = 0; t < side.size(); ++t)
    if (groups.ofTriangle[t] != group) side[t] = 0;
  return silhouetteOf(casters, silhouette.light, std::move(side));
}

}  // namespace umbrage::shadow
