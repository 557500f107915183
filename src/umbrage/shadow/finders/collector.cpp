#include "umbrage/shadow/finders/collector.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace umbrage::shadow {
namespace {

constexpr std::size_t kFew = 256;
constexpr unsigned kDigitBits = 11;

void radixSort(std::vector<SignedEdge>& edges, std::size_t edgeCount) {
  const unsigned bits = static_cast<unsigned>(std::bit_width(edgeCount));
  std::vector<SignedEdge> other(edges.size());
  for (unsigned shift = 0; shift < bits; shift += kDigitBits) {
    const auto digit = [shift](const SignedEdge& e) { return (e.edge >> shift) & ((1u << kDigitBits) - 1); };
    std::array<std::uint32_t, (1u << kDigitBits) + 1> begin{};
    for (const SignedEdge& e : edges) ++begin[digit(e) + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    for (const SignedEdge& e : edges) other[begin[digit(e)]++] = e;
    edges.swap(other);
  }
}

// One byte an edge, written in any order and read in order: faster where much of the mesh is on its silhouette.
bool sortByMap(std::vector<SignedEdge>& edges, std::size_t edgeCount) {
  std::vector<std::int8_t> map((edgeCount + 7) / 8 * 8, 0);
  for (const SignedEdge& e : edges) {
    if (e.multiplicity != static_cast<std::int8_t>(e.multiplicity)) return false;
    map[e.edge] = static_cast<std::int8_t>(e.multiplicity);
  }
  SignedEdge* out = edges.data();
  for (std::uint32_t word = 0; word < map.size(); word += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, map.data() + word, 8);
    if (eight == 0) continue;
    for (std::uint32_t e = word; e < word + 8; ++e)
      if (map[e] != 0) *out++ = {e, map[e]};
  }
  return true;
}

}  // namespace

void sortByEdge(std::vector<SignedEdge>& edges, std::size_t edgeCount) {
  if (edges.size() < kFew) {
    std::sort(edges.begin(), edges.end(), [](const SignedEdge& a, const SignedEdge& b) { return a.edge < b.edge; });
  } else if (edges.size() * 16 < edgeCount || !sortByMap(edges, edgeCount)) {
    radixSort(edges, edgeCount);
  }
}

void TagReader::read(const SegmentBlock& block, const LaneSigns& signs, std::uint32_t live, Collector& out) const {
  const std::uint32_t falling = signs.falling();
  for (std::uint32_t left = live & ~signs.same(); left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    if (((falling | signs.rising()) >> lane & 1) != 0)
      crossed(block.tag[lane], (falling >> lane & 1) != 0, out);
    else
      out.addDoubtful(block.tag[lane] & kTagEdge);
  }
}

std::vector<SignedEdge> Collector::take(ExactEdges::Query& exact, std::size_t edgeCount) {
  std::sort(doubtful_.begin(), doubtful_.end());
  doubtful_.erase(std::unique(doubtful_.begin(), doubtful_.end()), doubtful_.end());
  for (const std::uint32_t edge : doubtful_)
    if (const std::int32_t m = exact.multiplicity(edge); m != 0) sure_.push_back({edge, m});
  doubtful_.clear();
  sortByEdge(sure_, edgeCount);
  return std::exchange(sure_, {});
}

}  // namespace umbrage::shadow
