#include "umbrage/shadow/finders/simd.hpp"

#ifdef UMBRAGE_HAVE_AVX2
#include <immintrin.h>
#endif

namespace umbrage::shadow {
namespace {

// The corners of eight boxes farthest along the light and farthest against it: on each axis the high or the low bound, by the
// sign of the light.
struct Corners {
  const float* farthest[4];
  const float* nearest[4];
};

Corners corners(const BoxBounds& bounds, int end, const DualPoint& light) {
  Corners c{};
  for (int k = 0; k < 4; ++k) {
    const int high = light[k] >= 0.0f ? 1 : 0;
    c.farthest[k] = bounds[high][end * 4 + k];
    c.nearest[k] = bounds[1 - high][end * 4 + k];
  }
  return c;
}

Corners corners(const SegmentBlock& block, int end) {
  Corners c{};
  for (int k = 0; k < 4; ++k) c.farthest[k] = c.nearest[k] = block.point[end][k];
  return c;
}

struct Masks {
  std::uint32_t positive, negative;
};

float product(const float* const axis[4], int lane, const DualPoint& light) {
  return ((axis[0][lane] * light[0] + axis[1][lane] * light[1]) + axis[2][lane] * light[2]) + axis[3][lane] * light[3];
}

Masks plainMasks(const Corners& c, const DualPoint& light) {
  Masks m{};
  for (int lane = 0; lane < kLanes; ++lane) {
    m.positive |= std::uint32_t{product(c.nearest, lane, light) > kDoubt} << lane;
    m.negative |= std::uint32_t{product(c.farthest, lane, light) < -kDoubt} << lane;
  }
  return m;
}

#ifdef UMBRAGE_HAVE_AVX2
[[gnu::target("avx2"), gnu::always_inline]] inline __m256 wideProduct(const float* const axis[4],
                                                                      const __m256 light[4]) {
  __m256 sum = _mm256_mul_ps(_mm256_load_ps(axis[0]), light[0]);
  for (int k = 1; k < 4; ++k) sum = _mm256_add_ps(sum, _mm256_mul_ps(_mm256_load_ps(axis[k]), light[k]));
  return sum;
}

[[gnu::target("avx2"), gnu::always_inline]] inline Masks wideMasks(const Corners& c, const __m256 light[4],
                                                                   bool points) {
  const __m256 doubt = _mm256_set1_ps(kDoubt);
  const __m256 low = wideProduct(c.nearest, light);
  const __m256 high = points ? low : wideProduct(c.farthest, light);
  const int positive = _mm256_movemask_ps(_mm256_cmp_ps(low, doubt, _CMP_GT_OQ));
  const int negative = _mm256_movemask_ps(_mm256_cmp_ps(high, _mm256_sub_ps(_mm256_setzero_ps(), doubt), _CMP_LT_OQ));
  return {static_cast<std::uint32_t>(positive), static_cast<std::uint32_t>(negative)};
}

[[gnu::target("avx2")]] LaneSigns wideSigns(const Corners& c0, const Corners& c1, const DualPoint& light, bool points) {
  const __m256 l[4] = {_mm256_set1_ps(light[0]), _mm256_set1_ps(light[1]), _mm256_set1_ps(light[2]),
                       _mm256_set1_ps(light[3])};
  const Masks m0 = wideMasks(c0, l, points), m1 = wideMasks(c1, l, points);
  return {m0.positive, m0.negative, m1.positive, m1.negative};
}
#endif

LaneSigns signs(const Corners& c0, const Corners& c1, const DualPoint& light, [[maybe_unused]] bool points,
                [[maybe_unused]] bool avx2) {
#ifdef UMBRAGE_HAVE_AVX2
  if (avx2) return wideSigns(c0, c1, light, points);
#endif
  const Masks m0 = plainMasks(c0, light), m1 = plainMasks(c1, light);
  return {m0.positive, m0.negative, m1.positive, m1.negative};
}

}  // namespace

bool processorHasAvx2() {
#ifdef UMBRAGE_HAVE_AVX2
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
#else
  return false;
#endif
}

LaneSigns laneSigns(const SegmentBlock& block, const DualPoint& light, bool avx2) {
  return signs(corners(block, 0), corners(block, 1), light, true, avx2);
}

LaneSigns laneSigns(const BoxBounds& bounds, const DualPoint& light, bool avx2) {
  return signs(corners(bounds, 0, light), corners(bounds, 1, light), light, false, avx2);
}

}  // namespace umbrage::shadow
