#pragma once

// Eight lanes in AVX2 registers. Only for files compiled for that processor; nothing here may be used, or be shared with, elsewhere.
#include <immintrin.h>

#include <cstdint>

namespace umbrage::study::detail::wide {

struct Mask {
  __m256 v;
};
inline Mask operator&(Mask a, Mask b) { return {_mm256_and_ps(a.v, b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {_mm256_or_ps(a.v, b.v)}; }
/// b and not a.
inline Mask without(Mask a, Mask b) { return {_mm256_andnot_ps(a.v, b.v)}; }
inline std::uint32_t bits(Mask a) { return static_cast<std::uint32_t>(_mm256_movemask_ps(a.v)); }

struct Lanes {
  __m256 v;
  Lanes() = default;
  Lanes(__m256 value) : v(value) {}
  explicit Lanes(float value) : v(_mm256_set1_ps(value)) {}
};
inline Lanes load(const float* p) { return _mm256_loadu_ps(p); }
/// Four from p, then four from q.
inline Lanes load(const float* p, const float* q) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p)), _mm_loadu_ps(q), 1);
}
inline Lanes halves(float low, float high) { return _mm256_set_m128(_mm_set1_ps(high), _mm_set1_ps(low)); }
inline void store(float* p, Lanes a) { _mm256_storeu_ps(p, a.v); }
inline Lanes operator+(Lanes a, Lanes b) { return _mm256_add_ps(a.v, b.v); }
inline Lanes operator-(Lanes a, Lanes b) { return _mm256_sub_ps(a.v, b.v); }
inline Lanes operator*(Lanes a, Lanes b) { return _mm256_mul_ps(a.v, b.v); }
inline Lanes operator/(Lanes a, Lanes b) { return _mm256_div_ps(a.v, b.v); }
inline Lanes operator-(Lanes a) { return _mm256_xor_ps(a.v, _mm256_set1_ps(-0.0f)); }
/// a b + c, a b - c, c - a b
inline Lanes fma(Lanes a, Lanes b, Lanes c) { return _mm256_fmadd_ps(a.v, b.v, c.v); }
inline Lanes fms(Lanes a, Lanes b, Lanes c) { return _mm256_fmsub_ps(a.v, b.v, c.v); }
inline Lanes fnma(Lanes a, Lanes b, Lanes c) { return _mm256_fnmadd_ps(a.v, b.v, c.v); }
/// a b - c d, right to two units in the last place.
inline Lanes difference(Lanes a, Lanes b, Lanes c, Lanes d) {
  const Lanes ab = a * b, cd = c * d;
  return (ab - cd) + (fms(a, b, ab) - fms(c, d, cd));
}
inline Lanes smaller(Lanes a, Lanes b) { return _mm256_min_ps(a.v, b.v); }
inline Lanes larger(Lanes a, Lanes b) { return _mm256_max_ps(a.v, b.v); }
inline Lanes magnitude(Lanes a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v); }
/// a with its sign changed where b is negative.
inline Lanes flipped(Lanes a, Lanes b) { return _mm256_xor_ps(a.v, _mm256_and_ps(b.v, _mm256_set1_ps(-0.0f))); }
inline Lanes root(Lanes a) { return _mm256_sqrt_ps(a.v); }
/// 1 / a, to about 2^-22.
inline Lanes inverse(Lanes a) {
  const __m256 r = _mm256_rcp_ps(a.v);
  return _mm256_mul_ps(r, _mm256_fnmadd_ps(a.v, r, _mm256_set1_ps(2.0f)));
}
/// 1 / a, to about 2^-11.
inline Lanes roughInverse(Lanes a) { return _mm256_rcp_ps(a.v); }
/// 1 / sqrt(a), to about 2^-22.
inline Lanes inverseRoot(Lanes a) {
  const __m256 r = _mm256_rsqrt_ps(a.v), half = _mm256_mul_ps(a.v, _mm256_set1_ps(0.5f));
  return _mm256_mul_ps(r, _mm256_fnmadd_ps(half, _mm256_mul_ps(r, r), _mm256_set1_ps(1.5f)));
}
inline Mask operator<(Lanes a, Lanes b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask operator<=(Lanes a, Lanes b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
inline Mask operator>(Lanes a, Lanes b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
inline Mask operator>=(Lanes a, Lanes b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
inline Lanes select(Mask m, Lanes yes, Lanes no) { return _mm256_blendv_ps(no.v, yes.v, m.v); }
/// a where a is negative gives yes, else no.
inline Lanes selectNegative(Lanes a, Lanes yes, Lanes no) { return _mm256_blendv_ps(no.v, yes.v, a.v); }
/// In each half: the lanes moved up by one, cyclically; the largest and smallest in all four.
inline Lanes following(Lanes a) { return _mm256_permute_ps(a.v, 0x39); }
inline Lanes largestOfFour(Lanes a) {
  const __m256 x = _mm256_max_ps(a.v, _mm256_permute_ps(a.v, 0xB1));
  return _mm256_max_ps(x, _mm256_permute_ps(x, 0x4E));
}
inline Lanes smallestOfFour(Lanes a) {
  const __m256 x = _mm256_min_ps(a.v, _mm256_permute_ps(a.v, 0xB1));
  return _mm256_min_ps(x, _mm256_permute_ps(x, 0x4E));
}
inline float lowHalf(Lanes a) { return _mm256_cvtss_f32(a.v); }
inline float highHalf(Lanes a) { return _mm_cvtss_f32(_mm256_extractf128_ps(a.v, 1)); }

/// Which lanes' bins, from that of `low` to that of `high` (in bins from 0), are all in the set `full`.
inline std::uint32_t allIn(Lanes low, Lanes high, std::uint64_t full) {
  const __m256i top = _mm256_set1_epi32(63);
  const __m256i last = _mm256_min_epi32(_mm256_max_epi32(_mm256_cvttps_epi32(high.v), _mm256_setzero_si256()), top);
  const __m256i first = _mm256_min_epi32(_mm256_max_epi32(_mm256_cvttps_epi32(low.v), _mm256_setzero_si256()), last);
  const __m256i shift = _mm256_sub_epi32(top, _mm256_sub_epi32(last, first));
  const __m256i open = _mm256_set1_epi64x(static_cast<long long>(~full)), ones = _mm256_set1_epi64x(-1),
                zero = _mm256_setzero_si256();
  const auto range = [&](__m128i s, __m128i f) {
    return _mm256_sllv_epi64(_mm256_srlv_epi64(ones, _mm256_cvtepu32_epi64(s)), _mm256_cvtepu32_epi64(f));
  };
  const __m256i a = range(_mm256_castsi256_si128(shift), _mm256_castsi256_si128(first));
  const __m256i b = range(_mm256_extracti128_si256(shift, 1), _mm256_extracti128_si256(first, 1));
  const int l = _mm256_movemask_pd(_mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(a, open), zero)));
  const int h = _mm256_movemask_pd(_mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(b, open), zero)));
  return static_cast<std::uint32_t>(l | h << 4);
}

/// Lane i and those after it moved by `by` (1: up, to make room; less: down), lane i set to x; what is left free becomes `fill`.
inline Lanes replaced(Lanes a, int i, int by, float x, float fill) {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), at = _mm256_set1_epi32(i);
  const __m256i from = _mm256_sub_epi32(lane, _mm256_and_si256(_mm256_cmpgt_epi32(lane, at), _mm256_set1_epi32(by)));
  const __m256 beyond = _mm256_castsi256_ps(_mm256_cmpgt_epi32(from, _mm256_set1_epi32(7)));
  const __m256 moved = _mm256_blendv_ps(_mm256_permutevar8x32_ps(a.v, from), _mm256_set1_ps(fill), beyond);
  return _mm256_blendv_ps(moved, _mm256_set1_ps(x), _mm256_castsi256_ps(_mm256_cmpeq_epi32(lane, at)));
}

}  // namespace umbrage::study::detail::wide
