#include "umbrage/outline/detail/sweep.hpp"

#include <algorithm>
#include <array>

namespace umbrage::outline::detail {
namespace {

int signOf(std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

// An edge from its lower to its higher index, seen by one of its triangles before and after.
struct Side {
  std::uint64_t key;
  int before, after;  // the triangle's turn, with the sense in which it runs through the edge
};

void addSide(std::vector<Side>& sides, std::uint32_t a, std::uint32_t b, int before, int after) {
  const int sense = a < b ? 1 : -1;
  const std::uint64_t low = std::min(a, b), high = std::max(a, b);
  sides.push_back({low << 32 | high, sense * before, sense * after});
}

// Counter-clockwise; Andrew's monotone chain, 1979.
Loop hull(std::array<GridPoint, 4> points) {
  std::sort(points.begin(), points.end(),
            [](const GridPoint& a, const GridPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::array<GridPoint, 9> chain;
  std::size_t size = 0;
  const auto add = [&](const GridPoint& p, std::size_t least) {
    while (size >= least + 2 && turn(chain[size - 2], chain[size - 1], p) <= 0) --size;
    chain[size++] = p;
  };
  for (const GridPoint& p : points) add(p, 0);
  const std::size_t lower = size - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  return Loop(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(size - 1));
}

}  // namespace

std::vector<Loop> sweptEdges(std::span<const GridPoint> from, std::span<const GridPoint> to,
                             std::span<const mesh::Triangle> triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (const mesh::Triangle& t : triangles) {
    const int before = signOf(turn(from[t[0]], from[t[1]], from[t[2]]));
    const int after = signOf(turn(to[t[0]], to[t[1]], to[t[2]]));
    for (int k = 0; k < 3; ++k) addSide(sides, t[k], t[(k + 1) % 3], before, after);
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
  std::vector<Loop> loops;
  for (std::size_t i = 0; i < sides.size();) {
    const std::uint64_t key = sides[i].key;
    int before = 0;
    bool turns = false;  // a triangle's turn is linear in time: with the same sign at both ends it has it throughout
    for (; i < sides.size() && sides[i].key == key; ++i) {
      before += sides[i].before;
      turns = turns || sides[i].before != sides[i].after;
    }
    if (before == 0 && !turns) continue;
    const auto a = static_cast<std::uint32_t>(key >> 32), b = static_cast<std::uint32_t>(key);
    if (Loop loop = hull({from[a], from[b], to[a], to[b]}); loop.size() > 2) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace umbrage::outline::detail
