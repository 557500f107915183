// Every edge asked, eight at a time. What all other finders are measured against.
#include "umbrage/shadow/finders/brute_force.hpp"

#include <algorithm>
#include <bit>

#include "umbrage/shadow/finders/threads.hpp"

#ifdef UMBRAGE_HAVE_AVX2
#include <immintrin.h>
#endif

namespace umbrage::shadow {
namespace {

constexpr std::uint32_t kNegative = 1u << 31;
constexpr std::size_t kReadPast = 4;            // a gather reads four bytes for one side
constexpr std::size_t kWorthAThread = 100'000;  // triangles or edges

std::int32_t term(const std::int8_t* side, std::uint32_t use) {
  const std::int32_t s = side[use & ~kNegative];
  return (use & kNegative) != 0 ? -s : s;
}

}  // namespace

FoundEdges BruteForce::find(const Vec4& light, const SilhouetteOptions& options) const {
  const std::vector<std::int8_t> side = findSides(casters(), light, options);
  FoundEdges found{{}, casters().edges.size(), kind()};
  for (std::uint32_t e = 0; e < casters().edges.size(); ++e) {
    const CasterEdge& edge = casters().edges[e];
    std::int32_t multiplicity = 0;
    for (std::uint32_t u = edge.begin; u < edge.end; ++u)
      multiplicity += casters().uses[u].sign * side[casters().uses[u].triangle];
    if (multiplicity != 0) found.edges.push_back({e, multiplicity});
  }
  return found;
}

Silhouette BruteForce::silhouette(const Vec4& light, const SilhouetteOptions& options) const {
  return findSilhouette(casters(), light, options);
}

BruteForceSimd::BruteForceSimd(std::shared_ptr<const CasterSet> casters, const FinderOptions& options)
    : SilhouetteFinder(FinderKind::bruteForceSimd, casters),
      lanes_(*casters),
      threads_(threadCount(options.threads)),
      avx2_(options.vectorUnits && processorHasAvx2()) {
  const auto none = static_cast<std::uint32_t>(casters->triangles.size());
  for (auto& list : uses_) list.assign(casters->edges.size(), none);
  for (std::uint32_t e = 0; e < casters->edges.size(); ++e) {
    const CasterEdge& edge = casters->edges[e];
    if (edge.end - edge.begin > 2) {
      manyFaced_.push_back(e);
      continue;
    }
    for (std::uint32_t u = edge.begin; u < edge.end; ++u)
      uses_[u - edge.begin][e] = casters->uses[u].triangle | (casters->uses[u].sign < 0 ? kNegative : 0);
  }
  for (std::uint32_t t = 0; t < casters->triangles.size(); ++t)
    if (casters->outward[t] != 0) convex_.push_back(t);
}

unsigned BruteForceSimd::parts(std::size_t items) const {
  return static_cast<unsigned>(std::clamp<std::size_t>(items / kWorthAThread, 1, threads_));
}

void BruteForceSimd::leaveOutAverted(std::vector<std::int8_t>& side) const {
  if (convex_.empty()) return;
  std::vector<std::uint8_t> seenFromOutside(casters().componentCount, 0);
  for (const std::uint32_t t : convex_)
    if (side[t] * casters().outward[t] > 0) seenFromOutside[casters().componentOf[t]] = 1;
  for (const std::uint32_t t : convex_)
    if (side[t] * casters().outward[t] < 0 && seenFromOutside[casters().componentOf[t]] != 0) side[t] = 0;
}

std::vector<std::int8_t> BruteForceSimd::sides(const Vec4& light, const SilhouetteOptions& options) const {
  const std::size_t count = casters().triangles.size();
  std::vector<std::int8_t> side;
  side.reserve(count + kReadPast);
  side.resize(count);
  inParts(count, kLanes, parts(count),
          [&](unsigned, std::size_t begin, std::size_t end) { lanes_.sides(light, begin, end, side, avx2_); });
  if (!options.countEverySurface) leaveOutAverted(side);
  return side;
}

void BruteForceSimd::addSum(const std::int8_t* side, std::size_t edge, std::vector<SignedEdge>& out) const {
  const std::int32_t sum = term(side, uses_[0][edge]) + term(side, uses_[1][edge]);
  if (sum != 0) out.push_back({static_cast<std::uint32_t>(edge), sum});
}

void BruteForceSimd::sumsOf(const std::int8_t* side, std::size_t begin, std::size_t end,
                            std::vector<SignedEdge>& out) const {
  for (std::size_t e = begin; e < end; ++e) addSum(side, e, out);
}

#ifdef UMBRAGE_HAVE_AVX2
[[gnu::target("avx2")]] void BruteForceSimd::wideSumsOf(const std::int8_t* side, std::size_t begin, std::size_t end,
                                                        std::vector<SignedEdge>& out) const {
  const __m256i index = _mm256_set1_epi32(~kNegative);
  std::size_t e = begin;
  for (; e + kLanes <= end; e += kLanes) {
    __m256i sum = _mm256_setzero_si256();
    for (const auto& uses : uses_) {
      const __m256i use = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(uses.data() + e));
      const __m256i four = _mm256_i32gather_epi32(reinterpret_cast<const int*>(side), _mm256_and_si256(use, index), 1);
      const __m256i s = _mm256_srai_epi32(_mm256_slli_epi32(four, 24), 24), negative = _mm256_srai_epi32(use, 31);
      sum = _mm256_add_epi32(sum, _mm256_sub_epi32(_mm256_xor_si256(s, negative), negative));
    }
    const int zero = _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(sum, _mm256_setzero_si256())));
    alignas(32) std::int32_t sums[kLanes];
    _mm256_store_si256(reinterpret_cast<__m256i*>(sums), sum);
    for (unsigned bits = ~static_cast<unsigned>(zero) & 0xffu; bits != 0; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      out.push_back({static_cast<std::uint32_t>(e) + static_cast<std::uint32_t>(lane), sums[lane]});
    }
  }
  sumsOf(side, e, end, out);
}
#else
void BruteForceSimd::wideSumsOf(const std::int8_t* side, std::size_t begin, std::size_t end,
                                std::vector<SignedEdge>& out) const {
  sumsOf(side, begin, end, out);
}
#endif

std::vector<SignedEdge> BruteForceSimd::sums(const std::vector<std::int8_t>& sideOf) const {
  std::vector<std::int8_t> side = sideOf;
  side.resize(sideOf.size() + kReadPast, 0);
  const std::size_t count = casters().edges.size();
  std::vector<std::vector<SignedEdge>> found(parts(count));
  inParts(count, kLanes, parts(count), [&](unsigned part, std::size_t begin, std::size_t end) {
    if (avx2_)
      wideSumsOf(side.data(), begin, end, found[part]);
    else
      sumsOf(side.data(), begin, end, found[part]);
  });
  std::vector<SignedEdge> all = std::move(found[0]);
  for (std::size_t part = 1; part < found.size(); ++part) all.insert(all.end(), found[part].begin(), found[part].end());
  const auto middle = static_cast<std::ptrdiff_t>(all.size());
  for (const std::uint32_t e : manyFaced_) {
    std::int32_t sum = 0;
    for (std::uint32_t u = casters().edges[e].begin; u < casters().edges[e].end; ++u)
      sum += casters().uses[u].sign * side[casters().uses[u].triangle];
    if (sum != 0) all.push_back({e, sum});
  }
  std::inplace_merge(all.begin(), all.begin() + middle, all.end(),
                     [](const SignedEdge& a, const SignedEdge& b) { return a.edge < b.edge; });
  return all;
}

FoundEdges BruteForceSimd::find(const Vec4& light, const SilhouetteOptions& options) const {
  return {sums(sides(light, options)), casters().edges.size(), kind()};
}

Silhouette BruteForceSimd::silhouette(const Vec4& light, const SilhouetteOptions& options) const {
  std::vector<std::int8_t> side = sides(light, options);
  const FoundEdges found{sums(side), casters().edges.size(), kind()};
  return assemble(casters(), light, found, std::move(side));
}

std::size_t BruteForceSimd::memory() const {
  return lanes_.memory() + (uses_[0].capacity() + uses_[1].capacity() + manyFaced_.capacity() + convex_.capacity()) *
                               sizeof(std::uint32_t);
}

}  // namespace umbrage::shadow
