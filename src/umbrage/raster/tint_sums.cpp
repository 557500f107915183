#include "umbrage/raster/tint_sums.hpp"

#include <algorithm>
#include <bit>

#include "umbrage/raster/side_blocks.hpp"
#include "umbrage/raster/sides.hpp"

namespace umbrage::raster {
namespace {

constexpr std::size_t kChannels = TintField::kChannels;

/// What a patch adds to each channel, and the channels to which it adds anything.
struct Weight {
  std::array<std::int32_t, kChannels> of{};
  std::array<std::uint8_t, kChannels> used{};
  std::size_t usedCount = 0;

  Weight(int sign, std::int32_t opaque, const shadow::FilterSum& filter)
      : of{sign * opaque, sign * filter[0], sign * filter[1], sign * filter[2]} {
    for (std::size_t c = 0; c < kChannels; ++c)
      if (of[c] != 0) used[usedCount++] = static_cast<std::uint8_t>(c);
  }
};

Weight weightOf(const TintSums::Request& request, const shadow::CasterSet& casters, const Patch& patch) {
  const auto& edges = request.silhouette.edges;
  if (patch.id < edges.size()) return {patch.weight, edges[patch.id].opaque, edges[patch.id].filter};
  const std::uint32_t surface = casters.surfaceTriangle[request.invisible[patch.id - edges.size()]];
  return {patch.weight, request.filters.isVeil(surface) ? 0 : 1, request.filters.of(surface)};
}

/// The surfaces of a block, the opaque one first.
struct BlockSurfaces {
  const Layer* veils;
  const float* opaqueNearness;
  const std::uint32_t* opaqueTriangle;
  std::span<const std::uint64_t> receivers;
  TintField::Sums* sums;
  std::uint8_t* parted;

  [[nodiscard]] std::size_t count() const { return receivers.size(); }
  [[nodiscard]] const float* nearness(std::size_t l) const {
    return l == 0 ? opaqueNearness : veils[l - 1].nearness.data();
  }
  [[nodiscard]] std::uint32_t triangle(std::size_t l, std::size_t pixel) const {
    return l == 0 ? opaqueTriangle[pixel] : veils[l - 1].triangle[pixel];
  }
  /// Before something is added to pixels of those that are asked for.
  void part() const {
    for (std::size_t l = 0; l < count(); ++l) {
      if (receivers[l] == 0 || parted[l] != 0) continue;
      parted[l] = 1;
      for (auto& channel : sums[l].channel) channel.fill(0);
    }
  }
};

// Adds where the patch covers a pixel and is nearer than a layer's surface there. Leaves alone those pixels where single precision cannot tell,
// and says whether there are any.
template <std::size_t kUsed>
UMBRAGE_IN_BLOCKS bool sumInBlock(const BlockPatch& p, const Span& rows, const Weight& weight,
                                  const BlockSurfaces& block) {
  const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  Float8 f[4];
  for (int k = 0; k < 4; ++k) f[k] = (p.at[k] + p.dy[k] * static_cast<float>(rows.begin)) + p.dx[k] * lane;
  Int8 unsure{};
  for (int row = rows.begin; row < rows.end; ++row) {
    Int8 in = f[0] > p.doubt[0], maybeIn = f[0] > -p.doubt[0];
    for (int k = 1; k < 3; ++k) in &= f[k] > p.doubt[k], maybeIn &= f[k] > -p.doubt[k];
    for (std::size_t l = 0; l < block.count(); ++l) {
      if (block.receivers[l] == 0) continue;
      const Float8 nearness = reinterpret_cast<const Float8&>(block.nearness(l)[row * kBlock]);
      const Float8 before = f[3] - nearness * p.distance;
      const Int8 sure = in & (before > p.doubt[3]);
      unsure |= (maybeIn & (before > -p.doubt[3])) ^ sure;
      for (std::size_t c = 0; c < kUsed; ++c)
        reinterpret_cast<Int8&>(block.sums[l].channel[weight.used[c]][static_cast<std::size_t>(row * kBlock)]) +=
            sure & weight.of[weight.used[c]];
    }
    for (int k = 0; k < 4; ++k) f[k] += p.dy[k];
  }
  return anyOf(unsure);
}

/// One thread's work on a band.
class BandSums {
 public:
  BandSums(const TintSums::Request& request, const Corners& corners, const ReceiverDepths& depths, int band,
           TintField& out)
      : request_(request),
        corners_(corners),
        depths_(depths),
        out_(out),
        first_(band * kBandBlocks),
        last_(std::min(first_ + kBandBlocks, request.veils.rows)) {
    for (auto& whole : whole_) whole.assign(depths.stride() * static_cast<std::size_t>(last_ - first_), 0);
  }

  template <std::size_t kUsed>
  UMBRAGE_IN_BLOCKS void add(const Patch& patch, const Weight& weight, std::uint64_t tiles) {
    forEachEight(
        depths_, patch, tiles, first_, last_, [&](int column, int row) __attribute__((always_inline)) {
          addInEight<kUsed>(patch, weight, column, row);
        });
  }

  // Tells what was summed up for whole blocks, and what is there at the eye.
  void finish(const TintSum& atEye) {
    for (int row = first_; row < last_; ++row)
      for (int column = 0; column < request_.veils.columns; ++column) {
        TintSum& whole = out_.whole[request_.veils.index(column, row)] = atEye;
        const std::size_t at = local(column, row);
        whole.opaque += whole_[0][at];
        for (std::size_t k = 0; k < 3; ++k) whole.filter[k] += whole_[k + 1][at];
      }
  }

 private:
  [[nodiscard]] std::size_t local(int column, int row) const {
    return static_cast<std::size_t>(row - first_) * depths_.stride() + static_cast<std::size_t>(column);
  }
  [[nodiscard]] BlockSurfaces surfacesAt(int column, int row) const {
    const VeilLayers& veils = request_.veils;
    const std::size_t block = veils.index(column, row), surface = veils.surface(block);
    return {veils.layers.data() + veils.first[block],
            request_.seen.nearness.blocks[block].pixel.data(),
            request_.seen.triangle.blocks[block].pixel.data(),
            request_.receivers.subspan(surface, 1 + veils.count(block)),
            out_.sums.data() + surface,
            out_.parted.data() + surface};
  }

  template <std::size_t kUsed>
  UMBRAGE_IN_BLOCKS void addInEight(const Patch& patch, const Weight& weight, int column, int row) {
    BlockPatch p;
    overSquares<kBlock>(patch, column, row, p);
    const Span rows = rowsOf(patch, row);
    const auto k = static_cast<std::size_t>(column);
    const float* nearest = depths_.nearest(row) + k;
    EightBlocks eight = lookAtEight(p, depths_.farthest(row) + k, nearest);
    for (std::size_t c = 0; c < kUsed; ++c)
      addWhere(eight.covered, weight.of[weight.used[c]], &whole_[weight.used[c]][local(column, row)]);
    for (int at = 0; eight.touched != 0; eight.touched &= eight.touched - 1) {
      const int further = std::countr_zero(eight.touched);
      if (column + further >= request_.veils.columns) return;
      moveOn(p, further - at);
      at = further;
      BlockPatch here = p;
      here.doubt[3] += 0x1p-20f * p.distance * nearest[further];
      const BlockSurfaces block = surfacesAt(column + further, row);
      block.part();
      if (sumInBlock<kUsed>(here, rows, weight, block))
        sumUnsure(patch, here, rows, weight, block, column + further, row);
    }
  }

  // The pixels that sumInBlock left alone.
  [[gnu::noinline]] void sumUnsure(const Patch& patch, const BlockPatch& p, const Span& rows, const Weight& weight,
                                   const BlockSurfaces& block, int column, int row) {
    for (std::size_t l = 0; l < block.count(); ++l) {
      for (std::uint64_t left = block.receivers[l]; left != 0; left &= left - 1) {
        const int bit = std::countr_zero(left), x = bit % kBlock, y = bit / kBlock;
        if (y < rows.begin || y >= rows.end) continue;
        const auto k = static_cast<std::size_t>(bit);
        const float before = valueAt(p, rows, 3, x, y) - block.nearness(l)[k] * p.distance;
        bool sure = before > p.doubt[3], maybe = before > -p.doubt[3];
        for (int e = 0; e < 3; ++e) {
          const float edge = valueAt(p, rows, e, x, y);
          sure = sure && edge > p.doubt[e], maybe = maybe && edge > -p.doubt[e];
        }
        const int px = kBlock * column + x, py = kBlock * row + y;
        if (!maybe || sure || !patch.covers(corners_, px, py) ||
            !isBefore(corners_, patch, request_.triangles[block.triangle(l, k)], px, py))
          continue;
        for (std::size_t c = 0; c < weight.usedCount; ++c)
          block.sums[l].channel[weight.used[c]][k] += weight.of[weight.used[c]];
      }
    }
  }

  const TintSums::Request& request_;
  const Corners& corners_;
  const ReceiverDepths& depths_;
  TintField& out_;
  int first_, last_;
  std::array<std::vector<std::int32_t>, kChannels> whole_;
};

template <std::size_t kUsed>
UMBRAGE_VECTOR_UNITS void addPatch(BandSums& band, const Patch& patch, const Weight& weight, std::uint64_t tiles) {
  band.add<kUsed>(patch, weight, tiles);
}

// What is opaque uses one channel, glass mostly three.
void addPatchOf(BandSums& band, const Patch& patch, const Weight& weight, std::uint64_t tiles) {
  switch (weight.usedCount) {
    case 1: return addPatch<1>(band, patch, weight, tiles);
    case 2: return addPatch<2>(band, patch, weight, tiles);
    case 3: return addPatch<3>(band, patch, weight, tiles);
    case 4: return addPatch<4>(band, patch, weight, tiles);
    default: return;
  }
}

}  // namespace

Result<void> TintSums::find(const Request& request, TintField& out) {
  const PixelSpace& space = request.space;
  const shadow::TintedSilhouette& silhouette = request.silhouette;
  const Corners corners{request.positions.mapped, space.map(silhouette.light)};
  if (auto done = depths_.find(request.seen.nearness, request.veils, request.receivers); !done) return done;
  const SideMaker makeSide(space, corners, casters_, silhouette.light, request.room);
  const std::size_t sides = silhouette.edges.size();
  const auto make = [&](std::size_t i, Patch& patch) {
    patch.id = static_cast<std::uint32_t>(i);
    if (i >= sides)
      return makeSide.cap(request.invisible[i - sides], silhouette.side[request.invisible[i - sides]], patch);
    return makeSide.side({silhouette.edges[i].a, silhouette.edges[i].b, 1, 0}, patch);
  };
  const auto touches = [&](const Patch& patch, int row) { return depths_.tilesBehind(patch, row); };
  if (auto done = bands_.fill(sides + request.invisible.size(), space.height, make, touches); !done) return done;
  atEye_ = {};
  visitAtEye(casters_, silhouette.side, silhouette.light, space, corners, [&](std::uint32_t triangle, int sign) {
    const std::uint32_t surface = casters_.surfaceTriangle[triangle];
    if (!request.filters.isVeil(surface)) atEye_.opaque += sign;
    for (std::size_t k = 0; k < 3; ++k) atEye_.filter[k] += sign * request.filters.of(surface)[k];
  });
  out.whole.resize(request.veils.first.size() - 1);
  out.parted.assign(request.veils.surfaceCount(), 0);
  if (out.sums.size() < request.veils.surfaceCount()) out.sums.resize(request.veils.surfaceCount());
  return parallel::forEach(bands_.count(), [&](int band) {
    BandSums sums(request, corners, depths_, band, out);
    bands_.forEachIn(band, [&](const Patch& patch, std::uint64_t tiles) {
      addPatchOf(sums, patch, weightOf(request, casters_, patch), tiles);
    });
    sums.finish(atEye_);
  });
}

}  // namespace umbrage::raster
