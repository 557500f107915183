#include "umbrage/raster/veils.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace umbrage::raster {
namespace {

constexpr std::size_t kPixels = kBlock * kBlock;

using Fragment = VeilRaster::Fragment;

struct Covered {
  std::uint64_t sure = 0, asked = 0;  ///< pixels, a bit each: in the patch; left to exact arithmetic
};

// Where the patch covers a block, nearer than what is seen there.
UMBRAGE_IN_BLOCKS Covered coverBlock(const BlockPatch& t, const Span& rows, const float* behind, float* nearness) {
  const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  Float8 edge[3];
  for (int k = 0; k < 3; ++k) edge[k] = (t.at[k] + t.dy[k] * static_cast<float>(rows.begin)) + t.dx[k] * lane;
  const Float8 near = t.at[3] + t.dx[3] * lane;
  Covered covered;
  for (int row = rows.begin; row < rows.end; ++row) {
    Float8& here = reinterpret_cast<Float8&>(nearness[row * kBlock]);
    here = near + t.dy[3] * static_cast<float>(row);
    Int8 maybe = here > reinterpret_cast<const Float8&>(behind[row * kBlock]), sure = maybe;
    for (int k = 0; k < 3; ++k) sure &= edge[k] > t.doubt[k], maybe &= edge[k] > -t.doubt[k];
    covered.sure |= std::uint64_t{bitsOf(sure)} << (row * kBlock);
    covered.asked |= std::uint64_t{bitsOf(maybe & ~sure)} << (row * kBlock);
    for (int k = 0; k < 3; ++k) edge[k] += t.dy[k];
  }
  return covered;
}

/// One thread's work on a band.
struct BandVeils {
  const Corners& corners;
  const SeenBlocks& seen;
  int width;                         ///< of the picture
  int first, last;                   ///< rows of blocks
  std::vector<Fragment>& fragments;  ///< in the order of the patches
  std::span<std::uint32_t> depth;    ///< per pixel, row by row: its fragments
  std::vector<float> farthest;       ///< per block: nearness of the farthest opaque pixel

  BandVeils(const Corners& c, const SeenBlocks& s, int w, int band, std::vector<Fragment>& f,
            std::span<std::uint32_t> d)
      : corners(c),
        seen(s),
        width(w),
        first(band * kBandBlocks),
        last(std::min(first + kBandBlocks, s.nearness.rows)),
        fragments(f),
        depth(d) {
    fragments.clear();
    for (std::size_t i = seen.nearness.index(0, first); i < seen.nearness.index(0, last); ++i) {
      const auto& pixels = seen.nearness.blocks[i].pixel;
      farthest.push_back(*std::min_element(pixels.begin(), pixels.end()));
    }
  }

  void add(const Covered& covered, const Patch& patch, int column, int row, const float* nearness) {
    std::uint64_t in = covered.sure;
    for (std::uint64_t asked = covered.asked; asked != 0; asked &= asked - 1) {
      const int bit = std::countr_zero(asked);
      if (patch.covers(corners, kBlock * column + bit % kBlock, kBlock * row + bit / kBlock)) in |= asked & -asked;
    }
    const int corner = kBlock * (row - first) * width + kBlock * column;
    for (; in != 0; in &= in - 1) {
      const int bit = std::countr_zero(in), x = bit % kBlock;
      const auto pixel = static_cast<std::uint32_t>(corner + bit / kBlock * width + x);
      if (kBlock * column + x >= width || pixel >= depth.size()) continue;  // blocks stick out of the picture
      fragments.push_back({pixel, nearness[bit], patch.id});
      ++depth[pixel];
    }
  }
};

UMBRAGE_VECTOR_UNITS void drawVeil(BandVeils& band, const Patch& patch) {
  const int begin = std::max(band.first, patch.y0 / kBlock),
            end = std::min(band.last, (patch.y1 + kBlock - 1) / kBlock);
  alignas(64) float nearness[kPixels];
  for (int row = begin; row < end; ++row) {
    const Span columns = columnsOf(patch, row, row + 1, 0.0);
    if (columns.begin >= columns.end) continue;
    BlockPatch t;
    overSquares<kBlock>(patch, columns.begin, row, t);
    const Span rows = rowsOf(patch, row);
    for (int column = columns.begin; column < columns.end; ++column, moveOn(t, 1)) {
      const auto block = static_cast<std::size_t>((row - band.first) * band.seen.nearness.columns + column);
      const auto most = lanesOf<float>(t.at + t.above + t.doubt);
      if (most[3] <= band.farthest[block] || most[0] < 0.0f || most[1] < 0.0f || most[2] < 0.0f) continue;
      const float* behind = band.seen.nearness.blocks[band.seen.nearness.index(column, row)].pixel.data();
      const Covered covered = coverBlock(t, rows, behind, nearness);
      if ((covered.sure | covered.asked) != 0) band.add(covered, patch, column, row, nearness);
    }
  }
}

/// By depth, then by triangle: depths are above 0, and such numbers are in the order of their bits.
std::uint64_t orderOf(const shadow::Veil& veil) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(veil.depth)} << 32 | veil.triangle;
}

// Mostly a handful.
void sortFew(std::span<shadow::Veil> veils) {
  constexpr std::size_t kFew = 16;
  if (veils.size() > kFew) {
    std::ranges::sort(veils, {}, [](const shadow::Veil& veil) { return orderOf(veil); });  // a lambda is inlined
    return;
  }
  for (std::size_t i = 1; i < veils.size(); ++i)
    for (std::size_t k = i; k > 0 && orderOf(veils[k]) < orderOf(veils[k - 1]); --k) std::swap(veils[k], veils[k - 1]);
}

// Puts a band's fragments where they belong. `first`: per pixel of the band, and one more.
void place(std::span<const Fragment> fragments, std::span<std::uint32_t> first, float scale,
           std::span<shadow::Veil> veils) {
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (const Fragment& f : fragments) veils[next[f.pixel]++] = {f.triangle, 1.0f / (f.nearness * scale)};
  for (std::size_t pixel = 0; pixel + 1 < first.size(); ++pixel)
    if (first[pixel + 1] - first[pixel] > 1) sortFew(veils.subspan(first[pixel], first[pixel + 1] - first[pixel]));
}

}  // namespace

VeilRaster::VeilRaster(const shadow::Geometry& geometry) : geometry_(geometry) {
  for (std::uint32_t t = 0; t < geometry.surfaces.triangles.size(); ++t)
    if (geometry.filters.isVeil(t)) veils_.push_back(t);
}

Result<void> VeilRaster::draw(const PixelSpace& space, const SeenPositions& positions, const SeenBlocks& seen,
                              shadow::VeilBuffer& out) {
  out = {};
  edgeOn_.clear();
  if (veils_.empty()) return {};
  const auto make = [&](std::size_t i, Patch& patch) {
    const Shown shown = makeSurfacePatch(space, positions, geometry_.surfaces, veils_[i], patch);
    if (shown == Shown::edgeOn) {
      const std::lock_guard lock(edgeOnMutex_);
      edgeOn_.push_back(veils_[i]);
    }
    return shown == Shown::yes;
  };
  const auto everywhere = [](const Patch&, int) { return ~std::uint64_t{0}; };
  if (auto done = bands_.fill(veils_.size(), space.height, make, everywhere); !done) return done;
  std::sort(edgeOn_.begin(), edgeOn_.end());
  const Corners corners{positions.mapped, {}};
  const auto width = static_cast<std::size_t>(space.width), pixels = width * static_cast<std::size_t>(space.height);
  const auto begin = [&](int band) { return std::min(pixels, width * static_cast<std::size_t>(band * kBand)); };
  out.first.assign(pixels + 1, 0);
  fragments_.resize(static_cast<std::size_t>(bands_.count()));
  auto drawn = parallel::forEach(bands_.count(), [&](int band) {
    BandVeils drawing(corners, seen, space.width, band, fragments_[static_cast<std::size_t>(band)],
                      std::span(out.first).subspan(begin(band), begin(band + 1) - begin(band)));
    bands_.forEachIn(band, [&](const Patch& patch, std::uint64_t) { drawVeil(drawing, patch); });
  });
  if (!drawn) return drawn;
  std::uint32_t sum = 0;
  for (std::uint32_t& first : out.first) sum += std::exchange(first, sum);
  out.veils.resize(sum);
  return parallel::forEach(bands_.count(), [&](int band) {
    place(fragments_[static_cast<std::size_t>(band)],
          std::span(out.first).subspan(begin(band), begin(band + 1) - begin(band) + 1), static_cast<float>(space.scale),
          out.veils);
  });
}

Result<void> layersOf(const PixelSpace& space, const shadow::VeilBuffer& veils, std::size_t most, VeilLayers& out) {
  out.columns = (space.width + kBlock - 1) / kBlock, out.rows = (space.height + kBlock - 1) / kBlock;
  out.first.assign(out.index(0, out.rows) + 1, 0);
  out.layers.clear();
  if (veils.empty() || most == 0) return {};
  const auto width = static_cast<std::size_t>(space.width);
  // Calls fn(pixel of the block, its veils).
  const auto forEachPixel = [&](int column, int row, const auto& fn) {
    for (int y = kBlock * row; y < std::min(space.height, kBlock * (row + 1)); ++y)
      for (int x = kBlock * column; x < std::min(space.width, kBlock * (column + 1)); ++x) {
        const auto here = veils.at(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x));
        fn(static_cast<std::size_t>(y % kBlock * kBlock + x % kBlock), here.first(std::min(most, here.size())));
      }
  };
  auto counted = parallel::forEach(out.rows, [&](int row) {
    for (int column = 0; column < out.columns; ++column) {
      std::size_t& count = out.first[out.index(column, row)];
      forEachPixel(column, row,
                   [&](std::size_t, std::span<const shadow::Veil> here) { count = std::max(count, here.size()); });
    }
  });
  if (!counted) return counted;
  std::size_t sum = 0;
  for (std::size_t& first : out.first) sum += std::exchange(first, sum);
  out.layers.resize(sum);
  const auto scale = static_cast<float>(space.scale);
  return parallel::forEach(out.rows, [&](int row) {
    for (int column = 0; column < out.columns; ++column) {
      const std::size_t block = out.index(column, row);
      const std::span<Layer> layers = std::span(out.layers).subspan(out.first[block], out.count(block));
      for (Layer& layer : layers) layer.nearness.fill(Layer::kNone), layer.triangle.fill(shadow::kNoTriangle);
      if (layers.empty()) continue;
      forEachPixel(column, row, [&](std::size_t pixel, std::span<const shadow::Veil> here) {
        for (std::size_t l = 0; l < here.size(); ++l)
          layers[l].nearness[pixel] = 1.0f / (here[l].depth * scale), layers[l].triangle[pixel] = here[l].triangle;
      });
    }
  });
}

}  // namespace umbrage::raster
