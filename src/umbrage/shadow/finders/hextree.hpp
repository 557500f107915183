#pragma once

#include <vector>

#include "umbrage/shadow/finders/segment_tree.hpp"

namespace umbrage::shadow {

/// The tree in the 4-D dual space of planes.
class Hextree final : public SilhouetteFinder {
 public:
  Hextree(std::shared_ptr<const CasterSet> casters, const FinderOptions& options);

  [[nodiscard]] FoundEdges find(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] std::size_t memory() const override;

 private:
  ExactEdges exact_;
  DualFrame frame_;
  std::vector<std::uint32_t> always_;
  SegmentTree<8> tree_;
  bool avx2_;
};

}  // namespace umbrage::shadow
