#include "umbrage/raster/scan_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.hpp"
#include "umbrage/raster/depth_count.hpp"
#include "umbrage/raster/projected_edges.hpp"

namespace umbrage::raster {
namespace {

PixelSpace latticeSpace(int width, int height) {
  PixelSpace space;
  space.width = width, space.height = height;
  return space;
}

// Surfaces before an eye in the origin whose pixels are whole units of the plane w = 1.
struct Scenery {
  PixelSpace space;
  std::vector<Vec3> points;
  std::vector<Patch> patches;

  Scenery(int width, int height) : space(latticeSpace(width, height)) {}

  // Corners are pixels and depths.
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec3& p : {a, b, c}) points.push_back(p.z * Vec3(p.x, p.y, 1.0));
    Patch patch;
    bound(space, std::span(points).last(3), patch);
    if (!makePatch(space, {points, {}}, {first, first + 1, first + 2}, false, patch) || patch.distance == 0.0) return;
    patch.x[3] /= patch.distance, patch.y[3] /= patch.distance, patch.c[3] /= patch.distance;
    patch.distance = 1.0;
    patch.id = first / 3;
    patches.push_back(patch);
  }
  void addQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { add(a, b, c), add(a, c, d); }

  [[nodiscard]] const Patch* nearestAt(int x, int y) const {
    const Corners corners{points, {}};
    const Patch* nearest = nullptr;
    for (const Patch& p : patches)
      if (p.covers(corners, x, y) && (nearest == nullptr || alongRow(p, 3, y).at(x) > alongRow(*nearest, 3, y).at(x)))
        nearest = &p;
    return nearest;
  }

  // The runs of every row.
  [[nodiscard]] std::vector<std::vector<Run>> runs() const {
    const Corners corners{points, {}};
    ActiveList active(corners, 0, space.height);
    for (const Patch& p : patches) active.add(p);
    std::vector<std::vector<Run>> rows(static_cast<std::size_t>(space.height));
    VisibleRuns visible;
    for (int y = 0; y < space.height; ++y) {
      active.moveTo(y);
      visible.find(active.row(), y, rows[static_cast<std::size_t>(y)]);
    }
    return rows;
  }
};

void expectSameAsPixelByPixel(const Scenery& s) {
  const auto rows = s.runs();
  for (int y = 0; y < s.space.height; ++y) {
    std::vector<const Patch*> shown(static_cast<std::size_t>(s.space.width), nullptr);
    int from = 0;
    for (const raster::Run& run : rows[static_cast<std::size_t>(y)]) {
      ASSERT_FALSE(run.pixels.empty());
      ASSERT_GE(run.pixels.begin, from) << "runs overlap";
      from = run.pixels.end;
      for (int x = run.pixels.begin; x < run.pixels.end; ++x) shown[static_cast<std::size_t>(x)] = run.surface;
    }
    for (int x = 0; x < s.space.width; ++x)
      ASSERT_EQ(shown[static_cast<std::size_t>(x)], s.nearestAt(x, y)) << x << ' ' << y;
  }
}

TEST(Stretch, IsWhereAFunctionIsAboveItsLimit) {
  shapes::Random random(3);
  for (int round = 0; round < 20000; ++round) {
    const Slope f{double(random.whole(-40, 40)) / random.whole(1, 7), double(random.whole(-9, 9)) / random.whole(1, 5)};
    const int begin = random.whole(-5, 20);
    const Stretch within{begin, begin + random.whole(0, 30)};
    const double limit = random.whole(-3, 3);
    const Stretch found = above(f, limit, within);
    for (int x = within.begin; x < within.end; ++x)
      ASSERT_EQ(f.at(x) > limit, x >= found.begin && x < found.end) << f.at0 << ' ' << f.perPixel << ' ' << x;
  }
}

// Corners on centres of pixels: most signs are those of exact ties.
TEST(CoveredInRow, IsWhatThePatchCoversPixelByPixel) {
  shapes::Random random(11);
  Scenery s(40, 30);
  for (int i = 0; i < 400; ++i) {
    const auto corner = [&] {
      return Vec3(random.whole(-9, 48) + 0.5, random.whole(-9, 38) + 0.5, random.whole(1, 9));
    };
    s.add(corner(), corner(), corner());
  }
  // Behind the eye, too.
  for (Vec3& p : s.points)
    if (random.whole(0, 9) == 0) p = -p;
  const Corners corners{s.points, {}};
  std::size_t covered = 0;
  for (Patch& p : s.patches) {
    const std::array<Vec3, 3> points{s.points[p.corner[0]], s.points[p.corner[1]], s.points[p.corner[2]]};
    bound(s.space, points, p);
    if (!makePatch(s.space, corners, p.corner, random.whole(0, 1) == 1, p)) continue;
    const Crossings crossings(p);
    for (int y = 0; y < s.space.height; ++y) {
      const Stretch row = coveredInRow(p, corners, y);
      ASSERT_EQ(crossings.covered(p, corners, y), row);
      for (int x = p.x0; x < p.x1; ++x) {
        const bool expected = y >= p.y0 && y < p.y1 && p.covers(corners, x, y);
        ASSERT_EQ(expected, x >= row.begin && x < row.end) << x << ' ' << y;
        covered += expected;
      }
    }
  }
  EXPECT_GT(covered, 10000u);
}

TEST(VisibleRuns, ShowTheNearestOfPenetratingTriangles) {
  shapes::Random random(5);
  for (int round = 0; round < 30; ++round) {
    Scenery s(60, 40);
    for (int i = 0; i < 25; ++i) {
      const auto corner = [&] { return Vec3(random.in(-20, 80), random.in(-20, 60), random.in(1, 9)); };
      s.add(corner(), corner(), corner());
    }
    expectSameAsPixelByPixel(s);
  }
}

// Ties everywhere: corners on centres of pixels, depths of a few values, triangles twice.
TEST(VisibleRuns, ShowTheFirstOfSurfacesThatCoincide) {
  shapes::Random random(6);
  for (int round = 0; round < 30; ++round) {
    Scenery s(24, 16);
    for (int i = 0; i < 12; ++i) {
      const double w = random.whole(1, 3);
      const auto corner = [&] { return Vec3(random.whole(-4, 28) + 0.5, random.whole(-4, 20) + 0.5, w); };
      const Vec3 a = corner(), b = corner(), c = corner();
      s.add(a, b, c);
      if (random.whole(0, 2) == 0) s.add(a, b, c);
    }
    expectSameAsPixelByPixel(s);
  }
}

// One falls away to the right, the other comes nearer: they pass through each other in the middle, where both are at nearness 3/4.
TEST(VisibleRuns, AreCutWhereSurfacesPenetrate) {
  Scenery s(20, 4);
  s.addQuad({0, 0, 1}, {20, 0, 2}, {20, 4, 2}, {0, 4, 1});
  s.addQuad({0, 0, 2}, {20, 0, 1}, {20, 4, 1}, {0, 4, 2});
  const std::vector<raster::Run> row = s.runs()[1];
  const auto ofFirst = [](const raster::Run& run) { return run.surface->id < 2; };
  for (const raster::Run& run : row)
    EXPECT_EQ(ofFirst(run), run.pixels.end <= 10) << run.pixels.begin << ' ' << run.pixels.end;
  EXPECT_EQ(row.front().pixels.begin, 0);
  EXPECT_EQ(row.back().pixels.end, 20);
}

// A U, given as triangles: a row through its arms shows what is behind between them.
TEST(VisibleRuns, SeeThroughTheNotchOfAConcavePolygon) {
  Scenery s(30, 20);
  s.addQuad({0, 0, 5}, {30, 0, 5}, {30, 20, 5}, {0, 20, 5});  // behind
  s.addQuad({5, 2, 1}, {10, 2, 1}, {10, 18, 1}, {5, 18, 1});
  s.addQuad({20, 2, 1}, {25, 2, 1}, {25, 18, 1}, {20, 18, 1});
  s.addQuad({10, 12, 1}, {20, 12, 1}, {20, 18, 1}, {10, 18, 1});
  const auto rows = s.runs();
  std::vector<int> near(30, 0);
  const auto show = [&](int y) {
    std::fill(near.begin(), near.end(), 0);
    for (const raster::Run& run : rows[static_cast<std::size_t>(y)])
      for (int x = run.pixels.begin; x < run.pixels.end; ++x) near[static_cast<std::size_t>(x)] = run.surface->id >= 2;
    return std::vector<int>(near);
  };
  const std::vector<int> arms = show(6), bow = show(15), above = show(1);
  for (int x = 0; x < 30; ++x) {
    const auto i = static_cast<std::size_t>(x);
    EXPECT_EQ(arms[i], (x >= 5 && x < 10) || (x >= 20 && x < 25)) << x;
    EXPECT_EQ(bow[i], x >= 5 && x < 25) << x;
    EXPECT_EQ(above[i], 0) << x;
  }
}

// Shadow polygons that begin, end and dive behind the surface, on the same pixels and on others.
TEST(DepthCount, CountsWhatLiesBeforeTheSurfacePixelByPixel) {
  shapes::Random random(9);
  for (int round = 0; round < 200; ++round) {
    Scenery s(50, 3);
    s.addQuad({-60, -9, random.in(1, 9)}, {110, -9, random.in(1, 9)}, {110, 12, random.in(1, 9)},
              {-60, 12, random.in(1, 9)});
    const std::size_t surfaces = s.patches.size();
    for (int i = 0; i < 30; ++i) {
      const auto corner = [&] { return Vec3(random.whole(-9, 58), random.in(-20, 20), random.in(1, 9)); };
      s.add(corner(), corner(), corner());
    }
    std::vector<Patch> sides(s.patches.begin() + static_cast<std::ptrdiff_t>(surfaces), s.patches.end());
    s.patches.resize(surfaces);
    const Corners corners{s.points, {}};
    ActiveList active(corners, 0, 3);
    for (Patch& side : sides) {
      side.weight = random.whole(-2, 2);
      active.add(side);
    }
    DepthCount count(50);
    for (int y = 0; y < 3; ++y) {
      active.moveTo(y);
      const std::vector<raster::Run> runs = s.runs()[static_cast<std::size_t>(y)];
      std::size_t pixels = 0;
      count.visit(runs, active.row(), y, 7, [&](const Stretch& piece, int found) {
        for (int x = piece.begin; x < piece.end; ++x, ++pixels) {
          const auto run =
              std::find_if(runs.begin(), runs.end(), [&](const raster::Run& r) { return x < r.pixels.end; });
          int expected = 7;
          for (const Patch& side : sides)
            if (side.covers(corners, x, y) &&
                alongRow(side, 3, y).at(x) > alongRow(*run->surface, 3, y).at(x) * side.distance)
              expected += side.weight;
          ASSERT_EQ(found, expected) << x << ' ' << y;
        }
      });
      EXPECT_EQ(pixels, 50u);
    }
  }
}

// A sheet in many triangles between light and ground, so that projected edges run through centres of pixels: its triangles hide
// every pixel under it once, and none twice.
TEST(ProjectedEdges, OfASheetLeaveNoGapAndDoNotOverlap) {
  shapes::Random random(2);
  for (int round = 0; round < 10; ++round) {
    scene::Scene scene = shapes::scene({shapes::grid(6, 6, false, false, [&](double u, double v) {
      return Vec3(random.whole(-1, 1) + 24 * u, random.whole(-1, 1) + 24 * v, 2.0);
    })});
    const scene::Surfaces flat = scene::flatten(scene);
    const shadow::CasterSet casters = shadow::buildCasters(flat);
    // Straight down on a plane at depth 4 under an eye in the origin; the light half as far as the sheet, so its shadow is twice as large and more.
    PixelSpace space = latticeSpace(64, 64);
    std::vector<Vec3> mapped;
    for (std::uint32_t i = 0; i < casters.positions.size(); ++i) mapped.push_back(casters.position(i) + casters.origin);
    const Sighted light{{12.0, 12.0, 1.0}, 1.0};
    const Corners corners{mapped, light};
    std::vector<std::int8_t> side(casters.triangles.size(), 1);
    const ProjectedEdges edges(space, casters, side, corners);
    Scenery ground(64, 64);
    ground.add({-500, -500, 4}, {900, -500, 4}, {-500, 900, 4});
    std::size_t dark = 0;
    for (int y = 0; y < 64; ++y) {
      std::vector<int> hidden(64, 0);
      const SurfaceRow row = surfaceRow(space, ground.patches[0], y);
      for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
        const Stretch s = edges.shadow(t, row, {0, 64});
        for (int x = s.begin; x < s.end; ++x) ++hidden[static_cast<std::size_t>(x)];
      }
      for (int x = 0; x < 64; ++x) {
        // Where the way from the pixel's point to the light passes the sheet's height.
        const Vec3 p = 4.0 * Vec3(x + 0.5, y + 0.5, 1.0), at = light.v + (p - light.v) / 3.0;
        const bool inside = at.x > 1.0 && at.x < 23.0 && at.y > 1.0 && at.y < 23.0;
        const bool outside = at.x < -1.0 || at.x > 25.0 || at.y < -1.0 || at.y > 25.0;
        const int count = hidden[static_cast<std::size_t>(x)];
        if (inside) {
          ASSERT_EQ(count, 1) << x << ' ' << y;
        }
        if (outside) {
          ASSERT_EQ(count, 0) << x << ' ' << y;
        }
        dark += count > 0;
      }
    }
    EXPECT_GT(dark, 100u);
  }
}

TEST(ProjectedEdges, OfASurfaceDoNotHideItselfNorWhatIsOnTheLightsSideOfIt) {
  const scene::Scene scene = shapes::scene({shapes::quad({0, 0, 2}, {40, 0, 2}, {40, 40, 2}, {0, 40, 2})});
  const shadow::CasterSet casters = shadow::buildCasters(scene::flatten(scene));
  std::vector<Vec3> mapped;
  for (std::uint32_t i = 0; i < casters.positions.size(); ++i) mapped.push_back(casters.position(i) + casters.origin);
  const PixelSpace space = latticeSpace(32, 32);
  const std::vector<std::int8_t> side(casters.triangles.size(), 1);
  const ProjectedEdges edges(space, casters, side, {mapped, {{8, 8, 1}, 1.0}});
  for (const double depth : {2.0, 1.5}) {
    Scenery ground(32, 32);
    ground.add({-500, -500, depth}, {900, -500, depth}, {-500, 900, depth});
    for (int y = 0; y < 32; ++y)
      for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
        EXPECT_TRUE(edges.shadow(t, surfaceRow(space, ground.patches[0], y), {0, 32}).empty()) << depth << ' ' << y;
  }
}

}  // namespace
}  // namespace umbrage::raster
