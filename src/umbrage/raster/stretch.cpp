#include "umbrage/raster/stretch.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::raster {
namespace {

// The first pixel of `within` for which is(x), which is false and then true; looked for from a guess.
template <class Is>
int firstWhere(double guess, const Stretch& within, const Is& is) {
  int x = guess > within.begin ? (guess < within.end ? static_cast<int>(guess) : within.end) : within.begin;
  while (x > within.begin && is(x - 1)) --x;
  while (x < within.end && !is(x)) ++x;
  return x;
}

}  // namespace

Stretch above(const Slope& function, double limit, Stretch within) {
  if (within.empty()) return within;
  const bool first = function.at(within.begin) > limit, last = function.at(within.end - 1) > limit;
  if (first == last) return first ? within : Stretch{within.begin, within.begin};
  const double guess = std::ceil((limit - function.at0) / function.perPixel - 0.5);
  if (function.perPixel > 0.0)
    within.begin = firstWhere(guess, within, [&](int x) { return function.at(x) > limit; });
  else
    within.end = firstWhere(guess, within, [&](int x) { return !(function.at(x) > limit); });
  return within;
}

// Double precision answers for all but a pixel or two at either end.
Stretch coveredInRow(const Patch& patch, const Corners& corners, int y) {
  if (y < patch.y0 || y >= patch.y1) return {};
  Stretch maybe{patch.x0, patch.x1};
  for (std::size_t k = 0; k < 3; ++k) maybe = above(alongRow(patch, k, y), -patch.slack[k], maybe);
  Stretch sure = maybe;
  for (std::size_t k = 0; k < 3; ++k) sure = above(alongRow(patch, k, y), patch.slack[k], sure);
  if (sure.empty()) {
    while (!maybe.empty() && !patch.covers(corners, maybe.begin, y)) ++maybe.begin;
    while (!maybe.empty() && !patch.covers(corners, maybe.end - 1, y)) --maybe.end;
    return maybe.empty() ? Stretch{} : maybe;
  }
  while (sure.begin > maybe.begin && patch.covers(corners, sure.begin - 1, y)) --sure.begin;
  while (sure.end < maybe.end && patch.covers(corners, sure.end, y)) ++sure.end;
  return sure;
}

Crossings::Crossings(const Patch& patch) {
  constexpr double kRounding = 0x1p-48;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at0 = -patch.c[k] / patch.x[k], perRow = -patch.y[k] / patch.x[k];
    const double size = std::abs(at0) + std::abs(perRow) * patch.y1;
    edges_[k] = {at0, perRow, patch.slack[k] / std::abs(patch.x[k]) + kRounding * size, patch.x[k] > 0.0};
  }
}

// An edge along the rows has no place where it crosses them, and doubts that no comparison passes.
Stretch Crossings::covered(const Patch& patch, const Corners& corners, int y) const {
  if (y < patch.y0 || y >= patch.y1) return {};
  Stretch pixels{patch.x0, patch.x1};
  for (const Edge& edge : edges_) {
    // In pixels from centre to centre: what is covered begins at the first whole number above it, or ends there.
    const double at = edge.at0 + edge.perRow * (y + 0.5) - 0.5, next = std::ceil(at);
    const bool left = at + edge.doubt<pixels.begin - 1.0, right = at - edge.doubt> pixels.end;
    if (left || right) {
      if (left != edge.begins) return {};
      continue;
    }
    if (!(next - at > edge.doubt && at - (next - 1.0) > edge.doubt)) return coveredInRow(patch, corners, y);
    if (edge.begins)
      pixels.begin = std::max(pixels.begin, static_cast<int>(next));
    else
      pixels.end = std::min(pixels.end, static_cast<int>(next));
  }
  return pixels.empty() ? Stretch{} : pixels;
}

}  // namespace umbrage::raster
