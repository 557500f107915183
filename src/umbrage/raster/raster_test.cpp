#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "support/shapes.hpp"
#include "umbrage/raster/shadow_count.hpp"
#include "umbrage/raster/sides.hpp"

namespace umbrage::raster {
namespace {

// A pinhole at the origin whose pixels are whole units of the plane w = 1, so that lattice points fall on centres of pixels.
PixelSpace latticeSpace(int width, int height) {
  PixelSpace space;
  space.width = width, space.height = height;
  return space;
}

// A grid over the picture and beyond it, with corners on centres of pixels, at random depths and with random diagonals.
struct Tiling {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
Tiling makeTiling(shapes::Random& random, int cells, int step) {
  Tiling t;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double w = random.whole(1, 9);
      t.points.push_back(w * Vec3(step * (i - 1) + 0.5, step * (j - 1) + 0.5, 1.0));
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const bool rising = random.whole(0, 1) == 1;
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      t.triangles.push_back(rising ? std::array{a, b, d} : std::array{a, b, c});
      t.triangles.push_back(rising ? std::array{b, c, d} : std::array{a, c, d});
    }
  return t;
}

TEST(Patch, CoversEveryPixelOfATilingOnceThoughItsCornersLieOnCentresOfPixels) {
  shapes::Random random(7);
  for (int round = 0; round < 20; ++round) {
    const int step = random.whole(1, 5), cells = 6, size = step * (cells - 2);
    const Tiling tiling = makeTiling(random, cells, step);
    const PixelSpace space = latticeSpace(size, size);
    const Corners corners{tiling.points, {}};
    image::Image<int> covered(size, size, 0);
    for (const auto& triangle : tiling.triangles) {
      Patch patch;
      ASSERT_TRUE(makePatch(space, corners, triangle, false, patch));
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) covered(x, y) += patch.covers(corners, x, y);
    }
    for (const int count : covered.pixels()) ASSERT_EQ(count, 1);
  }
}

TEST(Patch, InLineWithItsCornersIsNone) {
  const std::vector<Vec3> points{{0, 0, 1}, {1, 2, 3}, {2, 4, 5}, {0, 0, 1}};
  const Corners corners{points, {}};
  Patch patch;
  EXPECT_FALSE(makePatch(latticeSpace(8, 8), corners, {0, 1, 2}, false, patch));
  EXPECT_FALSE(makePatch(latticeSpace(8, 8), corners, {0, 3, 1}, false, patch));
}

TEST(Patch, ExtentIsThePictureWhenACornerLiesBehindTheEye) {
  Patch patch;
  const std::vector<Vec3> points{{1, 1, 1}, {2, 2, 1}, {1, 2, -1}};
  bound(latticeSpace(20, 10), points, patch);
  EXPECT_EQ((std::array{patch.x0, patch.y0, patch.x1, patch.y1}), (std::array{0, 0, 20, 10}));
  bound(latticeSpace(20, 10), std::span(points).first(2), patch);
  EXPECT_EQ((std::array{patch.x0, patch.y0, patch.x1, patch.y1}), (std::array{1, 1, 2, 2}));
}

// A scene seen and ready to be counted.
struct Stage {
  std::shared_ptr<const shadow::Geometry> geometry;
  PixelSpace space;
  SeenPositions positions;
  SeenBlocks seen;
  std::vector<std::uint64_t> receivers;
  std::vector<std::uint32_t> invisible;

  Stage(const scene::Scene& scene, const scene::Camera& camera) : geometry(shadow::makeGeometry(scene)) {
    const scene::Surfaces& surfaces = geometry->surfaces;
    space = pixelSpace(camera, surfaces.origin, surfaces.bounds.radius());
    EXPECT_TRUE(mapPositions(space, surfaces.positions, positions));
    SurfaceRaster raster(*geometry);
    EXPECT_TRUE(raster.draw(space, positions, seen));
    const shadow::CasterSet& casters = geometry->casters;
    for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
      if (std::ranges::binary_search(raster.edgeOn(), casters.surfaceTriangle[t])) invisible.push_back(t);
    for (const auto& block : seen.triangle.blocks) {
      std::uint64_t bits = 0;
      for (std::size_t k = 0; k < 64; ++k) bits |= std::uint64_t{block.pixel[k] != shadow::kNoTriangle} << k;
      receivers.push_back(bits);
    }
  }

  [[nodiscard]] ShadowCount::Request request(const shadow::Silhouette& silhouette) const {
    Box3 room = geometry->surfaces.bounds;
    room.add(space.eye);
    return {space, positions, seen, geometry->surfaces.triangles, receivers, room, invisible, silhouette};
  }
};

// The same by looking at every side at every pixel.
struct ByPixel {
  const Stage& stage;
  const shadow::Silhouette& silhouette;
  std::vector<Patch> patches;
  Corners corners;
  int atEye;

  ByPixel(const Stage& s, const shadow::Silhouette& l)
      : stage(s), silhouette(l), corners{s.positions.mapped, s.space.map(l.light)} {
    const shadow::CasterSet& casters = stage.geometry->casters;
    atEye = countAtEye(casters, silhouette, stage.space, corners);
    for (const shadow::SilhouetteEdge& edge : silhouette.edges) {
      Patch patch;
      if (!makePatch(stage.space, corners, {edge.a, edge.b, corners.lightIndex()}, true, patch)) continue;
      patch.weight = -patch.side * edge.multiplicity;
      patches.push_back(patch);
    }
    const SideMaker maker(stage.space, corners, casters, silhouette.light, {});
    for (const std::uint32_t t : stage.invisible) {
      Patch patch;
      if (maker.cap(t, silhouette.side[t], patch)) patches.push_back(patch);
    }
  }

  // Nothing where the answer hangs on the rounding of a depth.
  [[nodiscard]] std::optional<int> at(int x, int y) const {
    const mesh::Triangle& seen = stage.geometry->surfaces.triangles[stage.seen.triangle.at(x, y)];
    const Vec3 a = stage.positions.mapped[seen[0]], pixel(x + 0.5, y + 0.5, 1.0);
    const Vec3 normal = glm::cross(stage.positions.mapped[seen[1]] - a, stage.positions.mapped[seen[2]] - a);
    const double nearness = glm::dot(normal, pixel) / glm::dot(normal, a);
    int count = atEye;
    for (const Patch& p : patches) {
      if (!p.covers(corners, x, y)) continue;
      const double before = p.at(3, pixel.x, pixel.y) - nearness * p.distance;
      if (std::abs(before) <= 1e-12 * nearness * p.distance) return {};
      if (before > 0.0) count += p.weight;
    }
    return count;
  }
};

Result<void> countAll(ShadowCount& count, const Stage& stage, BlockImage<std::int32_t>& out) {
  out.resize(stage.space.width, stage.space.height);
  return count.count([&](const ShadowCount::Counted& counted) {
    for (std::size_t k = 0; k < 64; ++k) out.blocks[counted.block].pixel[k] = counted.at(k);
  });
}

void expectSameCounts(const scene::Scene& scene, const scene::Camera& camera, const Vec4& light) {
  const Stage stage(scene, camera);
  const auto silhouette = shadow::findSilhouette(stage.geometry->casters, light);
  ShadowCount count(stage.geometry->casters);
  BlockImage<std::int32_t> counts;
  ASSERT_TRUE(count.plan(stage.request(silhouette)));
  ASSERT_TRUE(countAll(count, stage, counts));
  const ByPixel byPixel(stage, silhouette);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      if (stage.seen.triangle.at(x, y) == shadow::kNoTriangle) continue;
      const auto expected = byPixel.at(x, y);
      if (expected) {
        ASSERT_EQ(counts.at(x, y), *expected) << x << ' ' << y;
      }
    }
}

scene::Camera cameraAt(const Vec3& eye, const Vec3& target, int width, int height) {
  scene::Camera camera;
  camera.eye = eye, camera.target = target;
  camera.width = width, camera.height = height;
  return camera;
}

RC_GTEST_PROP(ShadowCount, CountsInBlocksWhatSidesCountPixelByPixel, ()) {
  const auto seed = *rc::gen::inRange(0, 1 << 20);
  shapes::Random random(static_cast<std::uint64_t>(seed));
  const auto lattice = [](shapes::Random& r) { return Vec3(r.whole(-4, 4), r.whole(-4, 4), r.whole(0, 6)); };
  const scene::Scene scene = shapes::scene({shapes::soup(static_cast<std::uint64_t>(seed), 12, lattice),
                                            shapes::quad({-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1})});
  // In the planes of many sides and of some triangles.
  const Vec3 eye(random.whole(-5, 5) + 0.5, random.whole(-5, 5), random.whole(1, 9) + 0.5);
  const bool sun = random.whole(0, 1) == 1;
  const Vec4 light(random.whole(-3, 3), random.whole(-3, 3), random.whole(1, 9), sun ? 0.0 : 1.0);
  expectSameCounts(scene, cameraAt(eye, Vec3(0.1, 0.2, 0.3), 83, 45), light);
}

TEST(ShadowCount, GoesFarBeyondWhatEightBitsHold) {
  std::vector<shapes::Mesh> sheets{shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})};
  for (int i = 1; i <= 512; ++i)
    sheets.push_back(
        shapes::quad({-1, -1, 1 + i * 0.001}, {1, -1, 1 + i * 0.001}, {1, 1, 1 + i * 0.001}, {-1, 1, 1 + i * 0.001}));
  const Stage stage(shapes::scene(std::move(sheets)), cameraAt({3, 0.1, 0.7}, {0, 0, 0}, 64, 64));
  const auto silhouette = shadow::findSilhouette(stage.geometry->casters, Vec4(0.1, 0.2, 1.0, 0.0));
  ShadowCount count(stage.geometry->casters);
  BlockImage<std::int32_t> counts;
  ASSERT_TRUE(count.plan(stage.request(silhouette)));
  ASSERT_TRUE(countAll(count, stage, counts));
  EXPECT_EQ(counts.at(32, 32), 512);
}

TEST(SurfaceRaster, ShowsTheNearestOfManySheetsInEveryPixelAndKeepsItsDepth) {
  std::vector<shapes::Mesh> sheets;
  for (int i = 0; i < 40; ++i) sheets.push_back(shapes::quad({-9, -9, i}, {9, -9, i}, {9, 9, i}, {-9, 9, i}));
  const scene::Camera camera = cameraAt({0, 0, 50}, {0, 0, 0}, 61, 37);
  const Stage stage(shapes::scene(std::move(sheets)), camera);
  const auto surface = surfaceBuffer(stage.space, stage.seen);
  ASSERT_TRUE(surface);
  for (const float depth : surface->depth.pixels())
    EXPECT_TRUE(depth == std::numeric_limits<float>::infinity() || std::abs(depth - 11.0f) < 1e-5f);
  EXPECT_FLOAT_EQ(surface->depth(30, 18), 11.0f);
}

TEST(SurfaceRaster, LeavesOutAndTellsTrianglesInWhosePlaneTheEyeLies) {
  const Stage stage(shapes::scene({shapes::quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0})}),
                    cameraAt({5, 0, 0}, {0, 0, 0}, 17, 17));
  EXPECT_EQ(stage.invisible.size(), 2u);
  for (const std::uint64_t bits : stage.receivers) EXPECT_EQ(bits, 0u);
}

TEST(SurfaceRaster, SummariesSayWhatBlocksShow) {
  // Steps with gaps between them, and nothing beside them.
  std::vector<shapes::Mesh> steps;
  for (int i = 0; i < 9; ++i)
    steps.push_back(
        shapes::quad({-9, -9.0 + 2 * i, i}, {9, -9.0 + 2 * i, i}, {9, -7.5 + 2 * i, i}, {-9, -7.5 + 2 * i, i}));
  const Stage stage(shapes::scene(std::move(steps)), cameraAt({0, -3, 25}, {0, 0, 0}, 611, 353));
  std::size_t single = 0;
  for (std::size_t i = 0; i < stage.seen.summary.size(); ++i) {
    const BlockSummary& summary = stage.seen.summary[i];
    const auto& triangle = stage.seen.triangle.blocks[i].pixel;
    const auto& nearness = stage.seen.nearness.blocks[i].pixel;
    float farthest = std::numeric_limits<float>::infinity(), nearest = 0.0f;
    for (std::size_t k = 0; k < 64; ++k) {
      if (triangle[k] == shadow::kNoTriangle) continue;
      farthest = std::min(farthest, nearness[k]), nearest = std::max(nearest, nearness[k]);
    }
    EXPECT_EQ(summary.covered, stage.receivers[i]);
    EXPECT_EQ(summary.nearest, nearest);
    EXPECT_EQ(summary.farthest, summary.covered != 0 ? farthest : 0.0f);
    const bool one = std::ranges::all_of(triangle, [&](std::uint32_t t) { return t == triangle[0]; });
    EXPECT_EQ(summary.triangle, one ? triangle[0] : BlockSummary::kSeveral);
    single += one && triangle[0] != shadow::kNoTriangle;
  }
  EXPECT_GT(single, 20u);
}

TEST(SurfaceRaster, AnEmptySceneIsAnEmptyPicture) {
  const Stage stage(scene::Scene{}, cameraAt({1, 1, 1}, {0, 0, 0}, 9, 9));
  for (const std::uint64_t bits : stage.receivers) EXPECT_EQ(bits, 0u);
}

}  // namespace
}  // namespace umbrage::raster
