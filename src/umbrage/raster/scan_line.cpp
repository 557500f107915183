#include "umbrage/raster/scan_line.hpp"

#include <algorithm>
#include <limits>

namespace umbrage::raster {
namespace {

void append(const Stretch& pixels, const Patch* surface, std::vector<Run>& out) {
  if (!out.empty() && out.back().surface == surface && out.back().pixels.end == pixels.begin)
    out.back().pixels.end = pixels.end;
  else
    out.push_back({pixels, surface});
}

// A list that is nearly sorted, as that of the row before is, takes hardly more than one look at each.
void sortByInsertion(std::span<ActivePatch> list) {
  for (std::size_t i = 1; i < list.size(); ++i) {
    const ActivePatch moved = list[i];
    std::size_t j = i;
    for (; j > 0 && list[j - 1].covered.begin > moved.covered.begin; --j) list[j] = list[j - 1];
    list[j] = moved;
  }
}

}  // namespace

void ActiveList::add(const Patch& patch) {
  const int row = std::max(patch.y0, first_) - first_;
  if (patch.y1 <= first_ || row >= static_cast<int>(buckets_.size())) return;
  buckets_[static_cast<std::size_t>(row)].push_back({&patch, {}, crossings_.size()});
  crossings_.emplace_back(patch);
}

void ActiveList::moveTo(int y) {
  for (; next_ <= y; ++next_)
    for (const ActivePatch& starting : buckets_[static_cast<std::size_t>(next_ - first_)]) active_.push_back(starting);
  std::erase_if(active_, [&](const ActivePatch& a) { return a.patch->y1 <= y; });
  for (ActivePatch& a : active_) a.covered = crossings_[a.crossings].covered(*a.patch, corners_, y);
  const auto crossed =
      std::stable_partition(active_.begin(), active_.end(), [](const ActivePatch& a) { return !a.covered.empty(); });
  crossed_ = static_cast<std::size_t>(crossed - active_.begin());
  if (order_ == Order::none) return;
  if (y == first_)
    std::sort(active_.begin(), crossed,
              [](const ActivePatch& a, const ActivePatch& b) { return a.covered.begin < b.covered.begin; });
  else
    sortByInsertion({active_.data(), crossed_});
}

const VisibleRuns::Candidate& VisibleRuns::nearestAt(int x) const {
  const Candidate* best = &here_.front();
  double nearest = best->nearness.at(x);
  for (const Candidate& c : here_) {
    const double nearness = c.nearness.at(x);
    if (nearness > nearest || (nearness == nearest && c.patch->id < best->patch->id)) best = &c, nearest = nearness;
  }
  return *best;
}

void VisibleRuns::resolve(const Stretch& span, const Candidate& left, const Candidate& right,
                          std::vector<Run>& out) const {
  if (left.patch == right.patch) return append(span, left.patch, out);
  // The surface at the left end is the nearer of the two up to where they pass through each other.
  const Slope ahead{left.nearness.at0 - right.nearness.at0, left.nearness.perPixel - right.nearness.perPixel};
  const int cut = std::clamp(above(ahead, 0.0, span).end, span.begin + 1, span.end - 1);
  const Stretch before{span.begin, cut}, after{cut, span.end};
  resolve(before, left, nearestAt(cut - 1), out);
  resolve(after, nearestAt(cut), right, out);
}

void VisibleRuns::find(std::span<const ActivePatch> surfaces, int y, std::vector<Run>& out) {
  here_.clear(), out.clear();
  std::size_t next = 0;
  for (int x = 0; next < surfaces.size() || !here_.empty();) {
    if (here_.empty()) x = surfaces[next].covered.begin;
    for (; next < surfaces.size() && surfaces[next].covered.begin <= x; ++next) {
      const Patch& patch = *surfaces[next].patch;
      here_.push_back({&patch, alongRow(patch, 3, y), surfaces[next].covered.end});
    }
    int end = next < surfaces.size() ? surfaces[next].covered.begin : std::numeric_limits<int>::max();
    for (const Candidate& c : here_) end = std::min(end, c.end);
    resolve({x, end}, nearestAt(x), nearestAt(end - 1), out);
    std::erase_if(here_, [&](const Candidate& c) { return c.end <= end; });
    x = end;
  }
}

}  // namespace umbrage::raster
