#include "umbrage/shadow/finders/light_bits.hpp"

#ifdef UMBRAGE_HAVE_AVX2
#include <immintrin.h>
#endif

namespace umbrage::shadow {
namespace {

LightBits plainBits(const DualPoint& p, const LightBundle& l) {
  LightBits bits{};
  for (int i = 0; i < 64; ++i) {
    const float value = ((p[0] * l.axis[0][i] + p[1] * l.axis[1][i]) + p[2] * l.axis[2][i]) + p[3] * l.axis[3][i];
    bits.positive |= std::uint64_t{value > kDoubt} << i;
    bits.doubtful |= std::uint64_t{value <= kDoubt && value >= -kDoubt} << i;
  }
  return bits;
}

#ifdef UMBRAGE_HAVE_AVX2
[[gnu::target("avx2")]] LightBits wideBits(const DualPoint& p, const LightBundle& l) {
  const __m256 p0 = _mm256_set1_ps(p[0]), p1 = _mm256_set1_ps(p[1]), p2 = _mm256_set1_ps(p[2]),
               p3 = _mm256_set1_ps(p[3]);
  const __m256 doubt = _mm256_set1_ps(kDoubt), minusDoubt = _mm256_set1_ps(-kDoubt);
  LightBits bits{};
  for (int i = 0; i < 64; i += kLanes) {
    __m256 value = _mm256_mul_ps(p0, _mm256_load_ps(l.axis[0] + i));
    value = _mm256_add_ps(value, _mm256_mul_ps(p1, _mm256_load_ps(l.axis[1] + i)));
    value = _mm256_add_ps(value, _mm256_mul_ps(p2, _mm256_load_ps(l.axis[2] + i)));
    value = _mm256_add_ps(value, _mm256_mul_ps(p3, _mm256_load_ps(l.axis[3] + i)));
    const __m256 positive = _mm256_cmp_ps(value, doubt, _CMP_GT_OQ);
    const __m256 sure = _mm256_or_ps(positive, _mm256_cmp_ps(value, minusDoubt, _CMP_LT_OQ));
    bits.positive |= std::uint64_t{static_cast<std::uint32_t>(_mm256_movemask_ps(positive))} << i;
    bits.doubtful |= std::uint64_t{~static_cast<std::uint32_t>(_mm256_movemask_ps(sure)) & 0xffu} << i;
  }
  return bits;
}
#endif

// A square of bits about its diagonal: bit j of word i becomes bit i of word j.
[[gnu::always_inline]] inline void transposeSquare(std::array<std::uint64_t, 64>& square) {
  std::uint64_t mask = 0x00000000ffffffffu;
  for (unsigned size = 32; size != 0; size >>= 1, mask ^= mask << size) {
    for (unsigned block = 0; block < 64; block += 2 * size) {
      for (unsigned i = block; i < block + size; ++i) {
        const std::uint64_t swapped = ((square[i] >> size) ^ square[i + size]) & mask;
        square[i] ^= swapped << size;
        square[i + size] ^= swapped;
      }
    }
  }
}
void plainTranspose(std::array<std::uint64_t, 64>& square) { transposeSquare(square); }
#ifdef UMBRAGE_HAVE_AVX2
[[gnu::target("avx2")]] void wideTranspose(std::array<std::uint64_t, 64>& square) { transposeSquare(square); }
#endif

[[gnu::always_inline]] inline std::size_t count(std::span<const EdgeBits> words) {
  std::size_t sum = 0;
  for (const EdgeBits& word : words) sum += static_cast<std::size_t>(std::popcount(word.crossed));
  return sum;
}
#ifdef UMBRAGE_HAVE_AVX2
[[gnu::target("avx2,popcnt")]] std::size_t wideCount(std::span<const EdgeBits> words) { return count(words); }
#endif

}  // namespace

LightBits lightBits(const DualPoint& plane, const LightBundle& lights, [[maybe_unused]] bool avx2) {
#ifdef UMBRAGE_HAVE_AVX2
  if (avx2) return wideBits(plane, lights);
#endif
  return plainBits(plane, lights);
}

void transpose(std::array<std::uint64_t, 64>& square, [[maybe_unused]] bool avx2) {
#ifdef UMBRAGE_HAVE_AVX2
  if (avx2) return wideTranspose(square);
#endif
  plainTranspose(square);
}

std::size_t countCrossed(std::span<const EdgeBits> words, [[maybe_unused]] bool avx2) {
#ifdef UMBRAGE_HAVE_AVX2
  if (avx2) return wideCount(words);
#endif
  return count(words);
}

}  // namespace umbrage::shadow
