#pragma once

#include <vector>

#include "umbrage/shadow/finders/segment_tree.hpp"

namespace umbrage::shadow {

/// The tree in Hough space: 3-D, for point lights and directions alike.
class Hough final : public SilhouetteFinder {
 public:
  Hough(std::shared_ptr<const CasterSet> casters, const FinderOptions& options);

  [[nodiscard]] FoundEdges find(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] std::size_t memory() const override;

 private:
  ExactEdges exact_;
  DualFrame frame_;
  std::vector<std::uint32_t> always_;
  SegmentTree<3> alike_;     ///< edges whose planes pass the origin on the same side, as the edge orients them
  SegmentTree<3> opposite_;  ///< the others; and those of one face
  bool avx2_;
};

}  // namespace umbrage::shadow
