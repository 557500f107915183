#pragma once

#include <vector>

#include "umbrage/shadow/finders/collector.hpp"
#include "umbrage/shadow/finders/dual_space.hpp"

namespace umbrage::shadow {

/// An octree over the places where a point light may be.
class PotentiallyVisible final : public SilhouetteFinder {
 public:
  PotentiallyVisible(std::shared_ptr<const CasterSet> casters, const FinderOptions& options);

  /// Directions, and lights outside the octree, are answered by testing every edge; answeredBy is bruteForceSimd then.
  [[nodiscard]] FoundEdges find(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] std::size_t memory() const override;

  [[nodiscard]] const Box3& litVolume() const { return volume_; }
  [[nodiscard]] std::size_t cellCount() const { return cells_.size(); }

 private:
  /// What holds for every light in a cell, beside what holds for its parents.
  struct Cell {
    Box3 box;                           ///< in dual units
    std::uint32_t firstChild = 0;       ///< of eight; 0: none
    std::vector<std::uint32_t> always;  ///< segment, its top bit set where the first end faces away from the light
    std::vector<std::uint32_t> maybe;   ///< of cells without children
  };
  void grow(std::size_t budget);
  [[nodiscard]] Cell cellOf(const Box3& box, const std::vector<std::uint32_t>& candidates) const;
  void test(const DualEdge& segment, const DualPoint& light, const TagReader& reader, Collector& out) const;

  ExactEdges exact_;
  DualFrame frame_;
  std::vector<std::uint32_t> always_;
  std::vector<DualEdge> segments_;
  std::vector<Cell> cells_;  ///< the root first
  Box3 volume_;
};

}  // namespace umbrage::shadow
