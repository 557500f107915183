#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/shadow/caster_set.hpp"

namespace umbrage::shadow {

/// Where shadow volumes end: each component of the casters on one plane behind everything that can receive its shadow, or at infinity.
/// All vertices of a component are carried to the same plane, so its volume stays watertight.
struct Reach {
  static constexpr std::uint8_t kEndless = 6;
  /// Per component: 2 * axis for the plane below the room, 2 * axis + 1 for the one above it; kEndless for none.
  std::vector<std::uint8_t> plane;
  std::array<double, 6>
      level{};  ///< of each plane: its coordinate along its axis, relative to the origin of the casters

  [[nodiscard]] bool isEndless(std::uint32_t component) const { return plane[component] == kEndless; }
  [[nodiscard]] std::size_t endlessCount() const;
};

/// The planes are the sides of `room`, which is widened to hold the casters, and a little more. Each component takes the one at which
/// its shadow ends soonest, or none where the light shines along it or away from it (a component around the light; a light beside
/// one).
/// 1. Within the room, the volumes that end so and those that reach to infinity are the same. So a room that holds the receivers and the
///    eye changes no count between them.
/// 2. No far vertex lies in the room.
/// `light`: homogeneous; it and `room` are relative to the origin of the casters. `endless`: per component, nonzero for those that are to
/// reach to infinity; empty: none.
[[nodiscard]] Reach reachWithin(const CasterSet& casters, const Vec4& light, const Box3& room,
                                std::span<const std::uint8_t> endless = {});

/// A corner of `component` carried away from the light as far as its volume reaches; w = 0 at infinity.
[[nodiscard]] Vec4 farPoint(const Reach& reach, std::uint32_t component, const Vec3& corner, const Vec4& light);

/// Per position: its farPoint relative to `eye` in single precision; of positions that no caster uses, anything.
[[nodiscard]] std::vector<Vec4f> farPoints(const CasterSet& casters, const Reach& reach, const Vec4& light,
                                           const Vec3& eye);

}  // namespace umbrage::shadow
