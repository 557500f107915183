#include "umbrage/mesh/edge_table.hpp"

#include <algorithm>

namespace umbrage::mesh {
namespace {

struct Entry {
  std::uint32_t high;
  std::uint32_t triangle;
  std::uint8_t opposite;
};

// Calls fn(low end, entry) for every proper edge of every triangle, in order.
template <class Fn>
void forEachEdge(std::span<const Triangle> triangles, const Fn& fn) {
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3]);
      if (low != high) fn(low, Entry{high, t, k});
    }
  }
}

// Entries gathered by their lower end: those of end i are [begin[i], begin[i + 1]). A counting sort, since a sort of all entries
// by comparisons is what would dominate the preparation of a large scene.
struct Buckets {
  std::vector<std::uint32_t> begin;
  std::vector<Entry> entries;
};

Buckets gather(std::span<const Triangle> triangles) {
  std::uint32_t corners = 0;
  for (const Triangle& t : triangles) corners = std::max({corners, t[0] + 1, t[1] + 1, t[2] + 1});
  Buckets buckets;
  buckets.begin.assign(std::size_t{corners} + 1, 0);
  forEachEdge(triangles, [&](std::uint32_t low, const Entry&) { ++buckets.begin[low + 1]; });
  for (std::size_t i = 0; i < corners; ++i) buckets.begin[i + 1] += buckets.begin[i];
  buckets.entries.resize(buckets.begin.back());
  std::vector<std::uint32_t> next = buckets.begin;
  forEachEdge(triangles, [&](std::uint32_t low, const Entry& entry) { buckets.entries[next[low]++] = entry; });
  return buckets;
}

}  // namespace

EdgeTable buildEdgeTable(std::span<const Triangle> triangles) {
  EdgeTable table;
  Buckets buckets = gather(triangles);
  table.uses.reserve(buckets.entries.size());
  table.ends.reserve(buckets.entries.size() / 2);
  table.begin.reserve(buckets.entries.size() / 2 + 1);
  for (std::uint32_t low = 0; low + 1 < buckets.begin.size(); ++low) {
    const auto bucket =
        std::span(buckets.entries).subspan(buckets.begin[low], buckets.begin[low + 1] - buckets.begin[low]);
    // Entries came in the order of the triangles; among equal edges it must stay.
    std::sort(bucket.begin(), bucket.end(), [](const Entry& a, const Entry& b) {
      return a.high != b.high ? a.high < b.high
                              : (a.triangle != b.triangle ? a.triangle < b.triangle : a.opposite < b.opposite);
    });
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      if (i == 0 || bucket[i].high != bucket[i - 1].high) {
        table.begin.push_back(static_cast<std::uint32_t>(table.uses.size()));
        table.ends.push_back({low, bucket[i].high});
      }
      table.uses.push_back({bucket[i].triangle, bucket[i].opposite});
    }
  }
  table.begin.push_back(static_cast<std::uint32_t>(table.uses.size()));
  return table;
}

}  // namespace umbrage::mesh
