#include "umbrage/raster/tint_sums.hpp"

#include <algorithm>
#include <bit>
#include <optional>

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
///
/// A side before a surface is before those behind it, too. So it adds to the first that it is before alone, and when all sides are through,
/// each surface has the sum of all before it: what costs is the number of sides, hardly that of layers.
struct BlockSurfaces {
  const Layer* veils;
  const float* opaqueNearness;
  const std::uint32_t* opaqueTriangle;
  std::span<const std::uint64_t> receivers;
  const ReceiverDepths::Depths* depths;
  TintField::Sums* sums;
  std::uint32_t* source;
  std::uint32_t first;  ///< the place of the first of `sums` in the field

  [[nodiscard]] std::size_t count() const { return receivers.size(); }
  /// The i-th from the eye: veils, then what is opaque.
  [[nodiscard]] std::size_t fromEye(std::size_t i) const { return i + 1 < count() ? i + 1 : 0; }
  /// From the eye on: the first surface with receivers that the patch may be before, and the end of those among which it lies or that are the first behind
  /// it. Beyond doubt it is behind all receivers of the surfaces before that; before all of those from there on, if any.
  UMBRAGE_IN_BLOCKS Span layersAt(const BlockPatch& p) const {
    const float plane = lanesOf<float>(p.at)[3], doubt = lanesOf<float>(p.doubt)[3];
    const float nearest = plane + lanesOf<float>(p.above)[3] + doubt,
                farthest = plane + lanesOf<float>(p.below)[3] - doubt;
    const int end = static_cast<int>(count());
    int begin = 0;
    while (begin < end && (receivers[fromEye(static_cast<std::size_t>(begin))] == 0 ||
                           nearest < depths[fromEye(static_cast<std::size_t>(begin))].farthest * p.distance))
      ++begin;
    for (int i = begin; i < end; ++i) {
      const std::size_t l = fromEye(static_cast<std::size_t>(i));
      if (receivers[l] == ~std::uint64_t{0} && farthest > depths[l].nearest * (p.distance * (1.0f + 0x1p-20f)))
        return {begin, i + 1};
    }
    return {begin, end};
  }
  [[nodiscard]] const float* nearness(std::size_t l) const {
    return l == 0 ? opaqueNearness : veils[l - 1].nearness.data();
  }
  [[nodiscard]] std::uint32_t triangle(std::size_t l, std::size_t pixel) const {
    return l == 0 ? opaqueTriangle[pixel] : veils[l - 1].triangle[pixel];
  }
  /// The sums of a surface, to add to.
  [[nodiscard]] TintField::Sums& sumsOf(std::size_t l) const {
    if (source[l] == TintField::kWhole) {
      source[l] = first + static_cast<std::uint32_t>(l);
      for (auto& channel : sums[l].channel) channel.fill(0);
    }
    return sums[l];
  }
  /// When all sides are through.
  void sumUp() const {
    std::uint32_t before = TintField::kWhole;
    for (std::size_t i = 0; i < count(); ++i) {
      const std::size_t l = fromEye(i);
      if (source[l] == TintField::kWhole) {
        source[l] = before;
        continue;
      }
      if (before != TintField::kWhole)
        for (std::size_t c = 0; c < kChannels; ++c)
          for (std::size_t k = 0; k < kBlock * kBlock; ++k) sums[l].channel[c][k] += sums[before - first].channel[c][k];
      before = source[l];
    }
  }
};

// Adds where the patch covers a pixel, to the first layer whose surface there it is nearer than for sure. Says whether there are pixels where single
// precision cannot tell for a layer before that.
template <std::size_t kUsed>
UMBRAGE_IN_BLOCKS bool sumInBlock(const BlockPatch& p, const Span& rows, const Span& layers, const Weight& weight,
                                  const BlockSurfaces& block) {
  const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  Float8 f[4];
  for (int k = 0; k < 4; ++k) f[k] = (p.at[k] + p.dy[k] * static_cast<float>(rows.begin)) + p.dx[k] * lane;
  Int8 unsure{};
  const bool few = layers.end - layers.begin <= 2;  // asking costs more than adding nothing
  for (int row = rows.begin; row < rows.end; ++row) {
    Int8 in = f[0] > p.doubt[0], maybeIn = f[0] > -p.doubt[0];
    for (int k = 1; k < 3; ++k) in &= f[k] > p.doubt[k], maybeIn &= f[k] > -p.doubt[k];
    Int8 left = maybeIn;
    for (int i = layers.begin; i < layers.end && (few || anyOf(left)); ++i) {
      const std::size_t l = block.fromEye(static_cast<std::size_t>(i));
      if (block.receivers[l] == 0) continue;
      const Float8 nearness = reinterpret_cast<const Float8&>(block.nearness(l)[row * kBlock]);
      const Float8 before = f[3] - nearness * p.distance;
      const Int8 sure = left & in & (before > p.doubt[3]);
      unsure |= (left & (before > -p.doubt[3])) ^ sure;
      if (!few && !anyOf(sure)) continue;
      left &= ~sure;
      TintField::Sums& sums = block.sumsOf(l);
      for (std::size_t c = 0; c < kUsed; ++c)
        reinterpret_cast<Int8&>(sums.channel[weight.used[c]][static_cast<std::size_t>(row * kBlock)]) +=
            sure & weight.of[weight.used[c]];
    }
    for (int k = 0; k < 4; ++k) f[k] += p.dy[k];
  }
  return anyOf(unsure);
}

/// One thread's work on a band.
class BandSums {
 public:
  BandSums(const TintSums::Request& request, const Corners& corners, const ReceiverDepths& depths,
           const std::vector<ReceiverDepths::Depths>& ofSurface, int band, TintField& out)
      : request_(request),
        corners_(corners),
        depths_(depths),
        ofSurface_(ofSurface),
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
        surfacesAt(column, row).sumUp();
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
            ofSurface_.data() + surface,
            out_.sums.data() + surface,
            out_.source.data() + surface,
            static_cast<std::uint32_t>(surface)};
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
      const Span layers = block.layersAt(here);
      if (layers.begin < layers.end && sumInBlock<kUsed>(here, rows, layers, weight, block))
        sumUnsure(patch, here, rows, layers, weight, block, column + further, row);
    }
  }

  // Where sumInBlock could not tell.
  [[gnu::noinline]] void sumUnsure(const Patch& patch, const BlockPatch& p, const Span& rows, const Span& layers,
                                   const Weight& weight, const BlockSurfaces& block, int column, int row) {
    for (int y = rows.begin; y < rows.end; ++y)
      for (int x = 0; x < kBlock; ++x) {
        bool in = true, maybeIn = true;
        for (int e = 0; e < 3; ++e) {
          const float edge = valueAt(p, rows, e, x, y);
          in = in && edge > p.doubt[e], maybeIn = maybeIn && edge > -p.doubt[e];
        }
        if (maybeIn)
          sumUnsureAt(patch, p, rows, layers, weight, block, {x, y, kBlock * column + x, kBlock * row + y, in});
      }
  }
  struct UnsurePixel {
    int x, y;        ///< of the block
    int px, py;      ///< of the picture
    bool isCovered;  ///< by the patch, for sure
  };
  // Surfaces that nearly coincide may lie in another order than their depths say. So each is asked about, and adds what it has more than that
  // before it.
  void sumUnsureAt(const Patch& patch, const BlockPatch& p, const Span& rows, const Span& layers, const Weight& weight,
                   const BlockSurfaces& block, const UnsurePixel& at) {
    const auto k = static_cast<std::size_t>(at.y * kBlock + at.x);
    std::optional<bool> covered;
    int last = 0;  // whether it is before the layer before
    for (int i = layers.begin; i < layers.end; ++i) {
      const std::size_t l = block.fromEye(static_cast<std::size_t>(i));
      if (block.receivers[l] == 0) continue;
      const float before = valueAt(p, rows, 3, at.x, at.y) - block.nearness(l)[k] * p.distance;
      const bool sure = at.isCovered && before > p.doubt[3], maybe = before > -p.doubt[3];
      if (!sure && (block.receivers[l] >> k & 1u) == 0) continue;
      int here = sure ? 1 : 0;
      if (!sure && maybe) {
        if (!covered) covered = patch.covers(corners_, at.px, at.py);
        here = *covered && isBefore(corners_, patch, request_.triangles[block.triangle(l, k)], at.px, at.py) ? 1 : 0;
      }
      // The first sure one was added to as if there were none before.
      if (const int more = sure ? -last : here - last; more != 0) {
        TintField::Sums& sums = block.sumsOf(l);
        for (std::size_t c = 0; c < weight.usedCount; ++c)
          sums.channel[weight.used[c]][k] += more * weight.of[weight.used[c]];
      }
      if (sure) return;
      last = here;
    }
  }

  const TintSums::Request& request_;
  const Corners& corners_;
  const ReceiverDepths& depths_;
  const std::vector<ReceiverDepths::Depths>& ofSurface_;
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
  if (auto done = depths_.find(request.seen.nearness, request.veils, request.receivers, ofSurface_); !done) return done;
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
  out.source.assign(request.veils.surfaceCount(), TintField::kWhole);
  if (out.sums.size() < request.veils.surfaceCount()) out.sums.resize(request.veils.surfaceCount());
  return parallel::forEach(bands_.count(), [&](int band) {
    BandSums sums(request, corners, depths_, ofSurface_, band, out);
    bands_.forEachIn(band, [&](const Patch& patch, std::uint64_t tiles) {
      addPatchOf(sums, patch, weightOf(request, casters_, patch), tiles);
    });
    sums.finish(atEye_);
  });
}

}  // namespace umbrage::raster
