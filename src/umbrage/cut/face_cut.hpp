#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "umbrage/math/vec.hpp"

namespace umbrage::cut {

/// A face as a plane with coordinates of its own, of the scene's unit: corner 0 is (0, 0), corner 1 lies on the first axis and corner 2 above it.
struct FaceFrame {
  Vec3 origin{0.0}, e1{0.0}, e2{0.0}, normal{0.0};
  std::array<Vec3, 3> corners{};
  std::array<Vec2, 3> flatCorners{};

  /// A normal of (0, 0, 0), and nothing else that means anything, for a triangle without area.
  [[nodiscard]] static FaceFrame of(const std::array<Vec3, 3>& corners);
  [[nodiscard]] Vec2 flat(const Vec3& p) const { return {glm::dot(p - origin, e1), glm::dot(p - origin, e2)}; }
  /// Corners of the face come out as they went in, to the bit.
  [[nodiscard]] Vec3 space(const Vec2& p) const;
};

/// A convex polygon on a face, counter-clockwise in its frame.
using Polygon = std::vector<Vec2>;

/// The two parts of a polygon beside a line, given as the line's function over (u, v, 1), a distance. Corners no farther from the line than `tolerance` lie
/// on it. False where it does not cut: then `side` is that of the whole, +1 or -1, and `below` and `above` mean nothing.
[[nodiscard]] bool split(const Polygon& polygon, const Vec3& line, double tolerance, Polygon& below, Polygon& above,
                         int& side);

/// A face cut into lit and shadowed convex polygons: its shadow-volume BSP tree. Nodes are the lines in which planes through the light and an edge of a
/// caster, or a caster's own plane, meet the face; a leaf is lit or not as a whole.
class FaceCut {
 public:
  static constexpr std::int32_t kLit = -1, kDark = -2;
  struct Node {
    Vec3 line;                         ///< over (u, v, 1); unit: a distance
    std::array<std::int32_t, 2> next;  ///< where the line's function is below 0, and else: a node, kLit or kDark
  };

  /// Dark as a whole, of no frame.
  FaceCut() = default;
  FaceCut(const FaceFrame& frame, double tolerance, std::vector<Node> nodes, std::int32_t root);

  /// `point`: on the face's plane.
  [[nodiscard]] bool isLit(const Vec3& point) const;
  /// The parts of a convex part of the face (its flatCorners: all of it) in the tree's leaves and whether each is lit, in the order of the tree.
  void visitPieces(const Polygon& part, const std::function<void(const Polygon&, bool lit)>& visit) const;

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

 private:
  Vec3 origin_{0.0}, e1_{0.0}, e2_{0.0};
  double tolerance_ = 0.0;
  std::vector<Node> nodes_;
  std::int32_t root_ = kDark;
};

}  // namespace umbrage::cut
