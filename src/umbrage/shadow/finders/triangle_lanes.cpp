#include "umbrage/shadow/finders/triangle_lanes.hpp"

#include <algorithm>

#include "umbrage/math/predicates.hpp"

#ifdef UMBRAGE_HAVE_AVX2
#include <immintrin.h>
#endif

namespace umbrage::shadow {

TriangleLanes::TriangleLanes(const CasterSet& casters) : blocks_((casters.triangles.size() + kLanes - 1) / kLanes) {
  for (std::size_t t = 0; t < casters.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k)
        blocks_[t / kLanes].corner[c][k][t % kLanes] = casters.positions[casters.triangles[t][c]][k];
}

void TriangleLanes::sidesOf(const Block& block, const Vec4& light, std::int8_t out[kLanes]) {
  for (int lane = 0; lane < kLanes; ++lane) {
    Vec3 p[3];
    for (int c = 0; c < 3; ++c)
      p[c] = {double(block.corner[c][0][lane]), double(block.corner[c][1][lane]), double(block.corner[c][2][lane])};
    out[lane] = static_cast<std::int8_t>(lightSide(p[0], p[1], p[2], light));
  }
}

#ifdef UMBRAGE_HAVE_AVX2
namespace {

struct Wide3 {
  __m256d x, y, z;
};

#define UMBRAGE_WIDE [[gnu::target("avx2"), gnu::always_inline]] inline

UMBRAGE_WIDE Wide3 load(const float corner[3][kLanes], int first) {
  return {_mm256_cvtps_pd(_mm_load_ps(corner[0] + first)), _mm256_cvtps_pd(_mm_load_ps(corner[1] + first)),
          _mm256_cvtps_pd(_mm_load_ps(corner[2] + first))};
}
UMBRAGE_WIDE Wide3 minus(const Wide3& a, const Wide3& b) {
  return {_mm256_sub_pd(a.x, b.x), _mm256_sub_pd(a.y, b.y), _mm256_sub_pd(a.z, b.z)};
}
UMBRAGE_WIDE Wide3 absolute(const Wide3& a) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return {_mm256_andnot_pd(sign, a.x), _mm256_andnot_pd(sign, a.y), _mm256_andnot_pd(sign, a.z)};
}
UMBRAGE_WIDE Wide3 atLight(const Wide3& a, const Vec4& light) {
  const __m256d w = _mm256_set1_pd(light.w);
  const Wide3 l{_mm256_set1_pd(light.x), _mm256_set1_pd(light.y), _mm256_set1_pd(light.z)};
  return minus(l, {_mm256_mul_pd(a.x, w), _mm256_mul_pd(a.y, w), _mm256_mul_pd(a.z, w)});
}

// The two sums of lightSide, operand by operand.
UMBRAGE_WIDE __m256d volumeOf(const Wide3& c, const Wide3& l, const Wide3& b) {
  const __m256d x = _mm256_mul_pd(_mm256_sub_pd(_mm256_mul_pd(c.y, l.z), _mm256_mul_pd(c.z, l.y)), b.x);
  const __m256d y = _mm256_mul_pd(_mm256_sub_pd(_mm256_mul_pd(c.z, l.x), _mm256_mul_pd(c.x, l.z)), b.y);
  const __m256d z = _mm256_mul_pd(_mm256_sub_pd(_mm256_mul_pd(c.x, l.y), _mm256_mul_pd(c.y, l.x)), b.z);
  return _mm256_add_pd(_mm256_add_pd(x, y), z);
}
UMBRAGE_WIDE __m256d sizeOf(const Wide3& c, const Wide3& l, const Wide3& b) {
  const __m256d x = _mm256_mul_pd(_mm256_add_pd(_mm256_mul_pd(c.y, l.z), _mm256_mul_pd(c.z, l.y)), b.x);
  const __m256d y = _mm256_mul_pd(_mm256_add_pd(_mm256_mul_pd(c.z, l.x), _mm256_mul_pd(c.x, l.z)), b.y);
  const __m256d z = _mm256_mul_pd(_mm256_add_pd(_mm256_mul_pd(c.x, l.y), _mm256_mul_pd(c.y, l.x)), b.z);
  return _mm256_add_pd(_mm256_add_pd(x, y), z);
}

}  // namespace

[[gnu::target("avx2")]] void TriangleLanes::sidesOfWide(const Block& block, const Vec4& light,
                                                        std::int8_t out[kLanes]) {
  for (int first = 0; first < kLanes; first += 4) {
    const Wide3 a = load(block.corner[0], first), b = load(block.corner[1], first), c = load(block.corner[2], first);
    const Wide3 ac = minus(c, a), al = atLight(a, light), ab = minus(b, a);
    const __m256d volume = volumeOf(ac, al, ab);
    const __m256d size = _mm256_mul_pd(_mm256_set1_pd(0x1p-50), sizeOf(absolute(ac), absolute(al), absolute(ab)));
    const __m256d zero = _mm256_setzero_pd();
    // As written in lightSide: what is not within the bound is -1 unless it is positive, so that NaN falls the same way.
    const __m256d within = _mm256_cmp_pd(_mm256_andnot_pd(_mm256_set1_pd(-0.0), volume), size, _CMP_LE_OQ);
    const int none = _mm256_movemask_pd(within), positive = _mm256_movemask_pd(_mm256_cmp_pd(volume, zero, _CMP_GT_OQ));
    for (int k = 0; k < 4; ++k)
      out[first + k] = static_cast<std::int8_t>((none >> k & 1) != 0 ? 0 : (positive >> k & 1) * 2 - 1);
  }
}
#else
void TriangleLanes::sidesOfWide(const Block& block, const Vec4& light, std::int8_t out[kLanes]) {
  sidesOf(block, light, out);
}
#endif

void TriangleLanes::sides(const Vec4& light, std::size_t begin, std::size_t end, std::span<std::int8_t> side,
                          bool avx2) const {
  std::int8_t last[kLanes];
  for (std::size_t t = begin; t < end; t += kLanes) {
    const bool whole = t + kLanes <= end;
    std::int8_t* out = whole ? side.data() + t : last;
    if (avx2)
      sidesOfWide(blocks_[t / kLanes], light, out);
    else
      sidesOf(blocks_[t / kLanes], light, out);
    if (!whole) std::copy_n(last, end - t, side.data() + t);
  }
}

}  // namespace umbrage::shadow
