#pragma once

#include <bit>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "umbrage/shadow/finders/collector.hpp"
#include "umbrage/shadow/finders/spread.hpp"

namespace umbrage::shadow {

/// Boxes of `Axes` dimensions, eight beside each other: [low, high][axis][lane].
template <int Axes>
struct alignas(32) Boxes {
  float bound[2][Axes][kLanes];
};

/// What is known of all segments in each of eight boxes, a bit a lane: not on the silhouette, or on it with known sign. Boxes in
/// no mask are in doubt.
struct NodeFate {
  std::uint32_t skipped, falling, rising;
};

/// Segments packed for vector units under a tree of boxes without pointers: every 16 are a leaf, every 16 nodes a node.
template <int Axes>
class SegmentTree {
 public:
  static constexpr std::size_t kArity = 16;
  using Point = std::array<float, Axes>;

  SegmentTree() = default;
  /// `coordinate(segment, k)`, k < OrderAxes: what brings like segments together. `extend(segment, add)` calls add(point) for each
  /// point that a box around the segment must hold.
  template <int OrderAxes, class Coordinate, class Extend>
  static SegmentTree build(std::span<const DualEdge> segments, unsigned threads, const Coordinate& coordinate,
                           const Extend& extend) {
    SegmentTree tree;
    tree.segmentCount_ = segments.size();
    tree.blockCount_ = (segments.size() + kLanes - 1) / kLanes;
    tree.blocks_ = std::make_unique_for_overwrite<SegmentBlock[]>(tree.blockCount_);
    std::vector<Boxes<Axes>> leaves((tree.leafCount() + kLanes - 1) / kLanes);
    spread<OrderAxes>(segments, {kLeaf, kArity}, coordinate, threads,
                      [&](std::size_t first, std::span<const DualEdge> ordered) {
                        tree.pack(first / kLanes, ordered);
                        bound(leaves, first / kLeaf, ordered, extend);
                      });
    tree.boundNodes(std::move(leaves));
    return tree;
  }

  /// Adds what is on the silhouette to `out` and returns how many segments were tested. `judge(boxes)` is a NodeFate.
  template <class Judge>
  std::size_t find(const DualPoint& light, const Judge& judge, const TagReader& reader, bool avx2,
                   Collector& out) const {
    if (blockCount_ == 0) return 0;
    return readLeaves(doubtfulLeaves(judge, reader, out), light, reader, avx2, out);
  }

  [[nodiscard]] std::size_t memory() const {
    std::size_t bytes = blockCount_ * sizeof(SegmentBlock);
    for (const auto& level : levels_) bytes += level.capacity() * sizeof(Boxes<Axes>);
    return bytes;
  }

 private:
  static constexpr std::size_t kLeafBlocks = 2, kLeaf = kLeafBlocks * kLanes;
  static constexpr std::size_t kNodeBlocks = kArity / kLanes, kAhead = 6;

  struct Box {
    Point low, high;
    Box() {
      low.fill(std::numeric_limits<float>::max());
      high.fill(std::numeric_limits<float>::lowest());
    }
    void add(const Point& p) {
      for (std::size_t k = 0; k < Axes; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    }
  };

  static Box load(const std::vector<Boxes<Axes>>& level, std::size_t i) {
    Box box;
    for (std::size_t k = 0; k < Axes; ++k) {
      box.low[k] = level[i / kLanes].bound[0][k][i % kLanes];
      box.high[k] = level[i / kLanes].bound[1][k][i % kLanes];
    }
    return box;
  }
  static void store(std::vector<Boxes<Axes>>& level, std::size_t i, const Box& box) {
    for (std::size_t k = 0; k < Axes; ++k) {
      level[i / kLanes].bound[0][k][i % kLanes] = box.low[k];
      level[i / kLanes].bound[1][k][i % kLanes] = box.high[k];
    }
  }

  void pack(std::size_t block, std::span<const DualEdge> segments) {
    for (std::size_t first = 0; first < segments.size(); first += kLanes) {
      SegmentBlock packed{};
      for (std::size_t i = 0; i < std::min<std::size_t>(kLanes, segments.size() - first); ++i) {
        const DualEdge& s = segments[first + i];
        for (int end = 0; end < 2; ++end)
          for (int k = 0; k < 4; ++k) packed.point[end][k][i] = s.point[end][k];
        packed.tag[i] = s.tag;
      }
      blocks_[block++] = packed;
    }
  }

  template <class Extend>
  static void bound(std::vector<Boxes<Axes>>& leaves, std::size_t leaf, std::span<const DualEdge> segments,
                    const Extend& extend) {
    for (std::size_t first = 0; first < segments.size(); first += kLeaf) {
      Box box;
      for (const DualEdge& s : segments.subspan(first, std::min(kLeaf, segments.size() - first)))
        extend(s, [&](const Point& p) { box.add(p); });
      store(leaves, leaf++, box);
    }
  }

  void boundNodes(std::vector<Boxes<Axes>> leaves) {
    if (blockCount_ == 0) return;
    levels_.push_back(std::move(leaves));
    for (std::size_t count = leafCount(); count > kArity;) {
      const std::size_t nodes = (count + kArity - 1) / kArity;
      std::vector<Boxes<Axes>> coarser((nodes + kLanes - 1) / kLanes);
      for (std::size_t i = 0; i < nodes; ++i) {
        Box box;
        for (std::size_t child = i * kArity; child < std::min(count, (i + 1) * kArity); ++child) {
          const Box part = load(levels_.back(), child);
          box.add(part.low), box.add(part.high);
        }
        store(coarser, i, box);
      }
      levels_.push_back(std::move(coarser));
      count = nodes;
    }
  }

  // Leaves below one child of a node of that level.
  [[nodiscard]] static std::size_t leavesBelow(std::size_t level) {
    return std::size_t{1} << (level * static_cast<std::size_t>(std::countr_zero(kArity)));
  }

  // One level after the other, not one node after the other, so that it is known early which boxes and blocks come next.
  template <class Judge>
  [[nodiscard]] std::vector<std::uint32_t> doubtfulLeaves(const Judge& judge, const TagReader& reader,
                                                          Collector& out) const {
    std::vector<std::uint32_t> nodes{0}, children;
    for (std::size_t level = levels_.size(); level-- > 0;) {
      children.clear();
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i + kAhead < nodes.size()) prefetch<kNodeBlocks>(levels_[level].data() + nodes[i + kAhead] * kNodeBlocks);
        judgeChildren(level, nodes[i], judge, reader, children, out);
      }
      nodes.swap(children);
    }
    return nodes;
  }

  // Appends those in doubt.
  template <class Judge>
  void judgeChildren(std::size_t level, std::size_t node, const Judge& judge, const TagReader& reader,
                     std::vector<std::uint32_t>& doubtful, Collector& out) const {
    const std::size_t below = leavesBelow(level), children = (leafCount() + below - 1) / below;
    for (std::size_t b = node * kNodeBlocks; b < (node + 1) * kNodeBlocks && b * kLanes < children; ++b) {
      const std::uint32_t live = (1u << std::min<std::size_t>(kLanes, children - b * kLanes)) - 1;
      const NodeFate fate = judge(levels_[level][b]);
      const std::uint32_t crossed = (fate.falling | fate.rising) & live;
      for (std::uint32_t bits = crossed; bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
        takeAll((b * kLanes + lane) * below * kLeafBlocks, below * kLeafBlocks, (fate.falling >> lane & 1) != 0, reader,
                out);
      }
      for (std::uint32_t bits = live & ~(fate.skipped | crossed); bits != 0; bits &= bits - 1)
        doubtful.push_back(static_cast<std::uint32_t>(b * kLanes + static_cast<std::size_t>(std::countr_zero(bits))));
    }
  }

  template <std::size_t Count, class T>
  static void prefetch(const T* first) {
    const char* bytes = reinterpret_cast<const char*>(first);
    for (std::size_t line = 0; line < Count * sizeof(T); line += 64) __builtin_prefetch(bytes + line);
  }

  void takeAll(std::size_t first, std::size_t count, bool falling, const TagReader& reader, Collector& out) const {
    for (std::size_t b = first; b < std::min(first + count, blockCount_); ++b)
      for (std::size_t i = 0; i < lanesOf(b); ++i) reader.crossed(blocks_[b].tag[i], falling, out);
  }

  std::size_t readLeaves(std::span<const std::uint32_t> leaves, const DualPoint& light, const TagReader& reader,
                         bool avx2, Collector& out) const {
    std::size_t tested = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (i + kAhead < leaves.size()) prefetch<kLeafBlocks>(blocks_.get() + leaves[i + kAhead] * kLeafBlocks);
      const std::size_t first = leaves[i] * kLeafBlocks;
      for (std::size_t b = first; b < std::min(first + kLeafBlocks, blockCount_); ++b) {
        reader.read(blocks_[b], laneSigns(blocks_[b], light, avx2), (1u << lanesOf(b)) - 1, out);
        tested += lanesOf(b);
      }
    }
    return tested;
  }

  [[nodiscard]] std::size_t lanesOf(std::size_t block) const {
    return std::min<std::size_t>(kLanes, segmentCount_ - block * kLanes);
  }

  [[nodiscard]] std::size_t leafCount() const { return (blockCount_ + kLeafBlocks - 1) / kLeafBlocks; }

  std::unique_ptr<SegmentBlock[]> blocks_;
  std::size_t blockCount_ = 0;
  std::vector<std::vector<Boxes<Axes>>> levels_;  ///< boxes of the children; levels_[0] bounds leaves
  std::size_t segmentCount_ = 0;
};

}  // namespace umbrage::shadow
