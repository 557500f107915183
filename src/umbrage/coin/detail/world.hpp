#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "umbrage/coin/detail/view.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::coin::detail {

/// The casters and receivers of the world.
struct World {
  std::shared_ptr<const shadow::Geometry> geometry;
  std::vector<std::size_t> shapeOf;  ///< per instance: the placed shape that it is of
  std::vector<std::uint8_t> veiled;  ///< per triangle, 1 where it casts but is looked through; empty: none
  /// Per triangle, 1 where it is not drawn while its corners, in their order, go round counterclockwise on the screen, -1 while they go round
  /// clockwise; empty: all 0.
  std::vector<std::int8_t> culled;
};

/// Which triangles of a world a view looks through, though they cast: veiled ones, and those whose side that is turned to it is culled.
/// REQUIRES: outlived by both.
class Unseen {
 public:
  Unseen(const World& world, const View& view) : world_(world), view_(view) {}
  [[nodiscard]] bool operator()(std::uint32_t triangle) const {
    if (!world_.veiled.empty() && world_.veiled[triangle] != 0) return true;
    return !world_.culled.empty() && world_.culled[triangle] != 0 && isCulled(triangle);
  }
  /// Per triangle; empty when all are seen.
  [[nodiscard]] std::vector<std::uint8_t> all() const;

 private:
  [[nodiscard]] bool isCulled(std::uint32_t triangle) const;
  const World& world_;
  const View& view_;
};

}  // namespace umbrage::coin::detail
