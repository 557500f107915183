#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/math/box.hpp"

namespace umbrage::cut::detail {

/// Boxes in a tree, to find those that meet something.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box3>& boxes);

  /// Calls visit(item) for every box of which `meets(box)` is not false, until it answers false. Whole subtrees are passed over by their boxes.
  template <class Meets, class Visit>
  void visit(Meets&& meets, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, 64> open;  // deeper than halving 2^32 items in equal parts gets
    std::size_t count = 0;
    open[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[open[--count]];
      if (!meets(node.box)) continue;
      if (node.count == 0) {
        open[count++] = node.first + 1;
        open[count++] = node.first;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (!visit(items_[i])) return;
    }
  }

 private:
  struct Node {
    Box3 box;
    std::uint32_t first = 0, count = 0;  ///< of its items; count 0: of its two children
  };
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
};

}  // namespace umbrage::cut::detail
