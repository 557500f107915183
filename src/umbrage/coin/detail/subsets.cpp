#include "umbrage/coin/detail/subsets.hpp"

#include <algorithm>
#include <unordered_map>

#include "umbrage/base/check.hpp"

namespace umbrage::coin::detail {
namespace {

constexpr std::size_t kMost = 65535;

/// Finds the code of a set of lights, told as bits.
class Codes {
 public:
  explicit Codes(Subsets& out) : out_(out) {}

  std::uint16_t of(std::uint64_t off, std::size_t lights) {
    if (off == 0) return 0;
    if (const auto known = known_.find(off); known != known_.end()) return known->second;
    return out_.all.size() < kMost ? add(off, lights) : std::uint16_t{0};
  }

 private:
  std::uint16_t add(std::uint64_t off, std::size_t lights) {
    Subset subset;
    for (std::size_t i = 0; i < lights; ++i)
      if ((off >> i & 1u) != 0) subset.off.push_back(i);
    out_.all.push_back(std::move(subset));
    return known_[off] = static_cast<std::uint16_t>(out_.all.size());
  }
  Subsets& out_;
  std::unordered_map<std::uint64_t, std::uint16_t> known_;
};

void offInRow(std::span<const shadow::LightMask> masks, int y, std::vector<std::uint64_t>& off) {
  std::ranges::fill(off, 0);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const std::uint8_t* light = masks[i].light.row(y);
    const std::uint8_t* covered = masks[i].covered.row(y);
    for (std::size_t x = 0; x < off.size(); ++x) off[x] |= std::uint64_t{covered[x] != 0 && light[x] == 0} << i;
  }
}

void keepShining(const Shining& shining, int y, std::vector<std::uint64_t>& off) {
  const std::uint32_t* triangle = shining.triangle->row(y);
  for (std::size_t x = 0; x < off.size(); ++x)
    if (off[x] != 0) off[x] &= shining.lights[triangle[x]];
}

void enlarge(gl::Rect& box, int x, int y) {
  if (box.empty()) {
    box = {x, y, 1, 1};
    return;
  }
  const int right = std::max(box.x + box.width, x + 1), top = std::max(box.y + box.height, y + 1);
  box.x = std::min(box.x, x);
  box.y = std::min(box.y, y);
  box.width = right - box.x;
  box.height = top - box.y;
}

}  // namespace

Subsets subsetsOf(std::span<const shadow::LightMask> masks, const Shining& shining) {
  Subsets out;
  if (masks.empty()) return out;
  UMBRAGE_CHECK(masks.size() <= kMostLights, "too many lights");
  out.width = masks[0].light.width();
  out.height = masks[0].light.height();
  out.codes.resize(masks[0].light.size());
  Codes codes(out);
  std::vector<std::uint64_t> off(static_cast<std::size_t>(out.width));
  for (int y = 0; y < out.height; ++y) {
    offInRow(masks, out.height - 1 - y, off);
    if (!shining.lights.empty()) keepShining(shining, out.height - 1 - y, off);
    std::uint16_t* row = out.codes.data() + static_cast<std::size_t>(y) * off.size();
    // Neighbours are mostly alike, so what costs is done once a run.
    for (std::size_t x = 0, end = 0; x < off.size(); x = end) {
      for (end = x + 1; end < off.size() && off[end] == off[x];) ++end;
      const std::uint16_t code = codes.of(off[x], masks.size());
      std::fill(row + x, row + end, code);
      if (code == 0) continue;
      enlarge(out.all[code - 1u].box, static_cast<int>(x), y);
      enlarge(out.all[code - 1u].box, static_cast<int>(end) - 1, y);
    }
  }
  return out;
}

std::size_t roundsOf(const Subsets& subsets) { return (subsets.all.size() + kPerRound - 1) / kPerRound; }

gl::Rect boxOf(const Subsets& subsets) {
  gl::Rect box;
  for (const Subset& subset : subsets.all) {
    enlarge(box, subset.box.x, subset.box.y);
    enlarge(box, subset.box.x + subset.box.width - 1, subset.box.y + subset.box.height - 1);
  }
  return box;
}

std::vector<std::uint8_t> stencilOf(const Subsets& subsets, std::size_t round, const gl::Rect& box) {
  std::vector<std::uint8_t> stencil;
  stencil.reserve(static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height));
  const std::size_t first = round * kPerRound;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const std::uint16_t* codes =
        subsets.codes.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(subsets.width);
    for (int x = box.x; x < box.x + box.width; ++x) {
      const std::size_t code = codes[x];
      const bool turn = code == 0 ? round == 0 : code > first && code <= first + kPerRound;
      stencil.push_back(!turn ? kNotNow : code == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(code - first));
    }
  }
  return stencil;
}

}  // namespace umbrage::coin::detail
