#include "umbrage/coin/detail/subsets.hpp"

#include <algorithm>
#include <cstring>
#include <unordered_map>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/base/vector_units.hpp"
#include "umbrage/parallel/for_each.hpp"

namespace umbrage::coin::detail {
namespace {

constexpr std::size_t kMost = 65535;

constexpr int kBandRows = 16;  // one thread works on them

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

/// The sets of lights that do not reach, told as bits, in the order in which they are met, each with the box around its pixels.
class Codes {
 public:
  struct Set {
    std::uint64_t off;
    gl::Rect box;
  };
  /// i + 1 for the i-th set; 0 for none, and where there are too many.
  std::uint16_t of(std::uint64_t off) {
    if (off == 0) return 0;
    if (const auto known = known_.find(off); known != known_.end()) return known->second;
    if (sets_.size() == kMost) return 0;
    sets_.push_back({off, {}});
    return known_[off] = static_cast<std::uint16_t>(sets_.size());
  }
  gl::Rect& box(std::uint16_t code) { return sets_[code - 1u].box; }
  [[nodiscard]] const std::vector<Set>& sets() const { return sets_; }

 private:
  std::vector<Set> sets_;
  std::unordered_map<std::uint64_t, std::uint16_t> known_;
};

// Without branches, so that it goes many pixels at a time.
UMBRAGE_VECTOR_UNITS void addOff(const std::uint8_t* light, const std::uint8_t* covered, std::uint8_t bit,
                                 std::size_t width, std::uint8_t* off) {
  for (std::size_t x = 0; x < width; ++x) {
    const std::uint8_t isOff = (covered[x] != 0 ? bit : std::uint8_t{0}) & (light[x] == 0 ? bit : std::uint8_t{0});
    off[x] = static_cast<std::uint8_t>(off[x] | isOff);
  }
}
void addOff(const std::uint8_t* light, const std::uint8_t* covered, std::uint64_t bit, std::size_t width,
            std::uint64_t* off) {
  for (std::size_t x = 0; x < width; ++x) off[x] |= covered[x] != 0 && light[x] == 0 ? bit : 0;
}

template <class Off>
void offInRow(std::span<const shadow::LightMask> masks, int y, std::vector<Off>& off) {
  std::ranges::fill(off, Off{0});
  for (std::size_t i = 0; i < masks.size(); ++i)
    addOff(masks[i].light.row(y), masks[i].covered.row(y), static_cast<Off>(Off{1} << i), off.size(), off.data());
}

template <class Off>
void keepShining(const Shining& shining, int y, std::vector<Off>& off) {
  const std::uint32_t* triangle = shining.triangle->row(y);
  for (std::size_t x = 0; x < off.size(); ++x)
    if (off[x] != 0) off[x] = static_cast<Off>(off[x] & shining.lights[triangle[x]]);
}

// Where a row of equal values ends that begins at `begin`.
template <class Off>
std::size_t endOfRun(const std::vector<Off>& off, std::size_t begin) {
  std::size_t end = begin + 1;
  if constexpr (sizeof(Off) == 1) {
    const std::uint64_t same = 0x0101010101010101u * off[begin];
    for (std::uint64_t eight = 0; end + 8 <= off.size(); end += 8) {
      std::memcpy(&eight, &off[end], 8);
      if (eight != same) break;
    }
  }
  while (end < off.size() && off[end] == off[begin]) ++end;
  return end;
}

/// Rows of a picture that one thread works on; it knows no codes but its own.
struct Band {
  Codes codes;
  std::vector<std::uint16_t> inAll;  ///< per code of its own: that of the whole picture
};

template <class Off>
void findInBand(std::span<const shadow::LightMask> masks, const Shining& shining, int first, int end, Subsets& out,
                Codes& codes) {
  std::vector<Off> off(static_cast<std::size_t>(out.width));
  for (int y = first; y < end; ++y) {
    offInRow(masks, out.height - 1 - y, off);
    if (!shining.lights.empty()) keepShining(shining, out.height - 1 - y, off);
    std::uint16_t* row = out.codes.data() + static_cast<std::size_t>(y) * off.size();
    // Neighbours are mostly alike, so what costs is done once a run.
    for (std::size_t x = 0, next = 0; x < off.size(); x = next) {
      next = endOfRun(off, x);
      const std::uint16_t code = codes.of(off[x]);
      std::fill(row + x, row + next, code);
      if (code == 0) continue;
      enlarge(codes.box(code), static_cast<int>(x), y);
      enlarge(codes.box(code), static_cast<int>(next) - 1, y);
    }
  }
}

void enlarge(gl::Rect& box, const gl::Rect& by) {
  enlarge(box, by.x, by.y);
  enlarge(box, by.x + by.width - 1, by.y + by.height - 1);
}

// The codes of the whole picture, in the order in which its bands have them from the bottom.
void join(std::vector<Band>& bands, std::size_t lights, Subsets& out) {
  Codes codes;
  for (Band& band : bands) {
    band.inAll = {0};
    for (const Codes::Set& set : band.codes.sets()) {
      const std::uint16_t code = codes.of(set.off);
      band.inAll.push_back(code);
      if (code != 0) enlarge(codes.box(code), set.box);
    }
  }
  for (const Codes::Set& set : codes.sets()) {
    out.all.push_back({{}, set.box});
    for (std::size_t i = 0; i < lights; ++i)
      if ((set.off >> i & 1u) != 0) out.all.back().off.push_back(i);
  }
}

bool isOwn(const std::vector<std::uint16_t>& inAll) {
  for (std::size_t i = 0; i < inAll.size(); ++i)
    if (inAll[i] != i) return false;
  return true;
}

}  // namespace

Result<Subsets> subsetsOf(std::span<const shadow::LightMask> masks, const Shining& shining) {
  Subsets out;
  if (masks.empty()) return out;
  UMBRAGE_CHECK(masks.size() <= kMostLights, "too many lights");
  out.width = masks[0].light.width();
  out.height = masks[0].light.height();
  out.codes.resize(masks[0].light.size());
  const auto rowsOf = [&](int band) {
    return std::pair{band * kBandRows, std::min(out.height, (band + 1) * kBandRows)};
  };
  std::vector<Band> bands(static_cast<std::size_t>((out.height + kBandRows - 1) / kBandRows));
  auto found = parallel::forEach(static_cast<int>(bands.size()), [&](int band) {
    const auto [first, end] = rowsOf(band);
    const auto find = masks.size() <= 8 ? findInBand<std::uint8_t> : findInBand<std::uint64_t>;
    find(masks, shining, first, end, out, bands[static_cast<std::size_t>(band)].codes);
  });
  if (!found) return tl::unexpected(found.error());
  join(bands, masks.size(), out);
  if (std::ranges::all_of(bands, [](const Band& band) { return isOwn(band.inAll); })) return out;
  auto renamed = parallel::forEach(static_cast<int>(bands.size()), [&](int band) {
    const std::vector<std::uint16_t>& inAll = bands[static_cast<std::size_t>(band)].inAll;
    if (isOwn(inAll)) return;
    const auto [first, end] = rowsOf(band);
    const auto width = static_cast<std::size_t>(out.width);
    for (std::size_t i = static_cast<std::size_t>(first) * width; i < static_cast<std::size_t>(end) * width; ++i)
      out.codes[i] = inAll[out.codes[i]];
  });
  if (!renamed) return tl::unexpected(renamed.error());
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

// In whole numbers without branches, so that it goes many pixels at a time.
UMBRAGE_VECTOR_UNITS void toStencil(const std::uint16_t* codes, std::size_t count, std::uint16_t first,
                                    std::uint8_t* stencil) {
  const std::uint8_t none = first == 0 ? 0 : kNotNow;
  for (std::size_t i = 0; i < count; ++i) {
    const auto turn = static_cast<std::uint16_t>(codes[i] - first);
    const bool now = (codes[i] > first) & (turn <= kPerRound);
    const std::uint8_t other = codes[i] == 0 ? none : kNotNow;
    stencil[i] = now ? static_cast<std::uint8_t>(turn) : other;
  }
}

Result<image::UnsetVector<std::uint8_t>> stencilOf(const Subsets& subsets, std::size_t round, const gl::Rect& box) {
  const auto width = static_cast<std::size_t>(box.width), stride = static_cast<std::size_t>(subsets.width);
  image::UnsetVector<std::uint8_t> stencil(width * static_cast<std::size_t>(box.height));
  auto done = parallel::forEach((box.height + kBandRows - 1) / kBandRows, [&](int band) {
    for (int y = band * kBandRows; y < std::min(box.height, (band + 1) * kBandRows); ++y)
      toStencil(subsets.codes.data() + static_cast<std::size_t>(box.y + y) * stride + static_cast<std::size_t>(box.x),
                width, static_cast<std::uint16_t>(round * kPerRound),
                stencil.data() + static_cast<std::size_t>(y) * width);
  });
  if (!done) return tl::unexpected(done.error());
  return stencil;
}

}  // namespace umbrage::coin::detail
