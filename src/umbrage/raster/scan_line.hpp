#pragma once

#include <span>
#include <vector>

#include "umbrage/raster/stretch.hpp"

namespace umbrage::raster {

/// A patch and what it covers of the row that is worked on.
struct ActivePatch {
  const Patch* patch = nullptr;
  Stretch covered;
  std::size_t crossings = 0;  ///< for ActiveList
};

/// The patches that a scan line crosses, kept up to date from row to row: those that begin in a row are taken out of
/// its bucket, and those that have ended are dropped.
/// Source: C. Wylie, G. Romney, D. Evans and A. Erdahl, half-tone perspective drawings by computer, 1967; W. J. Bouknight, 1970.
class ActiveList {
 public:
  enum class Order {
    leftToRight,  ///< by where they begin; rows that follow each other are in nearly the same order, so sorting costs little
    none,
  };
  /// Takes patches for the rows [first, end). REQUIRES: outlived by `corners`.
  ActiveList(const Corners& corners, int first, int end, Order order = Order::leftToRight)
      : corners_(corners),
        order_(order),
        first_(first),
        next_(first),
        buckets_(static_cast<std::size_t>(end - first)) {}

  /// REQUIRES: before the first moveTo(); the patch outlives this.
  void add(const Patch& patch);
  /// On to a row further down.
  void moveTo(int y);
  /// Of the row: those that cover a pixel of it.
  [[nodiscard]] std::span<const ActivePatch> row() const { return {active_.data(), crossed_}; }

 private:
  const Corners& corners_;
  Order order_;
  int first_;
  int next_;                                       ///< the first row whose bucket is still full
  std::vector<std::vector<ActivePatch>> buckets_;  ///< per row: those that begin in it
  std::vector<Crossings> crossings_;
  std::vector<ActivePatch> active_;  ///< behind the first `crossed_` those that cover no pixel of this row
  std::size_t crossed_ = 0;
};

/// A stretch of a row that shows one and the same surface.
struct Run {
  Stretch pixels;
  const Patch* surface = nullptr;
};

/// What a row shows of surfaces, which are patches whose plane function is nearness (makeSurfacePatch): the nearest at every pixel; of
/// two that are equally near the one with the smaller id. Between the ends of surfaces their nearness is linear, so a span whose ends show
/// the same surface shows it throughout, and any other is cut where the two surfaces pass through each other.
/// Source: G. Watkins, a real time visible surface algorithm, 1970; W. J. Bouknight and K. Kelley, 1970.
class VisibleRuns {
 public:
  /// Makes `out` the runs of row y, from left to right. `surfaces`: as ActiveList has them, from left to right.
  void find(std::span<const ActivePatch> surfaces, int y, std::vector<Run>& out);

 private:
  struct Candidate {
    const Patch* patch;
    Slope nearness;
    int end;
  };
  [[nodiscard]] const Candidate& nearestAt(int x) const;
  void resolve(const Stretch& span, const Candidate& left, const Candidate& right, std::vector<Run>& out) const;
  std::vector<Candidate> here_;  ///< the surfaces over the span that is worked on
};

}  // namespace umbrage::raster
