#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "umbrage/outline/detail/grid.hpp"

namespace umbrage::outline::detail {

/// A corner of the finest cells, counted from the south-west.
struct Knot {
  std::int32_t i = 0, j = 0;
  friend bool operator==(const Knot&, const Knot&) = default;
};
/// A square cell: its south-western corner and its side in finest cells, a power of two.
struct Cell {
  Knot at;
  std::int32_t side = 1;
};

/// Values at the corners of square cells that are fine where a level passes and coarse elsewhere.
/// 1. A cell whose corners are not all on one side of every level is of the finest size, as are its neighbours across the edges that a
///    level crosses: so borders are closed, or end at the rim.
class Quadtree {
 public:
  static constexpr std::int32_t kCoarsest = 8;
  /// Works out the values of knots, in the order asked for; false: cancelled.
  using Evaluate = std::function<bool(std::span<const Knot>, std::vector<double>&)>;

  /// columns x rows of coarsest cells.
  Quadtree(std::int32_t columns, std::int32_t rows, std::vector<double> levels, Evaluate evaluate)
      : columns_(columns), rows_(rows), levels_(std::move(levels)), evaluate_(std::move(evaluate)) {}

  /// Refines until law 1 holds; false: cancelled.
  [[nodiscard]] bool settle();
  /// Asks for the finest cells around a point (in finest cells), and settles with the next call of settle().
  void refineAt(const Vec2& p);
  /// The smallest cell that holds the point.
  [[nodiscard]] Cell leafAt(const Vec2& p) const;
  [[nodiscard]] bool crosses(const Cell& cell) const;
  /// True where the cell's corners, all on one side of every level, are on other sides than `value`.
  [[nodiscard]] bool contradicts(const Cell& cell, double value) const;

  /// Loops around what is at least `level`, 256 steps a finest cell; straight runs may have corners in between.
  [[nodiscard]] std::vector<Loop> loops(double level) const;
  /// A level reaches the rim.
  [[nodiscard]] bool reachesRim() const;
  [[nodiscard]] std::size_t samples() const { return values_.size(); }

 private:
  [[nodiscard]] static std::uint64_t key(const Knot& k) {
    return std::uint64_t(std::uint32_t(k.i)) << 32 | std::uint32_t(k.j);
  }
  [[nodiscard]] static std::uint64_t key(const Cell& c) {
    return key(c.at) * 4 + (c.side == 2 ? 1U : c.side == 4 ? 2U : c.side == 8 ? 3U : 0U);
  }
  [[nodiscard]] double value(const Knot& k) const { return values_.at(key(k)); }
  [[nodiscard]] bool evaluateCorners(const std::vector<Cell>& cells);
  [[nodiscard]] bool mayCross(const Cell& cell) const;
  [[nodiscard]] bool crosses(const Knot& a, const Knot& b) const;
  [[nodiscard]] bool isRefined(const Cell& cell) const { return refined_.contains(key(cell)); }
  void split(const Cell& cell, std::vector<Cell>& leaves);
  void refineTo(const Cell& finest, std::vector<Cell>& leaves);
  void collectLeaves(const Cell& cell, std::vector<Cell>& leaves) const;
  [[nodiscard]] std::vector<Cell> roots() const;
  [[nodiscard]] GridPoint crossing(const Knot& a, const Knot& b, double level) const;
  void addEdges(const Cell& cell, double level, std::vector<std::pair<GridPoint, GridPoint>>& edges) const;

  std::int32_t columns_, rows_;
  std::vector<double> levels_;
  Evaluate evaluate_;
  std::unordered_map<std::uint64_t, double> values_;
  std::unordered_set<std::uint64_t> refined_;
  std::vector<Cell> waiting_;  // finest cells asked for
  bool begun_ = false;
};

}  // namespace umbrage::outline::detail
