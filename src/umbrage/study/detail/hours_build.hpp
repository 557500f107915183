#pragma once

#include <new>
#include <vector>

#include "umbrage/study/detail/hours_casters.hpp"
#include "umbrage/study/detail/hours_tree.hpp"

namespace umbrage::study::detail {

/// The horizontal frame of a place, and that of the sun's legs (see SunLeg), as unit vectors in the scene's axes.
struct SkyFrame {
  Vec3 east, north, up;
  Vec3 first, west, south;
  double sinLatitude, cosLatitude;
  [[nodiscard]] Vec3 horizontal(const Vec3& v) const {
    return {glm::dot(v, east), glm::dot(v, north), glm::dot(v, up)};
  }
  [[nodiscard]] Vec3 turning(const Vec3& v) const {
    return {glm::dot(v, first), glm::dot(v, west), glm::dot(v, south)};
  }
};

/// The casters in a tree of eight children a node.
struct HoursTree {
  std::vector<TreeNode> nodes;
  std::vector<TreeLeaf> leaves;
  std::vector<TreeQuad> quads;
  std::int32_t root = 0;
  std::vector<TreeNode> ballNodes;  ///< of balls within the casters; empty where there are none
  std::vector<TreeBalls> balls;
  std::int32_t ballRoot = 0;
  double reach = 0.0;     ///< the largest coordinate
  double leafSize = 0.0;  ///< the longest side of the box of a leaf, in the median
};

[[nodiscard]] HoursTree buildTree(const scene::Surfaces& surfaces, const Casters& casters, const SkyFrame& frame);

}  // namespace umbrage::study::detail
