#include "umbrage/outline/detail/winding.hpp"

#include <algorithm>
#include <cstdlib>

namespace umbrage::outline::detail {
namespace {

// An edge from its lower to its higher index, and how often it is run through that way.
struct Run {
  std::uint64_t key;
  int times;
};
struct Step {
  std::uint32_t from, to;
};

void addEdge(std::vector<Run>& runs, std::uint32_t from, std::uint32_t to) {
  const bool up = from < to;
  const std::uint64_t low = up ? from : to, high = up ? to : from;
  runs.push_back({low << 32 | high, up ? 1 : -1});
}

std::vector<Step> uncancelled(std::vector<Run>& runs) {
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.key < b.key; });
  std::vector<Step> steps;
  for (std::size_t i = 0; i < runs.size();) {
    const std::uint64_t key = runs[i].key;
    int times = 0;
    for (; i < runs.size() && runs[i].key == key; ++i) times += runs[i].times;
    const auto low = static_cast<std::uint32_t>(key >> 32), high = static_cast<std::uint32_t>(key);
    for (int n = std::abs(times); n > 0; --n) steps.push_back(times > 0 ? Step{low, high} : Step{high, low});
  }
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.from < b.from; });
  return steps;
}

// As many steps leave each point as arrive at it, so that every walk ends where it began.
std::vector<Loop> chain(const std::vector<Step>& steps, std::span<const GridPoint> points) {
  const auto firstFrom = [&](std::uint32_t point) {
    return std::size_t(
        std::lower_bound(steps.begin(), steps.end(), point, [](const Step& s, std::uint32_t p) { return s.from < p; }) -
        steps.begin());
  };
  std::vector<char> used(steps.size(), 0);
  std::vector<Loop> loops;
  for (std::size_t start = 0; start < steps.size(); ++start) {
    if (used[start] != 0) continue;
    Loop loop;
    for (std::size_t at = start;;) {
      used[at] = 1;
      if (loop.empty() || loop.back() != points[steps[at].from]) loop.push_back(points[steps[at].from]);
      if (steps[at].to == steps[start].from) break;
      at = firstFrom(steps[at].to);
      while (used[at] != 0) ++at;
    }
    if (loop.size() > 2) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

std::vector<Loop> windingLoops(std::span<const GridPoint> points, std::span<const mesh::Triangle> triangles) {
  std::vector<Run> runs;
  runs.reserve(3 * triangles.size());
  for (const mesh::Triangle& t : triangles) {
    const std::int64_t side = turn(points[t[0]], points[t[1]], points[t[2]]);
    if (side == 0) continue;
    const int b = side > 0 ? 1 : 2;
    addEdge(runs, t[0], t[b]);
    addEdge(runs, t[b], t[3 - b]);
    addEdge(runs, t[3 - b], t[0]);
  }
  return chain(uncancelled(runs), points);
}

}  // namespace umbrage::outline::detail
