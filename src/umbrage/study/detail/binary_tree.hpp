#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "umbrage/math/box.hpp"

namespace umbrage::study::detail {

/// Boxes halved again and again, by the surface area heuristic.
struct BinaryTree {
  struct Node {
    Box3 box;
    std::size_t begin, end;  ///< of `order`
    std::int32_t left = -1;  ///< the right one follows it; -1: a leaf
  };
  std::vector<std::uint32_t> order;  ///< the boxes' numbers
  std::vector<Node> nodes;           ///< the root first

  [[nodiscard]] bool isLeaf(std::size_t node) const { return nodes[node].left < 0; }
};

/// Leaves hold at most `leafSize` boxes, in nodes at most 40 + log2 of their number deep.
[[nodiscard]] BinaryTree buildBinaryTree(const std::vector<Box3>& boxes, std::size_t leafSize);

/// Half the surface of a box.
[[nodiscard]] double halfArea(const Box3& box);

}  // namespace umbrage::study::detail
