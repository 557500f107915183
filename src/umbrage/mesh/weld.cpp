#include "umbrage/mesh/weld.hpp"

#include <bit>
#include <cstddef>
#include <type_traits>

namespace umbrage::mesh {
namespace {

std::uint64_t mixed(std::uint64_t h) {  // the finaliser of MurmurHash3
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ULL;
  return h ^ (h >> 33);
}

template <class V>
std::uint64_t hashOf(const V& p) {
  using Scalar = typename V::value_type;
  using Bits = std::conditional_t<sizeof(Scalar) == 8, std::uint64_t, std::uint32_t>;
  std::uint64_t h = 0;
  for (int i = 0; i < 3; ++i) h = mixed(h ^ std::bit_cast<Bits>(static_cast<Scalar>(p[i] + Scalar(0))));  // -0 + 0 = +0
  return h;
}

template <class V>
Weld weldPoints(std::span<const V> positions) {
  constexpr std::uint32_t kFree = ~std::uint32_t{0};
  const std::size_t slots = std::bit_ceil(positions.size() * 2 + 1);
  std::vector<std::uint32_t> table(slots, kFree);
  Weld result;
  result.remap.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::size_t slot = hashOf(positions[i]) & (slots - 1);
    while (table[slot] != kFree && positions[result.first[table[slot]]] != positions[i])
      slot = (slot + 1) & (slots - 1);
    if (table[slot] == kFree) {
      table[slot] = static_cast<std::uint32_t>(result.first.size());
      result.first.push_back(static_cast<std::uint32_t>(i));
    }
    result.remap[i] = table[slot];
  }
  return result;
}

}  // namespace

Weld weld(std::span<const Vec3> positions) { return weldPoints(positions); }
Weld weld(std::span<const Vec3f> positions) { return weldPoints(positions); }

}  // namespace umbrage::mesh
