#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/shadow/caster_set.hpp"
#include "umbrage/shadow/finders/simd.hpp"

namespace umbrage::shadow {

/// The corners of all triangles, eight triangles a block, so that lightSide is computed for several at a time.
class TriangleLanes {
 public:
  explicit TriangleLanes(const CasterSet& casters);

  /// side[t] = lightSide of triangle t, the same bits: the same operations in the same order, in double precision.
  /// REQUIRES: one entry a triangle. `begin` is a multiple of kLanes.
  void sides(const Vec4& light, std::size_t begin, std::size_t end, std::span<std::int8_t> side, bool avx2) const;

  [[nodiscard]] std::size_t memory() const { return blocks_.capacity() * sizeof(Block); }

 private:
  struct alignas(32) Block {
    float corner[3][3][kLanes];
  };
  static void sidesOf(const Block& block, const Vec4& light, std::int8_t out[kLanes]);
  static void sidesOfWide(const Block& block, const Vec4& light, std::int8_t out[kLanes]);

  std::vector<Block> blocks_;
};

}  // namespace umbrage::shadow
