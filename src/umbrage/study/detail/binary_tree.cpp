#include "umbrage/study/detail/binary_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace umbrage::study::detail {
namespace {

constexpr int kBins = 32;
constexpr int kDeepest = 40;  // beyond it halves are taken, so that the stack of a traversal is never exceeded

class Builder {
 public:
  Builder(const std::vector<Box3>& boxes, std::size_t leafSize, BinaryTree& tree)
      : boxes_(boxes), leafSize_(leafSize), tree_(tree) {
    tree_.order.resize(boxes.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0u);
    tree_.nodes.reserve(2 * leavesFor(boxes.size()) + 2);
    tree_.nodes.push_back({{}, 0, boxes.size()});
    centres_.reserve(boxes.size());
    for (const Box3& b : boxes) centres_.push_back(b.centre());
    split(0, 0);
  }

 private:
  struct Cut {
    int axis = -1, bin = 0;
    double cost = std::numeric_limits<double>::infinity();
  };
  struct Bin {
    Box3 box;
    std::size_t count = 0;
  };

  [[nodiscard]] std::size_t leavesFor(std::size_t count) const { return (count + leafSize_ - 1) / leafSize_; }

  static int binOf(double x, double low, double width) {
    return std::clamp(static_cast<int>((x - low) / width * kBins), 0, kBins - 1);
  }

  void cutAlong(int axis, const BinaryTree::Node& node, const Box3& centres, Cut& best) const {
    const double low = centres.min[axis], width = centres.max[axis] - low;
    if (!(width > 0.0)) return;
    std::array<Bin, kBins> bins;
    for (std::size_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t box = tree_.order[i];
      Bin& bin = bins[static_cast<std::size_t>(binOf(centres_[box][axis], low, width))];
      bin.box.add(boxes_[box]);
      ++bin.count;
    }
    std::array<Bin, kBins> behind;  // all from a bin on
    behind[kBins - 1] = bins[kBins - 1];
    for (std::size_t k = kBins - 1; k-- > 0;) {
      behind[k] = behind[k + 1];
      behind[k].box.add(bins[k].box);
      behind[k].count += bins[k].count;
    }
    Bin before;
    for (int k = 0; k + 1 < kBins; ++k) {
      before.box.add(bins[static_cast<std::size_t>(k)].box);
      before.count += bins[static_cast<std::size_t>(k)].count;
      const Bin& rest = behind[static_cast<std::size_t>(k + 1)];
      if (before.count == 0 || rest.count == 0) continue;
      const double cost =
          halfArea(before.box) * double(leavesFor(before.count)) + halfArea(rest.box) * double(leavesFor(rest.count));
      if (cost < best.cost) best = {axis, k, cost};
    }
  }

  void split(std::size_t index, int depth) {
    BinaryTree::Node node = tree_.nodes[index];
    Box3 centres;
    for (std::size_t i = node.begin; i < node.end; ++i) {
      node.box.add(boxes_[tree_.order[i]]);
      centres.add(centres_[tree_.order[i]]);
    }
    tree_.nodes[index] = node;
    if (node.end - node.begin <= leafSize_) return;
    const std::size_t middle = partition(node, centres, depth);
    tree_.nodes[index].left = static_cast<std::int32_t>(tree_.nodes.size());
    const auto left = static_cast<std::size_t>(tree_.nodes[index].left);
    tree_.nodes.push_back({{}, node.begin, middle});
    tree_.nodes.push_back({{}, middle, node.end});
    split(left, depth + 1);
    split(left + 1, depth + 1);
  }

  // Puts the boxes of a node in order and says where the right half begins.
  std::size_t partition(const BinaryTree::Node& node, const Box3& centres, int depth) {
    Cut cut;
    if (depth < kDeepest)
      for (int axis = 0; axis < 3; ++axis) cutAlong(axis, node, centres, cut);
    if (cut.axis < 0) return (node.begin + node.end) / 2;
    const double low = centres.min[cut.axis], width = centres.max[cut.axis] - low;
    const auto at = std::partition(tree_.order.begin() + static_cast<std::ptrdiff_t>(node.begin),
                                   tree_.order.begin() + static_cast<std::ptrdiff_t>(node.end), [&](std::uint32_t box) {
                                     return binOf(centres_[box][cut.axis], low, width) <= cut.bin;
                                   });
    return static_cast<std::size_t>(at - tree_.order.begin());
  }

  const std::vector<Box3>& boxes_;
  std::size_t leafSize_;
  BinaryTree& tree_;
  std::vector<Vec3> centres_;
};

}  // namespace

double halfArea(const Box3& box) {
  const Vec3 s = box.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

BinaryTree buildBinaryTree(const std::vector<Box3>& boxes, std::size_t leafSize) {
  BinaryTree tree;
  Builder(boxes, leafSize, tree);
  return tree;
}

}  // namespace umbrage::study::detail
