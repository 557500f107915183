// Orders items so that neighbours in the list are neighbours in space: a tree without pointers.
//
// Large lists are first laid into cells that halve a sample of them again and again along its widest axis: one comparison an item and
// halving. Stretches of that order, which fit into the cache, are then halved exactly.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "umbrage/shadow/finders/threads.hpp"

namespace umbrage::shadow {

/// Levels of a tree with `arity` children a node over a list, whose leaves are runs of `leaf` items: node i of level k (0: the
/// leaves) is items [i, i + 1) x leaf x arity^k.
struct TreeShape {
  std::size_t leaf, arity;

  /// The largest run of a node that is smaller than n items; 0 when n fits into a leaf.
  [[nodiscard]] std::size_t childRun(std::size_t n) const {
    if (n <= leaf) return 0;
    std::size_t run = leaf;
    while (run * arity < n) run *= arity;
    return run;
  }
};

namespace spreading {

/// A number that orders like the float, above an index that makes it unique.
inline std::uint64_t sortable(float value, std::uint32_t index) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t ordered = (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
  return std::uint64_t{ordered} << 32 | index;
}

/// Moves the k smallest of different numbers to the front. Without branches on them, which a processor could not foresee.
inline void select(std::uint64_t* a, std::size_t n, std::size_t k) {
  constexpr std::size_t kSmall = 8;  // more have five different places to sample
  while (n > kSmall) {
    std::array<std::uint64_t, 5> sample{a[0], a[n / 4], a[n / 2], a[n - n / 4], a[n - 1]};
    for (std::size_t i = 1; i < sample.size(); ++i)
      for (std::size_t j = i; j > 0; --j) {
        const std::uint64_t a0 = sample[j - 1], a1 = sample[j];
        sample[j - 1] = std::min(a0, a1), sample[j] = std::max(a0, a1);
      }
    // Larger than one of the sample and smaller than another, so neither part is empty.
    const std::uint64_t pivot = sample[std::clamp<std::size_t>(k * 5 / n, 1, 3)];
    std::size_t less = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t value = a[i];
      a[i] = a[less];
      a[less] = value;
      less += value < pivot ? 1 : 0;
    }
    if (k == less) return;
    if (k < less) {
      n = less;
    } else {
      a += less, n -= less, k -= less;
    }
  }
  std::sort(a, a + n);
}

/// The axis along which some of the items lie farthest apart. A sample tells as much as all of them.
template <int Axes, class At>
int widestAxis(std::size_t count, const At& at) {
  constexpr std::size_t kSample = 16;
  std::array<float, Axes> low, high;
  low.fill(std::numeric_limits<float>::max());
  high.fill(std::numeric_limits<float>::lowest());
  const std::size_t step = std::max<std::size_t>(1, count / kSample);
  for (std::size_t i = 0; i < count; i += step) {
    for (int k = 0; k < Axes; ++k) {
      const float value = at(i, k);
      low[k] = std::min(low[k], value);
      high[k] = std::max(high[k], value);
    }
  }
  int widest = 0;
  for (int k = 1; k < Axes; ++k)
    if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
  return widest;
}

/// Exact halvings at borders of runs, of numbers into `items`. `room` holds as many words.
template <int Axes, class Item, class Key>
void halve(const Item* items, std::span<std::uint32_t> order, std::uint64_t* room, const TreeShape& shape,
           const Key& key) {
  const std::size_t run = shape.childRun(order.size());
  if (run == 0) return;
  const std::size_t runs = (order.size() + run - 1) / run, half = (runs + 1) / 2 * run;
  const int axis = widestAxis<Axes>(order.size(), [&](std::size_t i, int k) { return key(items[order[i]], k); });
  for (std::size_t i = 0; i < order.size(); ++i) room[i] = sortable(key(items[order[i]], axis), order[i]);
  select(room, order.size(), half);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(room[i]);
  halve<Axes>(items, order.first(half), room, shape, key);
  halve<Axes>(items, order.subspan(half), room, shape, key);
}

/// A complete tree of planes: cell i of level k goes left at node 2^k - 1 + i.
struct Cells {
  struct Plane {
    int axis;
    float at;
  };
  unsigned levels = 0;
  std::vector<Plane> planes;

  /// Of all items. Several at a time, since each step waits for the one before.
  template <class Item, class Key>
  [[nodiscard]] std::vector<std::uint32_t> cellsOf(std::span<const Item> items, unsigned threads,
                                                   const Key& key) const {
    std::vector<std::uint32_t> cells(items.size());
    inParts(items.size(), 1, threads,
            [&](unsigned, std::size_t begin, std::size_t end) { lay(items, begin, end, key, cells); });
    return cells;
  }

 private:
  template <class Item, class Key>
  void lay(std::span<const Item> items, std::size_t begin, std::size_t end, const Key& key,
           std::vector<std::uint32_t>& cells) const {
    constexpr std::size_t kTogether = 8;
    for (std::size_t i = begin; i < end; i += kTogether) {
      std::array<std::uint32_t, kTogether> node{};
      const std::size_t count = std::min(kTogether, end - i);
      for (unsigned level = 0; level < levels; ++level)
        for (std::size_t j = 0; j < count; ++j) {
          const Plane plane = planes[node[j]];
          node[j] = 2 * node[j] + 1 + (key(items[i + j], plane.axis) >= plane.at ? 1 : 0);
        }
      for (std::size_t j = 0; j < count; ++j) cells[i + j] = node[j] + 1 - (1u << levels);
    }
  }
};

template <int Axes, class Item, class Key>
void divide(Cells& cells, std::span<Item> sample, std::size_t node, const Key& key) {
  if (node >= cells.planes.size()) return;
  const int axis = widestAxis<Axes>(sample.size(), [&](std::size_t i, int k) { return key(sample[i], k); });
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end(),
                   [&](const Item& a, const Item& b) { return key(a, axis) < key(b, axis); });
  cells.planes[node] = {axis, key(*middle, axis)};
  divide<Axes>(cells, sample.first(sample.size() / 2), 2 * node + 1, key);
  divide<Axes>(cells, sample.subspan(sample.size() / 2), 2 * node + 2, key);
}

/// The items' numbers cell by cell; about `perCell` share one.
template <int Axes, class Item, class Key>
std::vector<std::uint32_t> byCells(std::span<const Item> items, std::size_t perCell, unsigned threads, const Key& key) {
  constexpr std::size_t kSamples = 16;  // a cell
  Cells cells;
  cells.levels = static_cast<unsigned>(std::bit_width(items.size() / perCell));
  cells.planes.resize((std::size_t{1} << cells.levels) - 1);
  std::vector<Item> sample;
  const std::size_t step = std::max<std::size_t>(1, items.size() / (kSamples << cells.levels));
  for (std::size_t i = 0; i < items.size(); i += step) sample.push_back(items[i]);
  divide<Axes>(cells, std::span(sample), 0, key);
  const std::vector<std::uint32_t> cell = cells.cellsOf(items, threads, key);
  std::vector<std::uint32_t> next((std::size_t{1} << cells.levels) + 1, 0), order(items.size());
  for (const std::uint32_t c : cell) ++next[c + 1];
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  for (std::uint32_t i = 0; i < items.size(); ++i) order[next[cell[i]]++] = i;
  return order;
}

inline std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  for (std::uint32_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

}  // namespace spreading

/// Halves the items again and again along their widest axis. `key(item, axis)` is finite. Calls emit(first, ordered) for one stretch of
/// the order after the other, whose borders are those of nodes; from several threads at once.
/// 1. The order depends on the items alone, not on the number of threads.
template <int Axes, class Item, class Key, class Emit>
void spread(std::span<const Item> items, const TreeShape& shape, const Key& key, unsigned threads, const Emit& emit) {
  const std::size_t stretch = shape.leaf * shape.arity * 8;
  const std::vector<std::uint32_t> order = items.size() > 4 * stretch
                                               ? spreading::byCells<Axes>(items, stretch, threads, key)
                                               : spreading::numbers(items.size());
  const std::size_t stretches = (items.size() + stretch - 1) / stretch;
  const auto parts = static_cast<unsigned>(std::clamp<std::size_t>(stretches / 16, 1, threads));
  inParts(stretches, 1, parts, [&](unsigned, std::size_t firstStretch, std::size_t lastStretch) {
    std::vector<Item> here, ordered;  // small enough for the cache
    std::vector<std::uint64_t> room(stretch);
    for (std::size_t first = firstStretch * stretch; first < std::min(lastStretch * stretch, items.size());
         first += stretch) {
      const auto numbers = std::span(order).subspan(first, std::min(stretch, items.size() - first));
      here.clear(), ordered.clear();
      for (const std::uint32_t i : numbers) here.push_back(items[i]);
      std::vector<std::uint32_t> local = spreading::numbers(here.size());
      spreading::halve<Axes>(here.data(), std::span(local), room.data(), shape, key);
      for (const std::uint32_t i : local) ordered.push_back(here[i]);
      emit(first, std::span<const Item>(ordered));
    }
  });
}

}  // namespace umbrage::shadow
