#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/math/box.hpp"
#include "umbrage/render/receiver_tiles.hpp"
#include "umbrage/render/volume_options.hpp"
#include "umbrage/shadow/reach.hpp"
#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::render::detail {

/// Per component of the casters: a flag.
using Components = std::vector<std::uint8_t>;

/// Where a light's volumes end, and what of them matters. Points and boxes are relative to the origin of the casters.
class VolumeShape {
 public:
  struct Input {
    const shadow::CasterSet& casters;
    Vec4 light{0.0};
    Vec3 eye{0.0};
    const VolumeOptions& options;
    Box3 receivers;
    const ReceiverTiles* tiles = nullptr;
  };
  /// REQUIRES: what `input` refers to outlives this.
  explicit VolumeShape(const Input& input) : input_(input) {}

  /// What the eye touches has no end: of corners around the eye, those at infinity are the ones that rounding harms least.
  void endVolumes(const Components& atEye);

  /// Whether parts that no receiver that can be seen has to do with are left out at all.
  [[nodiscard]] bool dropsParts() const { return input_.tiles != nullptr && input_.options.hiddenParts; }
  /// The components that may be left out: no receiver that can be seen lies in a volume that is behind them all, or before them all.
  /// REQUIRES: dropsParts().
  [[nodiscard]] Components withoutReceivers() const;
  /// Whether z-pass may count fragments of the side at an edge from a to b. REQUIRES: dropsParts().
  [[nodiscard]] bool mayCount(std::uint32_t a, std::uint32_t b, std::uint32_t component) const;

  /// Null: all volumes reach to infinity.
  [[nodiscard]] const shadow::Reach* reach() const { return input_.options.finite ? &reach_ : nullptr; }

 private:
  [[nodiscard]] bool holdsReceivers(std::uint32_t component) const;
  [[nodiscard]] Vec4 relative(const Vec4& p) const { return p - Vec4(input_.eye * p.w, 0.0); }
  [[nodiscard]] Vec4 farEnd(std::uint32_t component, const Vec3& corner) const;

  Input input_;
  shadow::Reach reach_;
};

}  // namespace umbrage::render::detail
