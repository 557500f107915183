#include "umbrage/io/reader/alpha_cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace umbrage::io::reader {
namespace {

constexpr double kFarthest = 1e8;
/// Points nearer than this, in cells, are one; and one that is so near a line lies on it.
constexpr double kSame = 1e-6;
constexpr int kHalf = 32768;
/// Cells of one piece differ by at most so much where nothing is decided.
constexpr int kAlike = 4096;
/// Less than this of a cell is nothing, and all but this is all.
constexpr int kNothing = 128;

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// A rectangle of cells that are alike.
struct Piece {
  long x0, y0, x1, y1;
  double sum;
  int low, high;
  [[nodiscard]] double mean() const { return sum / (double(x1 - x0) * double(y1 - y0)); }
};

bool alike(const CutRule& rule, int low, int high) {
  if (rule.decides) return (low >= kHalf) == (high >= kHalf);
  const bool ends = (low < kNothing) == (high < kNothing) &&
                    (low > CoverageCells::kAll - kNothing) == (high > CoverageCells::kAll - kNothing);
  return ends && high - low <= kAlike;
}

/// A triangle over the cells of its texture, which are the unit squares of the plane.
class PlacedTriangle {
 public:
  PlacedTriangle(const TexturedTriangle& given, const CoverageCells& cells) : corners_(given.corners) {
    for (std::size_t k = 0; k < 3; ++k) {
      at_[k] = given.places[k] * Vec2(cells.width, cells.height);
      placed_ = placed_ && std::abs(at_[k].x) <= kFarthest && std::abs(at_[k].y) <= kFarthest;
      // Places that mean a border of cells mostly miss it by what single precision leaves.
      for (int c = 0; c < 2; ++c)
        if (std::abs(at_[k][c] - std::round(at_[k][c])) < 1e-4) at_[k][c] = std::round(at_[k][c]);
    }
    area_ = placed_ ? cross(at_[1] - at_[0], at_[2] - at_[0]) : 0.0;
  }

  [[nodiscard]] bool isPlaced() const { return placed_; }
  [[nodiscard]] bool isFlat() const { return !(std::abs(area_) > kSame); }
  [[nodiscard]] double area() const { return std::abs(area_) / 2; }
  [[nodiscard]] const std::array<Vec3, 3>& corners() const { return corners_; }
  [[nodiscard]] const Vec2& at(std::size_t k) const { return at_[k]; }
  [[nodiscard]] long first(int c) const {
    return static_cast<long>(std::floor(std::min({at_[0][c], at_[1][c], at_[2][c]})));
  }
  /// Beyond the last cell.
  [[nodiscard]] long end(int c) const {
    return std::max(first(c) + 1, static_cast<long>(std::ceil(std::max({at_[0][c], at_[1][c], at_[2][c]}))));
  }
  /// Distance from edge k, in cells, inside above 0.
  [[nodiscard]] double inside(std::size_t k, const Vec2& p) const {
    const Vec2 a = at_[k], along = at_[(k + 1) % 3] - a;
    return cross(along, p - a) / glm::length(along) * (area_ > 0.0 ? 1.0 : -1.0);
  }

  /// The point of space that a point of the plane is. On an edge it is a function of that edge alone, at a corner the corner.
  [[nodiscard]] Vec3 point(const Vec2& p) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (p == at_[k]) return corners_[k];
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(inside(k, p)) < kSame) return onEdge(k, p);
    const Vec2 d = p - at_[0];
    const double s = cross(d, at_[2] - at_[0]) / area_, t = cross(at_[1] - at_[0], d) / area_;
    return corners_[0] + s * (corners_[1] - corners_[0]) + t * (corners_[2] - corners_[0]);
  }

  /// Where edge k meets the line on which coordinate `c` is `value`.
  [[nodiscard]] std::optional<Vec2> crossing(std::size_t k, int c, double value) const {
    const auto [a, b] = ends(k);
    if (!((at_[a][c] < value && value < at_[b][c]) || (at_[b][c] < value && value < at_[a][c]))) return {};
    const double s = (value - at_[a][c]) / (at_[b][c] - at_[a][c]);
    Vec2 p;
    p[c] = value;
    p[1 - c] = at_[a][1 - c] + s * (at_[b][1 - c] - at_[a][1 - c]);
    if (const double whole = std::round(p[1 - c]); std::abs(p[1 - c] - whole) < kSame) p[1 - c] = whole;
    for (const Vec2& corner : at_)
      if (glm::length(p - corner) < kSame) return {};
    return p;
  }

 private:
  /// The two corners of an edge in an order that both its triangles agree upon.
  [[nodiscard]] std::pair<std::size_t, std::size_t> ends(std::size_t k) const {
    const std::size_t l = (k + 1) % 3;
    const auto key = [&](std::size_t i) { return std::array{corners_[i].x, corners_[i].y, corners_[i].z}; };
    return key(k) < key(l) ? std::pair(k, l) : std::pair(l, k);
  }
  [[nodiscard]] Vec3 onEdge(std::size_t k, const Vec2& p) const {
    const auto [a, b] = ends(k);
    const Vec2 along = at_[b] - at_[a];
    const int c = std::abs(along.x) > std::abs(along.y) ? 0 : 1;
    const double s = std::clamp((p[c] - at_[a][c]) / along[c], 0.0, 1.0);
    return corners_[a] + s * (corners_[b] - corners_[a]);
  }

  std::array<Vec3, 3> corners_;
  std::array<Vec2, 3> at_;
  bool placed_ = true;
  double area_ = 0.0;
};

/// Alike cells of a triangle's box as rectangles: runs in each row, joined with the same run of the row before. None where there are more than `most`.
std::vector<Piece> piecesOf(const PlacedTriangle& triangle, const CoverageCells& cells, const CutRule& rule,
                            std::size_t most) {
  std::vector<Piece> done, open;
  const long left = triangle.first(0), right = triangle.end(0);
  for (long y = triangle.first(1); y < triangle.end(1); ++y) {
    const int row = wrapped(y, cells.height, rule.v);
    std::vector<Piece> runs;
    for (long x = left; x < right; ++x) {
      const int value = cells.at(wrapped(x, cells.width, rule.u), row);
      if (!runs.empty()) {
        Piece& last = runs.back();
        const int low = std::min(last.low, value), high = std::max(last.high, value);
        if (alike(rule, low, high)) {
          last.x1 = x + 1, last.sum += value, last.low = low, last.high = high;
          continue;
        }
      }
      runs.push_back({x, y, x + 1, y + 1, double(value), value, value});
    }
    // Both lists are sorted and fill the row.
    auto above = open.begin();
    for (Piece& run : runs) {
      while (above != open.end() && above->x0 < run.x0) done.push_back(*above++);
      if (above == open.end() || above->x0 != run.x0 || above->x1 != run.x1) continue;
      const int low = std::min(run.low, above->low), high = std::max(run.high, above->high);
      if (alike(rule, low, high)) {
        run.y0 = above->y0, run.sum += above->sum, run.low = low, run.high = high;
        ++above;
      }
    }
    done.insert(done.end(), above, open.end());
    open = std::move(runs);
    if (done.size() + open.size() > most) return {};
  }
  done.insert(done.end(), open.begin(), open.end());
  return done;
}

using Polygon = std::vector<Vec2>;

bool isWhole(const PlacedTriangle& triangle, const std::array<Vec2, 4>& box) {
  for (std::size_t k = 0; k < 3; ++k)
    for (const Vec2& corner : box)
      if (triangle.inside(k, corner) < -kSame) return false;
  return true;
}

bool isOutside(const PlacedTriangle& triangle, const std::array<Vec2, 4>& box) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::all_of(box.begin(), box.end(), [&](const Vec2& p) { return triangle.inside(k, p) < kSame; })) return true;
  return false;
}

double areaOf(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return std::abs(twice) / 2;
}

/// Convex points in their order around.
Polygon around(Polygon points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Vec2 middle(0.0);
  for (const Vec2& p : points) middle += p / double(points.size());
  std::sort(points.begin(), points.end(), [&](const Vec2& a, const Vec2& b) {
    return std::atan2(a.y - middle.y, a.x - middle.x) < std::atan2(b.y - middle.y, b.x - middle.x);
  });
  return points;
}

/// What a triangle and a rectangle have in common.
Polygon common(const PlacedTriangle& triangle, const Piece& piece) {
  const Vec2 low(double(piece.x0), double(piece.y0)), high(double(piece.x1), double(piece.y1));
  const std::array<Vec2, 4> box = {low, Vec2(high.x, low.y), high, Vec2(low.x, high.y)};
  if (isOutside(triangle, box)) return {};
  if (isWhole(triangle, box)) return {box.begin(), box.end()};
  const auto within = [&](const Vec2& p, int c) { return p[c] >= low[c] && p[c] <= high[c]; };
  Polygon points;
  for (std::size_t k = 0; k < 3; ++k) {
    if (within(triangle.at(k), 0) && within(triangle.at(k), 1)) points.push_back(triangle.at(k));
    for (int c = 0; c < 2; ++c)
      for (const double value : {low[c], high[c]})
        if (const auto p = triangle.crossing(k, c, value); p && within(*p, 1 - c)) points.push_back(*p);
  }
  for (const Vec2& corner : box)
    if (triangle.inside(0, corner) > kSame && triangle.inside(1, corner) > kSame && triangle.inside(2, corner) > kSame)
      points.push_back(corner);
  return around(std::move(points));
}

/// The corners of pieces on the lines between cells: a piece has those of its neighbours in its sides.
class Joints {
 public:
  void add(const Piece& piece) {
    for (const long x : {piece.x0, piece.x1})
      for (const long y : {piece.y0, piece.y1}) onRow_[y].push_back(x), onColumn_[x].push_back(y);
  }
  void sort() {
    for (auto* lines : {&onRow_, &onColumn_})
      for (auto& [line, places] : *lines) {
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
      }
  }
  /// The polygon with these points in its sides; whether there are any.
  [[nodiscard]] bool insertInto(Polygon& polygon) const {
    Polygon out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      out.push_back(a);
      if (a.y == b.y) between(onRow_, a.y, a, b, 0, out);
      if (a.x == b.x) between(onColumn_, a.x, a, b, 1, out);
    }
    const bool more = out.size() > polygon.size();
    polygon = std::move(out);
    return more;
  }

 private:
  using Lines = std::map<long, std::vector<long>>;
  static void between(const Lines& lines, double line, const Vec2& a, const Vec2& b, int c, Polygon& out) {
    const auto found = lines.find(static_cast<long>(line));
    if (found == lines.end() || double(found->first) != line) return;
    const auto& places = found->second;
    const double low = std::min(a[c], b[c]), high = std::max(a[c], b[c]);
    auto begin = std::upper_bound(places.begin(), places.end(), low, [](double v, long p) { return v < double(p); });
    const auto end = std::lower_bound(begin, places.end(), high, [](long p, double v) { return double(p) < v; });
    const auto size = out.size();
    for (; begin != end; ++begin) {
      Vec2 p = a;
      p[c] = double(*begin);
      out.push_back(p);
    }
    if (a[c] > b[c]) std::reverse(out.begin() + static_cast<std::ptrdiff_t>(size), out.end());
  }
  Lines onRow_, onColumn_;
};

class Cutter {
 public:
  Cutter(const Coverage& coverage, const CutRule& rule, std::size_t level, std::size_t most, std::size_t& effort)
      : coverage_(coverage), rule_(rule), level_(level), most_(most), effort_(effort) {}

  /// False: there are too many.
  [[nodiscard]] bool add(const TexturedTriangle& given) {
    if (level_ >= coverage_.levels()) return keep(given.corners, coverage_.mean()), out_.triangles.size() <= most_;
    const CoverageCells& cells = coverage_.level(level_);
    const PlacedTriangle triangle(given, cells);
    if (!triangle.isPlaced()) {
      ++out_.unplaced;
      keep(given.corners, coverage_.mean());
      return out_.triangles.size() <= most_;
    }
    const std::vector<Piece> pieces = piecesOf(triangle, cells, rule_, effort_);
    effort_ -= pieces.empty() ? effort_ : pieces.size();
    if (pieces.empty()) return false;
    if (pieces.size() == 1 || triangle.isFlat())
      keepWhole(triangle, pieces);
    else
      cut(triangle, pieces);
    return out_.triangles.size() <= most_;
  }
  [[nodiscard]] CutPieces take() { return std::move(out_); }

 private:
  [[nodiscard]] double partOf(double mean) const {
    if (rule_.decides) return mean >= kHalf ? 1.0 : 0.0;
    return std::clamp(mean * rule_.factor / CoverageCells::kAll, 0.0, 1.0);
  }
  [[nodiscard]] bool isThere(double mean) const {
    return rule_.keepsEmpty || (rule_.decides ? mean >= kHalf : mean >= kNothing);
  }
  void put(const std::array<Vec3, 3>& corners, double part) {
    out_.triangles.push_back(corners);
    out_.parts.push_back(part);
  }
  /// A triangle as it is, all or nothing of which is there.
  void keep(const std::array<Vec3, 3>& corners, double mean) {
    if (rule_.decides) out_.worstArea = std::max(out_.worstArea, std::abs(partOf(mean) - mean / CoverageCells::kAll));
    if (isThere(mean))
      put(corners, partOf(mean));
    else
      ++out_.dropped;
  }
  void noteSpread(const Piece& piece) {
    if (rule_.decides) return;
    const double off = std::max(piece.mean() - piece.low, piece.high - piece.mean()) / CoverageCells::kAll;
    out_.worstPart = std::max(out_.worstPart, off * rule_.factor);
  }
  void keepWhole(const PlacedTriangle& triangle, const std::vector<Piece>& pieces) {
    Piece all = pieces[0];
    double cells = 0.0, sum = 0.0;
    for (const Piece& piece : pieces) {
      cells += double(piece.x1 - piece.x0) * double(piece.y1 - piece.y0), sum += piece.sum;
      all.low = std::min(all.low, piece.low), all.high = std::max(all.high, piece.high);
    }
    const double mean = sum / cells;
    if (!rule_.decides)
      out_.worstPart =
          std::max(out_.worstPart, rule_.factor * std::max(mean - all.low, all.high - mean) / CoverageCells::kAll);
    keep(triangle.corners(), mean);
  }

  struct Cut {
    Polygon polygon;
    const Piece* piece;
  };
  void cut(const PlacedTriangle& triangle, const std::vector<Piece>& pieces) {
    std::vector<Cut> cuts;
    double area = 0.0, sum = 0.0;
    int low = CoverageCells::kAll, high = 0;
    for (const Piece& piece : pieces) {
      Polygon polygon = common(triangle, piece);
      const double part = areaOf(polygon);
      if (!(part > 1e-9)) continue;
      area += part, sum += part * piece.mean();
      low = std::min(low, piece.low), high = std::max(high, piece.high);
      cuts.push_back({std::move(polygon), &piece});
    }
    // A box holds more than its triangle.
    if (cuts.empty() || alike(rule_, low, high)) {
      const double mean = cuts.empty() ? coverage_.mean() : sum / area;
      if (!cuts.empty()) noteSpread({0, 0, 1, 1, mean, low, high});
      return keep(triangle.corners(), mean);
    }
    putCuts(triangle, cuts, area);
  }
  void putCuts(const PlacedTriangle& triangle, std::vector<Cut>& cuts, double area) {
    Joints joints;
    double off = 0.0;
    for (const Cut& c : cuts) {
      const double mean = c.piece->mean();
      if (rule_.decides) off += areaOf(c.polygon) * (partOf(mean) - mean / CoverageCells::kAll);
      if (isThere(mean)) joints.add(*c.piece);
    }
    out_.worstArea = std::max(out_.worstArea, std::abs(off) / area);
    joints.sort();
    ++out_.cut;
    const std::size_t before = out_.triangles.size();
    for (Cut& c : cuts) {
      if (!isThere(c.piece->mean())) continue;
      noteSpread(*c.piece);
      const bool jointed = joints.insertInto(c.polygon);
      putPolygon(triangle, c.polygon, jointed, partOf(c.piece->mean()));
      if (out_.triangles.size() > most_) break;
    }
    out_.pieces += out_.triangles.size() - before;
  }
  // With points in its sides a polygon falls into triangles around its middle: from a corner some would have no area.
  void putPolygon(const PlacedTriangle& triangle, const Polygon& polygon, bool jointed, double part) {
    std::vector<Vec3> points;
    for (const Vec2& p : polygon) points.push_back(triangle.point(p));
    const std::size_t n = points.size();
    if (!jointed && n <= 4) {
      for (std::size_t i = 2; i < n; ++i) put({points[0], points[i - 1], points[i]}, part);
      return;
    }
    Vec2 middle(0.0);
    for (const Vec2& p : polygon) middle += p / double(n);
    const Vec3 centre = triangle.point(middle);
    for (std::size_t i = 0; i < n; ++i) put({centre, points[i], points[(i + 1) % n]}, part);
  }

  const Coverage& coverage_;
  const CutRule& rule_;
  std::size_t level_, most_;
  std::size_t& effort_;
  CutPieces out_;
};

}  // namespace

std::optional<CutPieces> cutByCoverage(const std::vector<TexturedTriangle>& triangles, const Coverage& coverage,
                                       const CutRule& rule, std::size_t level, std::size_t mostTriangles,
                                       std::size_t& effort) {
  Cutter cutter(coverage, rule, level, mostTriangles, effort);
  for (const TexturedTriangle& triangle : triangles)
    if (!cutter.add(triangle)) return std::nullopt;
  return cutter.take();
}

double cellsToLookAt(const std::vector<TexturedTriangle>& triangles, const Coverage& coverage, std::size_t level) {
  if (level >= coverage.levels()) return 0.0;
  double cells = 0.0;
  for (const TexturedTriangle& triangle : triangles) {
    const PlacedTriangle placed(triangle, coverage.level(level));
    if (!placed.isPlaced()) continue;
    cells += double(placed.end(0) - placed.first(0)) * double(placed.end(1) - placed.first(1));
  }
  return cells;
}

}  // namespace umbrage::io::reader
