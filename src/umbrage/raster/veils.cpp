#include "umbrage/raster/veils.hpp"

#include <algorithm>
#include <bit>

namespace umbrage::raster {
namespace {

constexpr std::size_t kPixels = kBlock * kBlock;

/// A pixel of a veil.
struct Fragment {
  std::uint32_t block;  ///< in its band
  std::uint32_t pixel;
  float nearness;
  std::uint32_t triangle;
};

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
  int first, last;  ///< rows of blocks
  std::vector<Fragment> fragments;
  std::vector<std::uint32_t> depth;  ///< per block and pixel: its fragments
  std::vector<float> farthest;       ///< per block: nearness of the farthest opaque pixel

  BandVeils(const Corners& c, const SeenBlocks& s, int band)
      : corners(c), seen(s), first(band * kBandBlocks), last(std::min(first + kBandBlocks, s.nearness.rows)) {
    const auto blocks = static_cast<std::size_t>((last - first) * s.nearness.columns);
    depth.assign(blocks * kPixels, 0);
    for (std::size_t i = 0; i < blocks; ++i) {
      const auto& pixels = seen.nearness.blocks[seen.nearness.index(0, first) + i].pixel;
      farthest.push_back(*std::min_element(pixels.begin(), pixels.end()));
    }
  }

  void add(std::uint32_t block, const Covered& covered, const Patch& patch, int column, int row,
           const float* nearness) {
    std::uint64_t in = covered.sure;
    for (std::uint64_t asked = covered.asked; asked != 0; asked &= asked - 1) {
      const int bit = std::countr_zero(asked);
      if (patch.covers(corners, kBlock * column + bit % kBlock, kBlock * row + bit / kBlock)) in |= asked & -asked;
    }
    for (; in != 0; in &= in - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(in));
      fragments.push_back({block, bit, nearness[bit], patch.id});
      ++depth[block * kPixels + bit];
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
      const auto block = static_cast<std::uint32_t>((row - band.first) * band.seen.nearness.columns + column);
      const auto most = lanesOf<float>(t.at + t.above + t.doubt);
      if (most[3] <= band.farthest[block] || most[0] < 0.0f || most[1] < 0.0f || most[2] < 0.0f) continue;
      const float* behind = band.seen.nearness.blocks[band.seen.nearness.index(column, row)].pixel.data();
      const Covered covered = coverBlock(t, rows, behind, nearness);
      if ((covered.sure | covered.asked) != 0) band.add(block, covered, patch, column, row, nearness);
    }
  }
}

// The layers of one band.
struct BandLayers {
  std::vector<std::size_t> count;  ///< per block
  std::vector<Layer> layers;
};

bool isNearer(float nearnessA, std::uint32_t a, float nearnessB, std::uint32_t b) {
  return nearnessA > nearnessB || (nearnessA == nearnessB && a < b);
}

// The last of `count` veils of a pixel moves to where it belongs.
void sink(std::span<Layer> layers, std::size_t pixel, std::size_t count) {
  for (std::size_t l = count; l > 1; --l) {
    Layer &here = layers[l], &before = layers[l - 1];
    if (isNearer(before.nearness[pixel], before.triangle[pixel], here.nearness[pixel], here.triangle[pixel])) return;
    std::swap(before.nearness[pixel], here.nearness[pixel]);
    std::swap(before.triangle[pixel], here.triangle[pixel]);
  }
}

BandLayers layersOf(BandVeils& band) {
  BandLayers out;
  std::vector<std::size_t> first;
  for (std::size_t block = 0; block < band.farthest.size(); ++block) {
    const auto begin = band.depth.begin() + static_cast<std::ptrdiff_t>(block * kPixels);
    first.push_back(out.layers.size());
    out.count.push_back(1 + *std::max_element(begin, begin + kPixels));
    const std::size_t at = band.seen.nearness.index(0, band.first) + block;
    out.layers.push_back({band.seen.nearness.blocks[at].pixel, band.seen.triangle.blocks[at].pixel});
    Layer none;
    none.nearness.fill(Layer::kNone), none.triangle.fill(shadow::kNoTriangle);
    out.layers.resize(first.back() + out.count.back(), none);
  }
  // Where many lie behind each other, their ways down the pixels would be long.
  constexpr std::size_t kDeep = 24;
  if (*std::ranges::max_element(out.count) > kDeep)
    std::ranges::sort(band.fragments, [](const Fragment& a, const Fragment& b) {
      return isNearer(a.nearness, a.triangle, b.nearness, b.triangle);
    });
  std::ranges::fill(band.depth, 0u);
  for (const Fragment& f : band.fragments) {
    const std::size_t place = ++band.depth[f.block * kPixels + f.pixel];
    const std::span<Layer> layers = std::span(out.layers).subspan(first[f.block]);
    layers[place].nearness[f.pixel] = f.nearness, layers[place].triangle[f.pixel] = f.triangle;
    sink(layers, f.pixel, place);
  }
  return out;
}

}  // namespace

VeilRaster::VeilRaster(const shadow::Geometry& geometry) : geometry_(geometry) {
  for (std::uint32_t t = 0; t < geometry.surfaces.triangles.size(); ++t)
    if (geometry.filters.isVeil(t)) veils_.push_back(t);
}

Result<void> VeilRaster::draw(const PixelSpace& space, const SeenPositions& positions, const SeenBlocks& seen,
                              LayeredBlocks& out) {
  edgeOn_.clear();
  const auto make = [&](std::size_t i, Patch& patch) {
    const Shown shown = makeSurfacePatch(space, positions, geometry_.surfaces, veils_[i], patch);
    if (shown == Shown::edgeOn) {
      const std::lock_guard lock(edgeOnMutex_);
      edgeOn_.push_back(veils_[i]);
    }
    return shown == Shown::yes;
  };
  if (auto done = bands_.fill(veils_.size(), space.height, make, [](const Patch&, int) { return ~std::uint64_t{0}; });
      !done)
    return done;
  std::sort(edgeOn_.begin(), edgeOn_.end());
  const Corners corners{positions.mapped, {}};
  std::vector<BandLayers> bands(static_cast<std::size_t>(bands_.count()));
  if (auto done = parallel::forEach(bands_.count(),
                                    [&](int band) {
                                      BandVeils drawing(corners, seen, band);
                                      bands_.forEachIn(
                                          band, [&](const Patch& patch, std::uint64_t) { drawVeil(drawing, patch); });
                                      bands[static_cast<std::size_t>(band)] = layersOf(drawing);
                                    });
      !done)
    return done;
  out.columns = seen.nearness.columns, out.rows = seen.nearness.rows;
  out.first.assign(1, 0);
  for (const BandLayers& band : bands)
    for (const std::size_t count : band.count) out.first.push_back(out.first.back() + count);
  out.layers.resize(out.first.back());
  std::vector<std::size_t> start{0};
  for (const BandLayers& band : bands) start.push_back(start.back() + band.layers.size());
  return parallel::forEach(bands_.count(), [&](int band) {
    const auto b = static_cast<std::size_t>(band);
    std::ranges::copy(bands[b].layers, out.layers.begin() + static_cast<std::ptrdiff_t>(start[b]));
  });
}

shadow::VeilBuffer veilBuffer(const PixelSpace& space, const LayeredBlocks& seen) {
  shadow::VeilBuffer out;
  const auto scale = static_cast<float>(space.scale);
  out.first.assign(1, 0);
  for (int y = 0; y < space.height; ++y) {
    for (int x = 0; x < space.width; ++x) {
      const std::size_t block = seen.index(x / kBlock, y / kBlock);
      const auto pixel = static_cast<std::size_t>(y % kBlock * kBlock + x % kBlock);
      for (std::size_t l = seen.first[block] + 1; l < seen.first[block + 1]; ++l) {
        const Layer& layer = seen.layers[l];
        if (layer.triangle[pixel] == shadow::kNoTriangle) break;
        out.veils.push_back({layer.triangle[pixel], 1.0f / (layer.nearness[pixel] * scale)});
      }
      out.first.push_back(out.veils.size());
    }
  }
  return out;
}

}  // namespace umbrage::raster
