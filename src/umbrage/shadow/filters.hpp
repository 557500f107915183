#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrage/scene/scene.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::shadow {

/// What surfaces on a way take from the light, per channel: the sum of -log2 of what each lets through, in whole steps. Whole numbers add up to the same in
/// any order, and what is taken away again leaves nothing behind.
using FilterSum = std::array<std::int32_t, 3>;

/// Which surfaces let light through, and how much.
/// 1. A part below 2^-14 (0.00006) of a channel counts as 2^-14.
/// 2. Steps are as fine as they can be (at least 2^-15, at most 2^-24) for the sum of all veils of the scene, or of 4,000 of the darkest where that is
///    less.
class Filters {
 public:
  /// All surfaces are opaque.
  Filters() = default;
  /// `materials`: those that `surfaces` name.
  Filters(const scene::Surfaces& surfaces, const std::vector<scene::Material>& materials);

  /// Whether there is any veil.
  [[nodiscard]] bool empty() const { return ofTriangle_.empty(); }
  /// Whether a triangle of the surfaces is a veil: it lets something through.
  [[nodiscard]] bool isVeil(std::uint32_t triangle) const { return !empty() && ofTriangle_[triangle] != 0; }
  /// What a veil takes; nothing for what is opaque.
  [[nodiscard]] const FilterSum& of(std::uint32_t triangle) const { return sums_[empty() ? 0 : ofTriangle_[triangle]]; }
  /// Steps to a factor of 2; a power of two.
  [[nodiscard]] double steps() const { return steps_; }
  /// The part of the light that is left.
  [[nodiscard]] Vec3f transmitted(const FilterSum& sum) const;

 private:
  std::vector<std::uint32_t> ofTriangle_;  ///< per triangle: its place in `sums_`, 0: opaque
  std::vector<FilterSum> sums_{FilterSum{}};
  double steps_ = 0x1p24;
};

}  // namespace umbrage::shadow
