#include "umbrage/study/detail/hours_build.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/study/detail/binary_tree.hpp"
#include "umbrage/study/detail/hours_balls.hpp"

namespace umbrage::study::detail {
namespace {

constexpr std::size_t kLeafQuads = 6;  // eight fit; six leave fewer boxes that are only met for one of them
constexpr std::size_t kLeafBalls = 8;

TreeNode emptyNode() {
  TreeNode node{};
  std::fill(std::begin(node.south), std::end(node.south), 1e18f);
  return node;
}

// Boxes of the horizontal frame into nodes.
struct Placing {
  const SkyFrame& frame;
  double margin;  // of rounding middles and points to single precision in a turned frame

  void place(TreeNode& node, std::size_t lane, const Box3& box) const {
    const Vec3 horizontal = box.centre(), half = 0.5 * box.size() + Vec3(margin);
    const Vec3 middle = frame.turning(horizontal.x * frame.east + horizontal.y * frame.north + horizontal.z * frame.up);
    node.first[lane] = float(middle.x), node.west[lane] = float(middle.y), node.south[lane] = float(middle.z);
    node.east[lane] = float(half.x), node.north[lane] = float(half.y), node.up[lane] = float(half.z);
    const double along = half.y * std::abs(frame.sinLatitude) + half.z * std::abs(frame.cosLatitude);
    node.flat[lane] = float(std::hypot(along, half.x) * (1.0 + 1e-6));
  }
};

// Gathers a binary tree into one of eight children; makeLeaf(node) makes a leaf and gives its number.
template <class MakeLeaf>
class Gatherer {
 public:
  Gatherer(const Placing& placing, const BinaryTree& binary, const MakeLeaf& makeLeaf, std::vector<TreeNode>& out)
      : placing_(placing), binary_(binary), makeLeaf_(makeLeaf), out_(out) {}

  // The root.
  std::int32_t gather() { return binary_.isLeaf(0) ? single() : gather(0); }

 private:
  std::int32_t leaf(std::size_t index) { return ~makeLeaf_(binary_.nodes[index]); }

  std::int32_t single() {
    TreeNode node = emptyNode();
    placing_.place(node, 0, binary_.nodes[0].box);
    node.child[0] = leaf(0);
    out_.push_back(node);
    return static_cast<std::int32_t>(out_.size() - 1);
  }

  // Up to eight, by opening the widest again and again.
  [[nodiscard]] std::vector<std::size_t> childrenOf(std::size_t index) const {
    const auto left = static_cast<std::size_t>(binary_.nodes[index].left);
    std::vector<std::size_t> children{left, left + 1};
    while (children.size() < 8) {
      std::size_t widest = children.size();
      for (std::size_t i = 0; i < children.size(); ++i)
        if (!binary_.isLeaf(children[i]) &&
            (widest == children.size() ||
             halfArea(binary_.nodes[children[i]].box) > halfArea(binary_.nodes[children[widest]].box)))
          widest = i;
      if (widest == children.size()) break;
      const auto inner = static_cast<std::size_t>(binary_.nodes[children[widest]].left);
      children[widest] = inner;
      children.push_back(inner + 1);
    }
    return children;
  }

  std::int32_t gather(std::size_t index) {
    if (binary_.isLeaf(index)) return leaf(index);
    const std::vector<std::size_t> children = childrenOf(index);
    const std::size_t here = out_.size();
    out_.emplace_back();
    TreeNode node = emptyNode();
    for (std::size_t i = 0; i < children.size(); ++i) {
      placing_.place(node, i, binary_.nodes[children[i]].box);
      node.child[i] = gather(children[i]);
    }
    out_[here] = node;
    return static_cast<std::int32_t>(here);
  }

  const Placing& placing_;
  const BinaryTree& binary_;
  const MakeLeaf& makeLeaf_;
  std::vector<TreeNode>& out_;
};

// Makes leaves of quads.
class LeafMaker {
 public:
  LeafMaker(const scene::Surfaces& surfaces, const Casters& casters, const Placing& placing, const BinaryTree& binary,
            HoursTree& out)
      : surfaces_(surfaces), casters_(casters), placing_(placing), binary_(binary), out_(out) {}
  std::vector<double> sizes;

  std::int32_t make(const BinaryTree::Node& node) {
    TreeLeaf leaf{};
    leaf.quads = static_cast<std::uint32_t>(out_.quads.size());
    std::fill(std::begin(leaf.solid), std::end(leaf.solid), -2);
    for (std::size_t i = node.begin, lane = 0; i < node.end; ++i, ++lane)
      addQuad(casters_.quads[binary_.order[i]], lane, leaf);
    TreeNode box = emptyNode();
    placing_.place(box, 0, node.box);
    leaf.first = box.first[0], leaf.west = box.west[0], leaf.south = box.south[0], leaf.flat = box.flat[0];
    leaf.east = box.east[0], leaf.north = box.north[0], leaf.up = box.up[0];
    const Vec3 size = node.box.size();
    sizes.push_back(std::max({size.x, size.y, size.z}));
    out_.leaves.push_back(leaf);
    return static_cast<std::int32_t>(out_.leaves.size() - 1);
  }

 private:
  void addQuad(const CasterQuad& caster, std::size_t lane, TreeLeaf& leaf) {
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
    if (!(size > 0.0)) return;
    leaf.x[lane] = quad.x[0], leaf.y[lane] = quad.y[0], leaf.z[lane] = quad.z[0];
    leaf.nx[lane] = float(area.x / size), leaf.ny[lane] = float(area.y / size), leaf.nz[lane] = float(area.z / size);
    leaf.solid[lane] = caster.solid;
    leaf.used |= 1u << lane;
    if (caster.solid < 0) leaf.open |= 1u << lane;
    if (glm::dot(area, placing_.frame.up) >= size * (1.0 - 1e-12)) leaf.flatUp |= 1u << lane;
  }

  const scene::Surfaces& surfaces_;
  const Casters& casters_;
  const Placing& placing_;
  const BinaryTree& binary_;
  HoursTree& out_;
};

TreeBalls ballsOf(const BinaryTree& binary, const BinaryTree::Node& node, const std::vector<Ball>& balls,
                  const Placing& placing) {
  TreeBalls out{};
  std::fill(std::begin(out.south), std::end(out.south), 1e18f);
  for (std::size_t i = node.begin, lane = 0; i < node.end; ++i, ++lane) {
    const Ball& ball = balls[binary.order[i]];
    const Vec3 middle = placing.frame.turning(ball.centre);
    out.first[lane] = float(middle.x), out.west[lane] = float(middle.y), out.south[lane] = float(middle.z);
    out.radius[lane] = float(std::max(0.0, ball.radius * (1.0 - 1e-5) - 4.0 * placing.margin));
  }
  return out;
}

void addBalls(const std::vector<Ball>& balls, const Placing& placing, HoursTree& out) {
  if (balls.empty()) return;
  std::vector<Box3> boxes(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 middle = placing.frame.horizontal(balls[i].centre);
    boxes[i].add(middle - Vec3(balls[i].radius));
    boxes[i].add(middle + Vec3(balls[i].radius));
  }
  const BinaryTree binary = buildBinaryTree(boxes, kLeafBalls);
  const auto makeLeaf = [&](const BinaryTree::Node& node) {
    out.balls.push_back(ballsOf(binary, node, balls, placing));
    return static_cast<std::int32_t>(out.balls.size() - 1);
  };
  out.ballRoot = Gatherer(placing, binary, makeLeaf, out.ballNodes).gather();
}

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
  const BinaryTree binary = buildBinaryTree(boxes, kLeafQuads);
  const Placing placing{frame, 0x1p-21 * tree.reach};
  LeafMaker leaves(surfaces, casters, placing, binary, tree);
  const auto makeLeaf = [&](const BinaryTree::Node& node) { return leaves.make(node); };
  tree.root = Gatherer(placing, binary, makeLeaf, tree.nodes).gather();
  const auto middle = leaves.sizes.begin() + static_cast<std::ptrdiff_t>(leaves.sizes.size() / 2);
  std::nth_element(leaves.sizes.begin(), middle, leaves.sizes.end());
  tree.leafSize = *middle;
  addBalls(findBalls(surfaces, casters), placing, tree);
  return tree;
}

}  // namespace umbrage::study::detail
