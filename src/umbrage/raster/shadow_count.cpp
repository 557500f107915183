#include "umbrage/raster/shadow_count.hpp"

#include <algorithm>
#include <bit>

#include "umbrage/raster/side_blocks.hpp"
#include "umbrage/raster/sides.hpp"

namespace umbrage::raster {
namespace {

// Counts the patch where it covers a pixel and is nearer than what is seen there. Leaves alone those pixels where single precision cannot
// tell, and says whether there are any.
UMBRAGE_IN_BLOCKS bool countInBlock(const BlockPatch& p, const Span& rows, std::int32_t weight, const float* nearness,
                                    std::int32_t* counts) {
  const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  Float8 f[4];
  for (int k = 0; k < 4; ++k) f[k] = (p.at[k] + p.dy[k] * static_cast<float>(rows.begin)) + p.dx[k] * lane;
  Int8 unsure{};
  for (int row = rows.begin; row < rows.end; ++row) {
    const Float8 before = f[3] - reinterpret_cast<const Float8&>(nearness[row * kBlock]) * p.distance;
    Int8 sure = before > p.doubt[3], maybe = before > -p.doubt[3];
    for (int k = 0; k < 3; ++k) sure &= f[k] > p.doubt[k], maybe &= f[k] > -p.doubt[k];
    reinterpret_cast<Int8&>(counts[row * kBlock]) += sure & weight;
    unsure |= maybe ^ sure;
    for (int k = 0; k < 4; ++k) f[k] += p.dy[k];
  }
  return anyOf(unsure);
}

// One thread's work on a band.
class BandCounting {
 public:
  BandCounting(const ShadowCount::Request& request, const Corners& corners, const ReceiverDepths& depths, int band)
      : request_(request),
        corners_(corners),
        depths_(depths),
        columns_(request.seen.nearness.columns),
        first_(band * kBandBlocks),
        last_(std::min(first_ + kBandBlocks, request.seen.nearness.rows)),
        whole_(depths.stride() * static_cast<std::size_t>(last_ - first_), 0),
        isCut_(whole_.size(), 0),
        pixels_(whole_.size()) {}

  UMBRAGE_IN_BLOCKS void add(const Patch& patch, std::uint64_t tiles) {
    forEachEight(
        depths_, patch, tiles, first_,
        last_, [&](int column, int row) __attribute__((always_inline)) { addInEight(patch, column, row); });
  }

  void handOut(int atEye, const std::function<void(const ShadowCount::Counted&)>& use) const {
    for (int row = first_; row < last_; ++row)
      for (int column = 0; column < columns_; ++column) {
        const std::size_t here = local(column, row);
        use({index(column, row), atEye + whole_[here], isCut_[here] != 0 ? pixels_[here].pixel.data() : nullptr});
      }
  }

 private:
  [[nodiscard]] std::size_t local(int column, int row) const {
    return static_cast<std::size_t>(row - first_) * depths_.stride() + static_cast<std::size_t>(column);
  }
  [[nodiscard]] std::size_t index(int column, int row) const { return request_.seen.nearness.index(column, row); }

  // The counts of a block whose pixels do not all count alike.
  std::int32_t* cut(std::size_t here) {
    if (isCut_[here] == 0) isCut_[here] = 1, pixels_[here].pixel.fill(0);
    return pixels_[here].pixel.data();
  }

  UMBRAGE_IN_BLOCKS void addInEight(const Patch& patch, int column, int row) {
    BlockPatch p;
    overSquares<kBlock>(patch, column, row, p);
    const Span rows = rowsOf(patch, row);
    const auto k = static_cast<std::size_t>(column);
    const float* nearest = depths_.nearest(row) + k;
    EightBlocks eight = lookAtEight(p, depths_.farthest(row) + k, nearest);
    addWhere(eight.covered, patch.weight, &whole_[local(column, row)]);
    for (int at = 0; eight.touched != 0; eight.touched &= eight.touched - 1) {
      const int further = std::countr_zero(eight.touched);
      if (column + further >= columns_) return;
      moveOn(p, further - at);
      at = further;
      BlockPatch here = p;
      here.doubt[3] += 0x1p-20f * p.distance * nearest[further];
      const std::size_t i = index(column + further, row);
      if (countInBlock(here, rows, patch.weight, request_.seen.nearness.blocks[i].pixel.data(),
                       cut(local(column + further, row))))
        countUnsure(patch, here, rows, column + further, row);
    }
  }

  // The pixels that countInBlock left alone.
  [[gnu::noinline]] void countUnsure(const Patch& patch, const BlockPatch& p, const Span& rows, int column, int row) {
    const std::size_t i = index(column, row);
    for (std::uint64_t left = request_.receivers[i]; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left), x = bit % kBlock, y = bit / kBlock;
      if (y < rows.begin || y >= rows.end) continue;
      const auto k = static_cast<std::size_t>(bit);
      const float before = valueAt(p, rows, 3, x, y) - request_.seen.nearness.blocks[i].pixel[k] * p.distance;
      bool sure = before > p.doubt[3], maybe = before > -p.doubt[3];
      for (int e = 0; e < 3; ++e) {
        const float edge = valueAt(p, rows, e, x, y);
        sure = sure && edge > p.doubt[e], maybe = maybe && edge > -p.doubt[e];
      }
      const int px = kBlock * column + x, py = kBlock * row + y;
      if (maybe && !sure && patch.covers(corners_, px, py) &&
          isBefore(corners_, patch, request_.triangles[request_.seen.triangle.blocks[i].pixel[k]], px, py))
        pixels_[local(column, row)].pixel[k] += patch.weight;
    }
  }

  const ShadowCount::Request& request_;
  const Corners& corners_;
  const ReceiverDepths& depths_;
  int columns_, first_, last_;
  std::vector<std::int32_t> whole_;
  std::vector<std::uint8_t> isCut_;  ///< per block: pixels_ counts, too
  image::UnsetVector<BlockImage<std::int32_t>::Block> pixels_;
};

UMBRAGE_VECTOR_UNITS void addPatch(BandCounting& band, const Patch& patch, std::uint64_t tiles) {
  band.add(patch, tiles);
}

}  // namespace

Result<void> ShadowCount::plan(const Request& request) {
  const PixelSpace& space = request.space;
  const shadow::Silhouette& silhouette = request.silhouette;
  const Corners corners{request.positions.mapped, space.map(silhouette.light)};
  request_.emplace(request);
  if (auto done = depths_.find(request.seen, request.receivers); !done) return done;
  const SideMaker makeSide(space, corners, *casters_, silhouette.light, request.room);
  const std::size_t sides = silhouette.edges.size();
  return bands_.fill(
      sides + request.invisible.size(), space.height,
      [&](std::size_t i, Patch& patch) {
        if (i < sides) return makeSide.side(silhouette.edges[i], patch);
        const std::uint32_t t = request.invisible[i - sides];
        return makeSide.cap(t, silhouette.side[t], patch);
      },
      [&](const Patch& patch, int row) { return depths_.tilesBehind(patch, row); });
}

Result<void> ShadowCount::count(const std::function<void(const Counted&)>& use) {
  UMBRAGE_CHECK(request_.has_value(), "plan() first");
  const Request& request = *request_;
  const Corners corners{request.positions.mapped, request.space.map(request.silhouette.light)};
  eyeCount_ = countAtEye(*casters_, request.silhouette, request.space, corners);
  return parallel::forEach(bands_.count(), [&](int band) {
    BandCounting counting(request, corners, depths_, band);
    bands_.forEachIn(band, [&](const Patch& patch, std::uint64_t tiles) { addPatch(counting, patch, tiles); });
    counting.handOut(eyeCount_, use);
  });
}

}  // namespace umbrage::raster
