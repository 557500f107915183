// Words whose bits are lights, and words whose bits are edges.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "umbrage/shadow/finders/simd.hpp"

namespace umbrage::shadow {

/// Up to 64 lights in dual space.
struct alignas(32) LightBundle {
  float axis[4][64];
};

/// On which side of one plane 64 lights lie, a bit a light: the plane's, the other, or in doubt, where `positive` means nothing.
struct LightBits {
  std::uint64_t positive, doubtful;
};
[[nodiscard]] LightBits lightBits(const DualPoint& plane, const LightBundle& lights, bool avx2);

/// For one light, 64 edges: those on its silhouette, and whether their multiplicity is positive.
struct EdgeBits {
  std::uint64_t crossed, positive;
};
/// Bits set in all words' `crossed`.
[[nodiscard]] std::size_t countCrossed(std::span<const EdgeBits> words, bool avx2);

/// A square of bits about its diagonal: bit j of word i becomes bit i of word j.
void transpose(std::array<std::uint64_t, 64>& square, bool avx2);

/// fn(i) for each bit i that is set, ascending.
template <class Fn>
void forEachBit(std::uint64_t bits, const Fn& fn) {
  for (; bits != 0; bits &= bits - 1) fn(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace umbrage::shadow
