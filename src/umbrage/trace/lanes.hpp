#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "umbrage/base/vector_units.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::trace {

/// A number for each of the eight rays of a packet.
using Lanes = std::array<double, 8>;

/// A vector for each of the eight rays of a packet, coordinate by coordinate: loops over lanes become vector instructions.
struct Vec3Lanes {
  alignas(64) Lanes x, y, z;
  [[nodiscard]] Vec3 operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, const Vec3& v) { x[k] = v.x, y[k] = v.y, z[k] = v.z; }
};

/// Bit k: holds(k) is true.
template <class Fn>
[[nodiscard]] std::uint32_t lanesWhere(Fn&& holds) {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < 8; ++k) bits |= static_cast<std::uint32_t>(static_cast<bool>(holds(k))) << k;
  return bits;
}
/// Whether bit k is set.
[[nodiscard]] constexpr bool hasLane(std::uint32_t bits, std::size_t k) { return (bits >> k & 1u) != 0; }

}  // namespace umbrage::trace
