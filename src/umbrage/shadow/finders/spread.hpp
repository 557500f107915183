// Orders items so that neighbours in the list are neighbours in space: a tree without pointers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <thread>

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

/// The axis along which some of the items lie farthest apart. A sample tells as much as all of them.
template <int Axes, class Item, class Key>
int widestAxis(std::span<const Item> items, const Key& key) {
  constexpr std::size_t kSample = 128;
  std::array<float, Axes> low, high;
  low.fill(std::numeric_limits<float>::max());
  high.fill(std::numeric_limits<float>::lowest());
  const std::size_t step = std::max<std::size_t>(1, items.size() / kSample);
  for (std::size_t i = 0; i < items.size(); i += step) {
    for (int k = 0; k < Axes; ++k) {
      const float value = key(items[i], k);
      low[k] = std::min(low[k], value);
      high[k] = std::max(high[k], value);
    }
  }
  int widest = 0;
  for (int k = 1; k < Axes; ++k)
    if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
  return widest;
}

/// Halves the items again and again along their widest axis, at borders of runs. `key(item, axis)` is finite.
/// 1. The order depends on the items alone, not on the number of threads.
template <int Axes, class Item, class Key>
void spread(std::span<Item> items, const TreeShape& shape, const Key& key, unsigned threads) {
  constexpr std::size_t kWorthAThread = 100'000;
  const std::size_t run = shape.childRun(items.size());
  if (run == 0) return;
  const std::size_t runs = (items.size() + run - 1) / run, half = (runs + 1) / 2 * run;
  const int axis = widestAxis<Axes, Item>(items, key);
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](const Item& a, const Item& b) { return key(a, axis) < key(b, axis); });
  const auto first = items.first(half), rest = items.subspan(half);
  if (threads < 2 || items.size() < kWorthAThread) {
    spread<Axes>(first, shape, key, 1);
    spread<Axes>(rest, shape, key, 1);
    return;
  }
  std::jthread other([&] { spread<Axes>(first, shape, key, threads / 2); });
  spread<Axes>(rest, shape, key, threads - threads / 2);
}

}  // namespace umbrage::shadow
