// Source: Lorensen & Cline, Marching cubes, 1987, in the plane, on cells that are refined where a level passes.
#include "umbrage/outline/detail/quadtree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace umbrage::outline::detail {
namespace {

constexpr std::int64_t kSteps = 256;  // of a finest cell, for crossings
// A coarse cell is looked into when its values, so much of their spread farther apart, reach a level.
constexpr double kBeyond = 0.5;

std::array<Knot, 4> cornersOf(const Cell& c) {
  return {c.at, Knot{c.at.i + c.side, c.at.j}, Knot{c.at.i + c.side, c.at.j + c.side}, Knot{c.at.i, c.at.j + c.side}};
}
GridPoint pointOf(const Knot& k) { return {k.i * kSteps, k.j * kSteps}; }

using Edge = std::pair<GridPoint, GridPoint>;

bool less(const GridPoint& a, const GridPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Edges that run both ways cancel; what is left forms loops, as every cell contributes closed ones.
std::vector<Loop> chain(std::vector<Edge> edges) {
  struct Run {
    Edge edge;
    int times;
  };
  std::vector<Run> runs;
  for (const Edge& e : edges) runs.push_back(less(e.first, e.second) ? Run{e, 1} : Run{{e.second, e.first}, -1});
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
    return a.edge.first == b.edge.first ? less(a.edge.second, b.edge.second) : less(a.edge.first, b.edge.first);
  });
  edges.clear();
  for (std::size_t i = 0; i < runs.size();) {
    const Edge edge = runs[i].edge;
    int times = 0;
    for (; i < runs.size() && runs[i].edge == edge; ++i) times += runs[i].times;
    for (int n = std::abs(times); n > 0; --n) edges.push_back(times > 0 ? edge : Edge{edge.second, edge.first});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return less(a.first, b.first); });
  std::vector<char> used(edges.size(), 0);
  std::vector<Loop> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start] != 0) continue;
    Loop loop;
    for (std::size_t at = start;;) {
      used[at] = 1;
      loop.push_back(edges[at].first);
      if (edges[at].second == edges[start].first) break;
      const auto next = std::lower_bound(edges.begin(), edges.end(), edges[at].second,
                                         [](const Edge& e, const GridPoint& p) { return less(e.first, p); });
      at = std::size_t(next - edges.begin());
      while (used[at] != 0) ++at;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

std::vector<Cell> Quadtree::roots() const {
  std::vector<Cell> cells;
  for (std::int32_t j = 0; j < rows_; ++j)
    for (std::int32_t i = 0; i < columns_; ++i) cells.push_back({{i * kCoarsest, j * kCoarsest}, kCoarsest});
  return cells;
}

bool Quadtree::evaluateCorners(const std::vector<Cell>& cells) {
  std::vector<Knot> missing;
  for (const Cell& cell : cells)
    for (const Knot& corner : cornersOf(cell))
      if (values_.try_emplace(key(corner), 0.0).second) missing.push_back(corner);
  if (missing.empty()) return true;
  // Neighbours one after the other, whatever the order in which they were asked for.
  std::sort(missing.begin(), missing.end(),
            [](const Knot& a, const Knot& b) { return a.j != b.j ? a.j < b.j : a.i < b.i; });
  std::vector<double> values;
  if (!evaluate_(missing, values)) return false;
  for (std::size_t k = 0; k < missing.size(); ++k) values_[key(missing[k])] = values[k];
  return true;
}

bool Quadtree::crosses(const Knot& a, const Knot& b) const {
  const double u = value(a), v = value(b);
  return std::any_of(levels_.begin(), levels_.end(), [&](double level) { return (u >= level) != (v >= level); });
}

bool Quadtree::crosses(const Cell& cell) const {
  const auto corners = cornersOf(cell);
  return crosses(corners[0], corners[1]) || crosses(corners[1], corners[2]) || crosses(corners[2], corners[3]);
}

bool Quadtree::mayCross(const Cell& cell) const {
  double low = 1e300, high = -1e300;
  for (const Knot& corner : cornersOf(cell)) {
    low = std::min(low, value(corner));
    high = std::max(high, value(corner));
  }
  const double beyond = kBeyond * (high - low);
  return std::any_of(levels_.begin(), levels_.end(), [&](double l) { return l > low - beyond && l <= high + beyond; });
}

bool Quadtree::contradicts(const Cell& cell, double given) const {
  const double known = value(cell.at);
  return std::any_of(levels_.begin(), levels_.end(),
                     [&](double level) { return (known >= level) != (given >= level); });
}

void Quadtree::split(const Cell& cell, std::vector<Cell>& leaves) {
  refined_.insert(key(cell));
  const std::int32_t half = cell.side / 2;
  for (const std::int32_t dj : {0, half})
    for (const std::int32_t di : {0, half}) leaves.push_back({{cell.at.i + di, cell.at.j + dj}, half});
}

void Quadtree::refineTo(const Cell& finest, std::vector<Cell>& leaves) {
  for (std::int32_t side = kCoarsest; side > 1; side /= 2) {
    const Cell around{{finest.at.i / side * side, finest.at.j / side * side}, side};
    if (!isRefined(around)) split(around, leaves);
  }
}

void Quadtree::refineAt(const Vec2& p) {
  const auto clamped = [](double v, std::int32_t most) {
    return std::clamp(static_cast<std::int32_t>(std::floor(v)), 0, most - 1);
  };
  waiting_.push_back({{clamped(p.x, columns_ * kCoarsest), clamped(p.y, rows_ * kCoarsest)}, 1});
}

Cell Quadtree::leafAt(const Vec2& p) const {
  const auto clamped = [](double v, std::int32_t most) {
    return std::clamp(static_cast<std::int32_t>(std::floor(v)), 0, most - 1);
  };
  const Knot at{clamped(p.x, columns_ * kCoarsest), clamped(p.y, rows_ * kCoarsest)};
  for (std::int32_t side = kCoarsest;; side /= 2) {
    const Cell cell{{at.i / side * side, at.j / side * side}, side};
    if (side == 1 || !isRefined(cell)) return cell;
  }
}

bool Quadtree::settle() {
  std::vector<Cell> fresh = begun_ ? std::vector<Cell>{} : roots();
  begun_ = true;
  for (const Cell& cell : std::exchange(waiting_, {})) refineTo(cell, fresh);
  while (!fresh.empty()) {
    if (!evaluateCorners(fresh)) return false;
    std::vector<Cell> next;
    for (const Cell& cell : fresh) {
      if (isRefined(cell)) continue;
      if (cell.side > 1) {
        if (crosses(cell) || mayCross(cell)) split(cell, next);
        continue;
      }
      // Across an edge that a level crosses, the neighbour must see the crossing too.
      const auto corners = cornersOf(cell);
      constexpr std::array<Knot, 4> kNeighbours = {Knot{0, -1}, Knot{1, 0}, Knot{0, 1}, Knot{-1, 0}};
      for (std::size_t k = 0; k < 4; ++k) {
        const Knot beside{cell.at.i + kNeighbours[k].i, cell.at.j + kNeighbours[k].j};
        const bool exists =
            beside.i >= 0 && beside.j >= 0 && beside.i < columns_ * kCoarsest && beside.j < rows_ * kCoarsest;
        if (exists && crosses(corners[k], corners[(k + 1) % 4])) refineTo({beside, 1}, next);
      }
    }
    fresh = std::move(next);
  }
  return true;
}

void Quadtree::collectLeaves(const Cell& cell, std::vector<Cell>& leaves) const {
  if (cell.side == 1 || !isRefined(cell)) {
    leaves.push_back(cell);
    return;
  }
  const std::int32_t half = cell.side / 2;
  for (const std::int32_t dj : {0, half})
    for (const std::int32_t di : {0, half}) collectLeaves({{cell.at.i + di, cell.at.j + dj}, half}, leaves);
}

// The same point whichever cell asks.
GridPoint Quadtree::crossing(const Knot& a, const Knot& b, double level) const {
  const bool ordered = a.i < b.i || a.j < b.j;
  const Knot& p = ordered ? a : b;
  const Knot& q = ordered ? b : a;
  const double u = value(p), v = value(q);
  const auto along = std::clamp<std::int64_t>(std::llround((level - u) / (v - u) * double(kSteps)), 1, kSteps - 1);
  return {p.i * kSteps + (q.i - p.i) * along, p.j * kSteps + (q.j - p.j) * along};
}

void Quadtree::addEdges(const Cell& cell, double level, std::vector<Edge>& edges) const {
  const auto corners = cornersOf(cell);
  std::array<bool, 4> in{};
  for (std::size_t k = 0; k < 4; ++k) in[k] = value(corners[k]) >= level;
  if (!in[0] && !in[1] && !in[2] && !in[3]) return;
  if (in[0] && in[1] && in[2] && in[3]) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Knot a = corners[k], b = corners[(k + 1) % 4];
      const Knot step{(b.i > a.i) - (b.i < a.i), (b.j > a.j) - (b.j < a.j)};
      for (Knot p = a; p != b; p = {p.i + step.i, p.j + step.j})
        edges.emplace_back(pointOf(p), pointOf({p.i + step.i, p.j + step.j}));
    }
    return;
  }
  // Walk around; where the walk leaves the region it crosses over to where it comes back: to the next entry when the corner between is
  // cut off, which at saddles is always the case for the corners outside.
  std::vector<GridPoint> leave, enter;
  const bool saddle = in[0] == in[2] && in[1] == in[3];
  double mean = 0.0;
  for (const Knot& corner : corners) mean += 0.25 * value(corner);
  for (std::size_t k = 0; k < 4; ++k) {
    const Knot &a = corners[k], &b = corners[(k + 1) % 4];
    const bool out = !in[(k + 1) % 4];
    if (in[k] && !out) edges.emplace_back(pointOf(a), pointOf(b));
    if (in[k] && out) {
      leave.push_back(crossing(a, b, level));
      edges.emplace_back(pointOf(a), leave.back());
    }
    if (!in[k] && !out) {
      enter.push_back(crossing(a, b, level));
      edges.emplace_back(enter.back(), pointOf(b));
    }
  }
  // Of one crossing each there is one way. At a saddle, entries and leaves alternate around the cell: joined middle or two corners.
  if (!saddle) {
    edges.emplace_back(leave[0], enter[0]);
    return;
  }
  const bool leavesFirst = in[0];
  const bool joined = mean >= level;
  // Around the cell: with in[0], leave0 enter0 leave1 enter1; otherwise enter0 leave0 enter1 leave1.
  const std::size_t next = leavesFirst ? 0 : 1;
  for (std::size_t k = 0; k < 2; ++k) edges.emplace_back(leave[k], enter[joined ? (k + next) % 2 : (k + next + 1) % 2]);
}

std::vector<Loop> Quadtree::loops(double level) const {
  std::vector<Cell> leaves;
  for (const Cell& root : roots()) collectLeaves(root, leaves);
  std::vector<Edge> edges;
  for (const Cell& leaf : leaves) addEdges(leaf, level, edges);
  return chain(std::move(edges));
}

bool Quadtree::reachesRim() const {
  const std::int32_t right = columns_ * kCoarsest, top = rows_ * kCoarsest;
  const auto any = [&](Knot from, Knot step, std::int32_t count) {
    const Knot* before = nullptr;
    Knot last{};
    Knot k = from;
    for (std::int32_t n = 0; n <= count; ++n, k = {k.i + step.i, k.j + step.j}) {
      if (!values_.contains(key(k))) continue;
      if (before != nullptr && crosses(*before, k)) return true;
      last = k;
      before = &last;
    }
    return false;
  };
  return any({0, 0}, {1, 0}, right) || any({0, top}, {1, 0}, right) || any({0, 0}, {0, 1}, top) ||
         any({right, 0}, {0, 1}, top);
}

}  // namespace umbrage::outline::detail
