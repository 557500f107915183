#include "umbrage/raster/depth_count.hpp"

#include <algorithm>
#include <limits>

namespace umbrage::raster {
namespace {

// What comparing the ends of a piece in double precision may be wrong by, and more.
constexpr double kMargin = 0x1p-30;

}  // namespace

void DepthCount::look(std::span<const Run> runs, int y) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Stretch piece{static_cast<int>(i) * kPiece, static_cast<int>(i + 1) * kPiece};
    while (next < runs.size() && runs[next].pixels.end <= piece.begin) ++next;
    Piece& out = pieces_[i] = {next, std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t r = next; r < runs.size() && runs[r].pixels.begin < piece.end; ++r) {
      const Slope nearness = alongRow(*runs[r].surface, 3, y);
      const Stretch pixels = meet(runs[r].pixels, piece);
      const double first = nearness.at(pixels.begin), last = nearness.at(pixels.end - 1);
      out.farthest = std::min({out.farthest, first, last}), out.nearest = std::max({out.nearest, first, last});
    }
  }
}

void DepthCount::add(const ActivePatch& side, std::span<const Run> runs, int y) {
  const Patch& patch = *side.patch;
  const Slope plane = alongRow(patch, 3, y);
  const auto last = static_cast<std::size_t>((side.covered.end - 1) / kPiece);
  for (auto i = static_cast<std::size_t>(side.covered.begin / kPiece); i <= last; ++i) {
    const Piece& piece = pieces_[i];
    const Stretch over = meet(side.covered, {static_cast<int>(i) * kPiece, static_cast<int>(i + 1) * kPiece});
    const double a = plane.at(over.begin), b = plane.at(over.end - 1);
    if (std::max(a, b) < piece.farthest * patch.distance * (1.0 - kMargin)) continue;
    if (std::min(a, b) > piece.nearest * patch.distance * (1.0 + kMargin)) {
      change(over, patch.weight);
      continue;
    }
    for (std::size_t r = piece.firstRun; r < runs.size() && runs[r].pixels.begin < over.end; ++r) {
      const Slope surface = alongRow(*runs[r].surface, 3, y);
      const Slope before{plane.at0 - surface.at0 * patch.distance, plane.perPixel - surface.perPixel * patch.distance};
      const Stretch pixels = above(before, 0.0, meet(over, runs[r].pixels));
      if (!pixels.empty()) change(pixels, patch.weight);
    }
  }
}

}  // namespace umbrage::raster
