#include "umbrage/mesh/edge_table.hpp"

#include <algorithm>

namespace umbrage::mesh {
namespace {

struct Entry {
  std::uint64_t key;  // lower end in the high half, so that entries sort by ends
  std::uint32_t triangle;
  std::uint8_t opposite;
};

std::vector<Entry> sortedEntries(std::span<const Triangle> triangles) {
  std::vector<Entry> entries;
  entries.reserve(triangles.size() * 3);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3]);
      if (low != high) entries.push_back({std::uint64_t{low} << 32 | high, t, k});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key < b.key : (a.triangle != b.triangle ? a.triangle < b.triangle : a.opposite < b.opposite);
  });
  return entries;
}

}  // namespace

EdgeTable buildEdgeTable(std::span<const Triangle> triangles) {
  EdgeTable table;
  const auto entries = sortedEntries(triangles);
  table.uses.reserve(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || entries[i].key != entries[i - 1].key) {
      table.begin.push_back(static_cast<std::uint32_t>(i));
      table.ends.push_back({static_cast<std::uint32_t>(entries[i].key >> 32), static_cast<std::uint32_t>(entries[i].key)});
    }
    table.uses.push_back({entries[i].triangle, entries[i].opposite});
  }
  table.begin.push_back(static_cast<std::uint32_t>(entries.size()));
  return table;
}

}  // namespace umbrage::mesh
