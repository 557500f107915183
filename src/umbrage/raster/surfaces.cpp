#include "umbrage/raster/surfaces.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/averted_faces.hpp"
#include "umbrage/shadow/tinted_silhouette.hpp"

namespace umbrage::raster {
namespace {

// Marks pixels whose edges single precision cannot tell, a bit each; draws all others. False when nothing was drawn.
UMBRAGE_IN_BLOCKS bool drawBlock(const BlockPatch& t, const Span& rows, std::uint32_t id, float* nearness,
                                 std::uint32_t* triangle, std::uint64_t& unsure) {
  const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  Float8 edge[3];
  for (int k = 0; k < 3; ++k) edge[k] = (t.at[k] + t.dy[k] * static_cast<float>(rows.begin)) + t.dx[k] * lane;
  const Float8 near = t.at[3] + t.dx[3] * lane;
  Int8 drawn{}, asked{}, askedIn[kBlock];
  for (int row = rows.begin; row < rows.end; ++row) {
    const Float8 here = near + t.dy[3] * static_cast<float>(row);
    Float8& stored = reinterpret_cast<Float8&>(nearness[row * kBlock]);
    Int8& ids = reinterpret_cast<Int8&>(triangle[row * kBlock]);
    Int8 inside = here > stored, maybe = inside;
    for (int k = 0; k < 3; ++k) inside &= edge[k] > t.doubt[k], maybe &= edge[k] > -t.doubt[k];
    stored = inside ? here : stored;
    ids = inside ? Int8{} + static_cast<std::int32_t>(id) : ids;
    drawn |= inside;
    askedIn[row] = maybe ^ inside;
    asked |= askedIn[row];
    for (int k = 0; k < 3; ++k) edge[k] += t.dy[k];
  }
  if (anyOf(asked))
    for (int row = rows.begin; row < rows.end; ++row) unsure |= std::uint64_t{bitsOf(askedIn[row])} << (row * kBlock);
  return anyOf(drawn);
}

// A block that lies wholly within the patch. False when nothing was drawn.
UMBRAGE_IN_BLOCKS bool drawWhole(const BlockPatch& t, std::uint32_t id, float* nearness, std::uint32_t* triangle) {
  const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  const Float8 near = t.at[3] + t.dx[3] * lane;
  const Int8 own = Int8{} + static_cast<std::int32_t>(id);
  Int8 drawn{};
  for (int row = 0; row < kBlock; ++row) {
    const Float8 here = near + t.dy[3] * static_cast<float>(row);
    Float8& stored = reinterpret_cast<Float8&>(nearness[row * kBlock]);
    Int8& ids = reinterpret_cast<Int8&>(triangle[row * kBlock]);
    const Int8 inside = here > stored;
    stored = inside ? here : stored;
    ids = inside ? own : ids;
    drawn |= inside;
  }
  return anyOf(drawn);
}

// The same before everything else.
UMBRAGE_IN_BLOCKS void drawFirst(const BlockPatch& t, std::uint32_t id, float* nearness, std::uint32_t* triangle) {
  const Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  const Float8 near = t.at[3] + t.dx[3] * lane;
  for (int row = 0; row < kBlock; ++row) {
    reinterpret_cast<Float8&>(nearness[row * kBlock]) = near + t.dy[3] * static_cast<float>(row);
    reinterpret_cast<Int8&>(triangle[row * kBlock]) = Int8{} + static_cast<std::int32_t>(id);
  }
}

UMBRAGE_IN_BLOCKS float farthestOf(const float* nearness) {
  Float8 least = reinterpret_cast<const Float8&>(nearness[0]);
  for (int row = 1; row < kBlock; ++row) {
    const Float8 v = reinterpret_cast<const Float8&>(nearness[row * kBlock]);
    least = v < least ? v : least;
  }
  const auto lanes = lanesOf<float>(least);
  return *std::min_element(lanes.begin(), lanes.end());
}

// Whether all pixels of a block show one triangle, or none.
UMBRAGE_IN_BLOCKS bool isOne(const std::uint32_t* triangle) {
  const Int8 first = Int8{} + static_cast<std::int32_t>(triangle[0]);
  Int8 others{};
  for (int row = 0; row < kBlock; ++row) others |= reinterpret_cast<const Int8&>(triangle[row * kBlock]) ^ first;
  return !anyOf(others);
}

UMBRAGE_VECTOR_UNITS void summarise(const float* nearness, const std::uint32_t* triangle, BlockSummary& out) {
  const bool one = isOne(triangle);
  out.triangle = one ? triangle[0] : BlockSummary::kSeveral;
  out.covered = one && triangle[0] != shadow::kNoTriangle ? ~std::uint64_t{0} : 0;
  if (!one)
    for (std::size_t k = 0; k < kBlock * kBlock; ++k)
      out.covered |= std::uint64_t{triangle[k] != shadow::kNoTriangle} << k;
  const Float8 none = Float8{} + std::numeric_limits<float>::infinity();
  Float8 low = none, high{};
  for (int row = 0; row < kBlock; ++row) {
    const Float8 v = reinterpret_cast<const Float8&>(nearness[row * kBlock]);
    const Float8 shown = v > Float8{} ? v : none;
    low = shown < low ? shown : low, high = v > high ? v : high;
  }
  const auto lows = lanesOf<float>(low), highs = lanesOf<float>(high);
  out.farthest = *std::min_element(lows.begin(), lows.end());
  out.nearest = *std::max_element(highs.begin(), highs.end());
  if (out.covered == 0) out.farthest = 0.0f;
}

// One thread's work on a band.
struct BandDrawing {
  const Corners& corners;
  SeenBlocks& out;
  int first, last;                    // rows of blocks
  std::vector<float> farthest;        // per block: nearness of the farthest pixel
  std::vector<std::uint8_t> isBegun;  // per block: its pixels mean something

  BandDrawing(const Corners& c, SeenBlocks& o, int band)
      : corners(c), out(o), first(band * kBandBlocks), last(std::min(first + kBandBlocks, o.nearness.rows)) {
    farthest.assign(static_cast<std::size_t>((last - first) * out.nearness.columns), 0.0f);
    isBegun.assign(farthest.size(), 0);
  }

  void begin(std::size_t block, std::size_t local) {
    if (isBegun[local] != 0) return;
    isBegun[local] = 1;
    out.nearness.blocks[block].pixel.fill(0.0f);
    out.triangle.blocks[block].pixel.fill(shadow::kNoTriangle);
  }

  void finish() {
    const std::size_t start = out.nearness.index(0, first);
    for (std::size_t local = 0; local < isBegun.size(); ++local) {
      const std::size_t i = start + local;
      begin(i, local);
      summarise(out.nearness.blocks[i].pixel.data(), out.triangle.blocks[i].pixel.data(), out.summary[i]);
    }
  }

  // Those pixels that single precision left undecided. True when one was drawn.
  bool drawUnsure(const Patch& patch, const BlockPatch& t, std::uint64_t unsure, int column, int row) {
    const std::size_t block = out.nearness.index(column, row);
    bool drawn = false;
    for (; unsure != 0; unsure &= unsure - 1) {
      const int bit = std::countr_zero(unsure), x = bit % kBlock, y = bit / kBlock;
      if (!patch.covers(corners, kBlock * column + x, kBlock * row + y)) continue;
      const float here = t.at[3] + t.dx[3] * static_cast<float>(x) + t.dy[3] * static_cast<float>(y);
      float& nearness = out.nearness.blocks[block].pixel[static_cast<std::size_t>(bit)];
      if (!(here > nearness)) continue;
      nearness = here, drawn = true;
      out.triangle.blocks[block].pixel[static_cast<std::size_t>(bit)] = patch.id;
    }
    return drawn;
  }
};

UMBRAGE_VECTOR_UNITS void draw(BandDrawing& band, const Patch& patch) {
  const int begin = std::max(band.first, patch.y0 / kBlock),
            end = std::min(band.last, (patch.y1 + kBlock - 1) / kBlock);
  for (int row = begin; row < end; ++row) {
    // Over few columns asking each block by itself costs less than asking which ones.
    const Span extent{patch.x0 / kBlock, (patch.x1 + kBlock - 1) / kBlock};
    const Span columns = extent.end - extent.begin <= 3 ? extent : columnsOf(patch, row, row + 1, 0.0);
    if (columns.begin >= columns.end) continue;
    BlockPatch t;
    overSquares<kBlock>(patch, columns.begin, row, t);
    const Span rows = rowsOf(patch, row);
    for (int column = columns.begin; column < columns.end; ++column) {
      const int further = column - columns.begin;
      if (further % kTileBlocks != 0)
        moveOn(t, 1);
      else if (further > 0)
        overSquares<kBlock>(patch, column, row, t);  // its doubt holds over eight
      const auto local = static_cast<std::size_t>((row - band.first) * band.out.nearness.columns + column);
      float& farthest = band.farthest[local];
      const auto most = lanesOf<float>(t.at + t.above + t.doubt);
      if (most[3] <= farthest || most[0] < 0.0f || most[1] < 0.0f || most[2] < 0.0f) continue;
      const std::size_t block = band.out.nearness.index(column, row);
      float* nearness = band.out.nearness.blocks[block].pixel.data();
      std::uint32_t* triangle = band.out.triangle.blocks[block].pixel.data();
      const auto least = lanesOf<float>(t.at + t.below - t.doubt);
      const bool whole = least[0] > 0.0f && least[1] > 0.0f && least[2] > 0.0f && rows.begin == 0 && rows.end == kBlock;
      if (whole && band.isBegun[local] == 0 && least[3] > 0.0f) {
        drawFirst(t, patch.id, nearness, triangle);
        band.isBegun[local] = 1;
        farthest = farthestOf(nearness);
        continue;
      }
      band.begin(block, local);
      std::uint64_t unsure = 0;
      bool drawn =
          whole ? drawWhole(t, patch.id, nearness, triangle) : drawBlock(t, rows, patch.id, nearness, triangle, unsure);
      if (unsure != 0 && band.drawUnsure(patch, t, unsure, column, row)) drawn = true;
      if (drawn) farthest = farthestOf(nearness);
    }
  }
}

// Whether a triangle meets the plane through the eye across the view, or nearly.
bool isAroundEye(std::span<const Vec3> mapped, const mesh::Triangle& corner) {
  constexpr double kNearly = 0x1p-40;
  const double a = mapped[corner[0]].z, b = mapped[corner[1]].z, c = mapped[corner[2]].z;
  const double low = std::min({a, b, c}), high = std::max({a, b, c}), nearly = kNearly * std::max(-low, high);
  return low <= nearly && high >= -nearly;
}

}  // namespace

Shown makeSurfacePatch(const PixelSpace& space, const SeenPositions& positions, const scene::Surfaces& surfaces,
                       std::uint32_t triangle, Patch& out) {
  const mesh::Triangle& corner = surfaces.triangles[triangle];
  const auto isInPlane = [&] {
    return liesInPlane(surfaces.corner(triangle, 0), surfaces.corner(triangle, 1), surfaces.corner(triangle, 2),
                       space.eye);
  };
  // The eye may lie in the very triangle, which then has no picture to be bounded, but is crossed on every way from the eye.
  if (isAroundEye(positions.mapped, corner) && isInPlane()) return Shown::edgeOn;
  if ((positions.outside[corner[0]] & positions.outside[corner[1]] & positions.outside[corner[2]]) != 0)
    return Shown::no;
  const Corners corners{positions.mapped, {}};
  const std::array<Vec3, 3> points{positions.mapped[corner[0]], positions.mapped[corner[1]],
                                   positions.mapped[corner[2]]};
  bound(space, points, out);
  if (out.x0 >= out.x1 || out.y0 >= out.y1) return Shown::no;
  out.id = triangle;
  if (!makePatch(space, corners, {corner[0], corner[1], corner[2]}, false, out)) return Shown::no;
  if (isInPlane()) return Shown::edgeOn;
  if (!(out.distance > 0.0)) return Shown::no;
  out.x[3] /= out.distance, out.y[3] /= out.distance, out.c[3] /= out.distance;
  out.distance = 1.0;
  return Shown::yes;
}

SurfaceRaster::SurfaceRaster(const shadow::Geometry& geometry, Drawn drawn) : geometry_(&geometry), drawn_(drawn) {
  use(geometry);
}

void SurfaceRaster::use(const shadow::Geometry& geometry) {
  geometry_ = &geometry;
  if (drawn_ == Drawn::opaque) veiled_ = shadow::veiledComponents(geometry.casters, geometry.filters);
}

// Averted faces of a convex solid hide behind its others; behind a veil they are seen.
void SurfaceRaster::findAverted(const Vec3& eye) {
  averted_ = shadow::avertedFaces(*geometry_, eye);
  if (drawn_ == Drawn::all || geometry_->filters.empty()) return;
  const shadow::CasterSet& casters = geometry_->casters;
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    if (veiled_[casters.componentOf[t]] != 0) averted_[casters.surfaceTriangle[t]] = 0;
  for (std::uint32_t t = 0; t < averted_.size(); ++t)
    if (geometry_->filters.isVeil(t)) averted_[t] = 1;  // not drawn here
}

bool SurfaceRaster::make(const PixelSpace& space, const SeenPositions& positions, std::uint32_t triangle, Patch& out) {
  if (averted_[triangle] != 0) return false;
  const Shown shown = makeSurfacePatch(space, positions, geometry_->surfaces, triangle, out);
  if (shown == Shown::edgeOn) {
    const std::lock_guard lock(edgeOnMutex_);
    edgeOn_.push_back(triangle);
  }
  return shown == Shown::yes;
}

Result<void> SurfaceRaster::draw(const PixelSpace& space, const SeenPositions& positions, SeenBlocks& out) {
  const scene::Surfaces& surfaces = geometry_->surfaces;
  findAverted(space.eye);
  out.nearness.resize(space.width, space.height);
  out.triangle.resize(space.width, space.height);
  out.summary.resize(out.triangle.blocks.size());
  edgeOn_.clear();
  if (auto done = bands_.fill(
          surfaces.triangles.size(), space.height,
          [&](std::size_t i, Patch& patch) { return make(space, positions, static_cast<std::uint32_t>(i), patch); },
          [](const Patch&, int) { return ~std::uint64_t{0}; });
      !done)
    return done;
  std::sort(edgeOn_.begin(), edgeOn_.end());
  const Corners corners{positions.mapped, {}};
  return parallel::forEach(bands_.count(), [&](int band) {
    BandDrawing drawing(corners, out, band);
    bands_.forEachIn(band, [&](const Patch& patch, std::uint64_t) { raster::draw(drawing, patch); });
    drawing.finish();
  });
}

Result<shadow::SurfaceBuffer> surfaceBuffer(const PixelSpace& space, const SeenBlocks& seen) {
  shadow::SurfaceBuffer out{image::Image<std::uint32_t>::unset(space.width, space.height),
                            image::Image<float>::unset(space.width, space.height)};
  const auto scale = static_cast<float>(space.scale);
  auto done = parallel::forEach((space.height + kBand - 1) / kBand, [&](int band) {
    forEachRowPiece(seen.triangle.columns, space.width, space.height, band,
                    [&](std::size_t block, std::size_t first, int x, int y, int count) {
                      const float* nearness = seen.nearness.blocks[block].pixel.data() + first;
                      std::copy_n(seen.triangle.blocks[block].pixel.data() + first, count, out.triangle.row(y) + x);
                      float* depth = out.depth.row(y) + x;
                      for (int k = 0; k < count; ++k) depth[k] = 1.0f / (nearness[k] * scale);
                    });
  });
  if (!done) return tl::unexpected(done.error());
  return out;
}

}  // namespace umbrage::raster
