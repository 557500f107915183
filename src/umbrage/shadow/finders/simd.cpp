#include "umbrage/shadow/finders/simd.hpp"

#ifdef UMBRAGE_HAVE_AVX2
#include <immintrin.h>
#endif

namespace umbrage::shadow {
namespace {

using Lanes = float[kLanes];

struct Masks {
  std::uint32_t positive, negative;
};

float product(const Lanes axis[4], int lane, const DualPoint& light) {
  return ((axis[0][lane] * light[0] + axis[1][lane] * light[1]) + axis[2][lane] * light[2]) + axis[3][lane] * light[3];
}

Masks plainMasks(const Lanes point[4], const DualPoint& light) {
  Masks m{};
  for (int lane = 0; lane < kLanes; ++lane) {
    const float value = product(point, lane, light);
    m.positive |= std::uint32_t{value > kDoubt} << lane;
    m.negative |= std::uint32_t{value < -kDoubt} << lane;
  }
  return m;
}

// The corners of boxes farthest along the light and farthest against it: on each axis the one bound or the other, by the light's
// sign.
Masks plainMasks(const Lanes low[4], const Lanes high[4], const DualPoint& light) {
  Masks m{};
  for (int lane = 0; lane < kLanes; ++lane) {
    float nearest = 0.0f, farthest = 0.0f;
    for (int k = 0; k < 4; ++k) {
      nearest += (light[k] >= 0.0f ? low : high)[k][lane] * light[k];
      farthest += (light[k] >= 0.0f ? high : low)[k][lane] * light[k];
    }
    m.positive |= std::uint32_t{nearest > kDoubt} << lane;
    m.negative |= std::uint32_t{farthest < -kDoubt} << lane;
  }
  return m;
}

LaneSigns signs(const Masks& first, const Masks& second) {
  return {first.positive, first.negative, second.positive, second.negative};
}

#ifdef UMBRAGE_HAVE_AVX2
#define UMBRAGE_WIDE [[gnu::target("avx2"), gnu::always_inline]] inline

UMBRAGE_WIDE std::uint32_t above(__m256 value) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(value, _mm256_set1_ps(kDoubt), _CMP_GT_OQ)));
}
UMBRAGE_WIDE std::uint32_t below(__m256 value) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(value, _mm256_set1_ps(-kDoubt), _CMP_LT_OQ)));
}

UMBRAGE_WIDE Masks wideMasks(const Lanes point[4], const DualPoint& light) {
  __m256 value = _mm256_mul_ps(_mm256_load_ps(point[0]), _mm256_set1_ps(light[0]));
  for (int k = 1; k < 4; ++k)
    value = _mm256_add_ps(value, _mm256_mul_ps(_mm256_load_ps(point[k]), _mm256_set1_ps(light[k])));
  return {above(value), below(value)};
}

// No choice by the sign of the light here: of the two products the smaller one belongs to the nearer corner.
UMBRAGE_WIDE Masks wideMasks(const Lanes low[4], const Lanes high[4], const DualPoint& light) {
  __m256 nearest = _mm256_setzero_ps(), farthest = _mm256_setzero_ps();
  for (int k = 0; k < 4; ++k) {
    const __m256 u = _mm256_set1_ps(light[k]);
    const __m256 a = _mm256_mul_ps(_mm256_load_ps(low[k]), u), b = _mm256_mul_ps(_mm256_load_ps(high[k]), u);
    nearest = _mm256_add_ps(nearest, _mm256_min_ps(a, b));
    farthest = _mm256_add_ps(farthest, _mm256_max_ps(a, b));
  }
  return {above(nearest), below(farthest)};
}

[[gnu::target("avx2")]] LaneSigns wideSigns(const SegmentBlock& block, const DualPoint& light) {
  return signs(wideMasks(block.point[0], light), wideMasks(block.point[1], light));
}

[[gnu::target("avx2")]] LaneSigns wideSigns(const BoxBounds& bounds, const DualPoint& light) {
  return signs(wideMasks(bounds[0], bounds[1], light), wideMasks(bounds[0] + 4, bounds[1] + 4, light));
}
#endif

}  // namespace

bool processorHasAvx2() {
#ifdef UMBRAGE_HAVE_AVX2
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
#else
  return false;
#endif
}

LaneSigns laneSigns(const SegmentBlock& block, const DualPoint& light, [[maybe_unused]] bool avx2) {
#ifdef UMBRAGE_HAVE_AVX2
  if (avx2) return wideSigns(block, light);
#endif
  return signs(plainMasks(block.point[0], light), plainMasks(block.point[1], light));
}

LaneSigns laneSigns(const BoxBounds& bounds, const DualPoint& light, [[maybe_unused]] bool avx2) {
#ifdef UMBRAGE_HAVE_AVX2
  if (avx2) return wideSigns(bounds, light);
#endif
  return signs(plainMasks(bounds[0], bounds[1], light), plainMasks(bounds[0] + 4, bounds[1] + 4, light));
}

}  // namespace umbrage::shadow
