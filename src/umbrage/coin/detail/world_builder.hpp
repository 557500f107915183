#pragma once

#include <vector>

#include "umbrage/coin/detail/extractor.hpp"
#include "umbrage/coin/detail/mask_maker.hpp"
#include "umbrage/coin/settings.hpp"

namespace umbrage::coin::detail {

/// Puts the world together from placed shapes. Where they are those of the time before, it does nothing; where they only moved, the world moves with them,
/// and nothing is connected anew.
class WorldBuilder {
 public:
  /// Null geometry where nothing casts or receives. `work`: poses and geometryBuilds are counted.
  [[nodiscard]] const World& build(const std::vector<PlacedShape>& shapes, TransparentCasters transparent, Work& work);
  /// The last one.
  [[nodiscard]] const World& world() const { return world_; }

 private:
  [[nodiscard]] bool move(const std::vector<PlacedShape>& shapes);
  std::vector<PlacedShape> shapes_;
  TransparentCasters transparent_ = TransparentCasters::none;
  World world_;
  scene::Welding welding_;  ///< of world_
};

}  // namespace umbrage::coin::detail
