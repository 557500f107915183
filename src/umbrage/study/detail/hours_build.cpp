#include "umbrage/study/detail/hours_build.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace umbrage::study::detail {
namespace {

constexpr std::size_t kLeafQuads = 6;  // eight fit; six leave fewer boxes that are only met for one of them
constexpr int kBins = 32;
constexpr int kDeepest = 40;  // beyond it halves are taken, so that the stack of the traversal is never exceeded

struct BinaryNode {
  Box3 box;
  std::size_t begin, end;
  std::int32_t left = -1;  // the right one follows; -1: a leaf
};

double area(const Box3& box) {
  const Vec3 s = box.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

std::size_t leavesFor(std::size_t quads) { return (quads + kLeafQuads - 1) / kLeafQuads; }

// By the surface area heuristic, in bins.
class BinaryTree {
 public:
  explicit BinaryTree(const std::vector<Box3>& boxes) : boxes_(boxes), order(boxes.size()) {
    std::iota(order.begin(), order.end(), 0u);
    nodes.reserve(2 * leavesFor(boxes.size()) + 2);
    nodes.push_back({{}, 0, boxes.size()});
    for (const Box3& b : boxes) centres_.push_back(b.centre());
    split(0, 0);
  }

 private:
  const std::vector<Box3>& boxes_;
  std::vector<Vec3> centres_;

 public:
  std::vector<std::uint32_t> order;
  std::vector<BinaryNode> nodes;

 private:
  struct Cut {
    int axis = -1, bin = 0;
    double cost = std::numeric_limits<double>::infinity();
  };
  struct Bin {
    Box3 box;
    std::size_t count = 0;
  };

  static int binOf(double x, double low, double width) {
    return std::clamp(static_cast<int>((x - low) / width * kBins), 0, kBins - 1);
  }

  void cutAlong(int axis, const BinaryNode& node, const Box3& centres, Cut& best) const {
    const double low = centres.min[axis], width = centres.max[axis] - low;
    if (!(width > 0.0)) return;
    std::array<Bin, kBins> bins;
    for (std::size_t i = node.begin; i < node.end; ++i) {
      Bin& bin = bins[static_cast<std::size_t>(binOf(centres_[order[i]][axis], low, width))];
      bin.box.add(boxes_[order[i]]);
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
          area(before.box) * double(leavesFor(before.count)) + area(rest.box) * double(leavesFor(rest.count));
      if (cost < best.cost) best = {axis, k, cost};
    }
  }

  void split(std::size_t index, int depth) {
    BinaryNode node = nodes[index];
    Box3 centres;
    for (std::size_t i = node.begin; i < node.end; ++i) {
      node.box.add(boxes_[order[i]]);
      centres.add(centres_[order[i]]);
    }
    if (node.end - node.begin > kLeafQuads) {
      Cut cut;
      if (depth < kDeepest)
        for (int axis = 0; axis < 3; ++axis) cutAlong(axis, node, centres, cut);
      const auto begin = order.begin() + static_cast<std::ptrdiff_t>(node.begin);
      const auto end = order.begin() + static_cast<std::ptrdiff_t>(node.end);
      std::size_t middle = (node.begin + node.end) / 2;
      if (cut.axis >= 0) {
        const double low = centres.min[cut.axis], width = centres.max[cut.axis] - low;
        const auto at = std::partition(
            begin, end, [&](std::uint32_t q) { return binOf(centres_[q][cut.axis], low, width) <= cut.bin; });
        middle = static_cast<std::size_t>(at - order.begin());
      }
      node.left = static_cast<std::int32_t>(nodes.size());
      nodes.push_back({{}, node.begin, middle});
      nodes.push_back({{}, middle, node.end});
      nodes[index] = node;
      split(static_cast<std::size_t>(node.left), depth + 1);
      split(static_cast<std::size_t>(node.left) + 1, depth + 1);
      return;
    }
    nodes[index] = node;
  }
};

// Gathers the binary tree into one of eight children.
class Gatherer {
 public:
  Gatherer(const scene::Surfaces& surfaces, const Casters& casters, const SkyFrame& frame, const BinaryTree& binary,
           double margin, HoursTree& out)
      : surfaces_(surfaces), casters_(casters), frame_(frame), binary_(binary), margin_(margin), out_(out) {
    out_.root = binary.nodes[0].left < 0 && !binary.order.empty() ? single() : gather(0);
  }
  std::vector<double> sizes;

 private:
  const scene::Surfaces& surfaces_;
  const Casters& casters_;
  const SkyFrame& frame_;
  const BinaryTree& binary_;
  double margin_;
  HoursTree& out_;

  std::int32_t leaf(const BinaryNode& node) {
    TreeLeaf leaf{};
    leaf.quads = static_cast<std::uint32_t>(out_.quads.size());
    std::fill(std::begin(leaf.solid), std::end(leaf.solid), -2);
    for (std::size_t i = node.begin, lane = 0; i < node.end; ++i, ++lane) {
      const CasterQuad& caster = casters_.quads[binary_.order[i]];
      TreeQuad quad{};
      Vec3 corner[4];
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3f& p = surfaces_.positions[caster.corners[k]];
        quad.x[k] = p.x, quad.y[k] = p.y, quad.z[k] = p.z;
        corner[k] = Vec3(p);
      }
      out_.quads.push_back(quad);
      // Twice the area, of both triangles.
      const Vec3 area = glm::cross(corner[2] - corner[0], corner[3] - corner[0]) +
                        glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      const double size = glm::length(area);
      if (!(size > 0.0)) continue;
      leaf.x[lane] = quad.x[0], leaf.y[lane] = quad.y[0], leaf.z[lane] = quad.z[0];
      leaf.nx[lane] = float(area.x / size), leaf.ny[lane] = float(area.y / size), leaf.nz[lane] = float(area.z / size);
      leaf.solid[lane] = caster.solid;
      leaf.used |= 1u << lane;
      if (caster.solid < 0) leaf.open |= 1u << lane;
      if (glm::dot(area, frame_.up) >= size * (1.0 - 1e-12)) leaf.flatUp |= 1u << lane;
    }
    TreeNode box = emptyNode();
    place(box, 0, node.box);
    leaf.first = box.first[0], leaf.west = box.west[0], leaf.south = box.south[0], leaf.flat = box.flat[0];
    leaf.east = box.east[0], leaf.north = box.north[0], leaf.up = box.up[0];
    const Vec3 size = node.box.size();
    sizes.push_back(std::max({size.x, size.y, size.z}));
    out_.leaves.push_back(leaf);
    return ~static_cast<std::int32_t>(out_.leaves.size() - 1);
  }

  static TreeNode emptyNode() {
    TreeNode node{};
    std::fill(std::begin(node.south), std::end(node.south), 1e18f);
    return node;
  }

  void place(TreeNode& node, std::size_t lane, const Box3& box) const {
    const Vec3 horizontal = box.centre(), half = 0.5 * box.size() + Vec3(margin_);
    const Vec3 middle =
        frame_.turning(horizontal.x * frame_.east + horizontal.y * frame_.north + horizontal.z * frame_.up);
    node.first[lane] = float(middle.x), node.west[lane] = float(middle.y), node.south[lane] = float(middle.z);
    node.east[lane] = float(half.x), node.north[lane] = float(half.y), node.up[lane] = float(half.z);
    const double along = half.y * std::abs(frame_.sinLatitude) + half.z * std::abs(frame_.cosLatitude);
    node.flat[lane] = float(std::hypot(along, half.x) * (1.0 + 1e-6));
  }

  std::int32_t single() {
    TreeNode node = emptyNode();
    place(node, 0, binary_.nodes[0].box);
    node.child[0] = leaf(binary_.nodes[0]);
    out_.nodes.push_back(node);
    return 0;
  }

  std::int32_t gather(std::size_t index) {
    if (binary_.nodes[index].left < 0) return leaf(binary_.nodes[index]);
    const auto left = static_cast<std::size_t>(binary_.nodes[index].left);
    std::vector<std::size_t> children{left, left + 1};
    while (children.size() < 8) {
      std::size_t widest = children.size();
      for (std::size_t i = 0; i < children.size(); ++i)
        if (binary_.nodes[children[i]].left >= 0 &&
            (widest == children.size() ||
             area(binary_.nodes[children[i]].box) > area(binary_.nodes[children[widest]].box)))
          widest = i;
      if (widest == children.size()) break;
      const auto inner = static_cast<std::size_t>(binary_.nodes[children[widest]].left);
      children[widest] = inner;
      children.push_back(inner + 1);
    }
    const std::size_t here = out_.nodes.size();
    out_.nodes.emplace_back();
    TreeNode node = emptyNode();
    for (std::size_t i = 0; i < children.size(); ++i) {
      place(node, i, binary_.nodes[children[i]].box);
      node.child[i] = gather(children[i]);
    }
    out_.nodes[here] = node;
    return static_cast<std::int32_t>(here);
  }
};

}  // namespace

HoursTree buildTree(const scene::Surfaces& surfaces, const Casters& casters, const SkyFrame& frame) {
  HoursTree tree;
  std::vector<Box3> boxes(casters.quads.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (const std::uint32_t corner : casters.quads[i].corners) {
      const Vec3 p(surfaces.positions[corner]);
      boxes[i].add(frame.horizontal(p));
      tree.reach = std::max({tree.reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  if (boxes.empty()) return tree;
  const BinaryTree binary(boxes);
  // Middles and points are rounded to single precision in a turned frame.
  Gatherer gatherer(surfaces, casters, frame, binary, 0x1p-21 * tree.reach, tree);
  std::nth_element(gatherer.sizes.begin(),
                   gatherer.sizes.begin() + static_cast<std::ptrdiff_t>(gatherer.sizes.size() / 2),
                   gatherer.sizes.end());
  tree.leafSize = gatherer.sizes[gatherer.sizes.size() / 2];
  return tree;
}

}  // namespace umbrage::study::detail
