// Eight lanes at a time. Every kernel exists twice, for AVX2 and in plain C++, and both give the same bits; which one runs is decided
// when the program runs, so one build serves every x86-64 processor, and others.
#pragma once

#include <array>
#include <cstdint>

#include "umbrage/shadow/finders/dual_space.hpp"

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#define UMBRAGE_HAVE_AVX2 1
#endif

namespace umbrage::shadow {

inline constexpr int kLanes = 8;

[[nodiscard]] bool processorHasAvx2();

/// What single precision proves of the two ends of eight segments, a bit a lane; a lane in neither mask is in doubt.
struct LaneSigns {
  std::uint32_t positive0, negative0, positive1, negative1;

  [[nodiscard]] std::uint32_t same() const { return (positive0 & positive1) | (negative0 & negative1); }
  [[nodiscard]] std::uint32_t falling() const { return positive0 & negative1; }  ///< multiplicity +
  [[nodiscard]] std::uint32_t rising() const { return negative0 & positive1; }   ///< multiplicity -
};

/// Eight segments.
struct alignas(32) SegmentBlock {
  float point[2][4][kLanes];
  std::uint32_t tag[kLanes];
};

/// Bounds of eight boxes, each around the first and around the second ends of a group of segments: [low, high][end * 4 + axis][lane].
using BoxBounds = float[2][8][kLanes];

[[nodiscard]] LaneSigns laneSigns(const SegmentBlock& block, const DualPoint& light, bool avx2);
[[nodiscard]] LaneSigns laneSigns(const BoxBounds& bounds, const DualPoint& light, bool avx2);

}  // namespace umbrage::shadow
