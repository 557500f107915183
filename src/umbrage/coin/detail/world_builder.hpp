#pragma once

#include <vector>

#include "umbrage/coin/detail/extractor.hpp"
#include "umbrage/coin/detail/mask_maker.hpp"
#include "umbrage/coin/settings.hpp"

namespace umbrage::coin::detail {

/// Puts the world together from placed shapes, and does nothing where they are those of the time before.
class WorldBuilder {
 public:
  /// Null geometry where nothing casts or receives. `work`: poses and geometryBuilds are counted.
  [[nodiscard]] const World& build(const std::vector<PlacedShape>& shapes, TransparentCasters transparent, Work& work);
  /// The last one.
  [[nodiscard]] const World& world() const { return world_; }

 private:
  std::vector<PlacedShape> shapes_;
  TransparentCasters transparent_ = TransparentCasters::none;
  World world_;
};

}  // namespace umbrage::coin::detail
