#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "support/shapes.hpp"
#include "umbrage/trace/light_rays.hpp"
#include "umbrage/trace/occlusion.hpp"
#include "umbrage/trace/tiles.hpp"
#include "umbrage/trace/visible_surfaces.hpp"

namespace umbrage::trace {
namespace {

Occlusion make(const scene::Scene& s) {
  auto built = Occlusion::build(std::make_shared<scene::Surfaces>(scene::flatten(s)));
  EXPECT_TRUE(built.has_value());
  return std::move(*built);
}

Rays8 oneRay(const Vec3f& from, const Vec3f& direction, float length) {
  Rays8 rays{};
  rays.fromX[3] = from.x, rays.fromY[3] = from.y, rays.fromZ[3] = from.z;
  rays.directionX[3] = direction.x, rays.directionY[3] = direction.y, rays.directionZ[3] = direction.z;
  rays.length[3] = length;
  rays.active = 8;
  return rays;
}

const Corners kTriangle{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}};

TEST(Segment, MeetsATriangleInsideAndOnItsBorder) {
  EXPECT_EQ(crossing({0.5, 0.5, 3}, {0, 0, -2}, kTriangle), 1.5);
  EXPECT_EQ(crossing({0, 0, 3}, {0, 0, -1}, kTriangle), 3.0);
  EXPECT_EQ(crossing({1, 1, -1}, {0, 0, 1}, kTriangle), 1.0);
  EXPECT_FALSE(crossing({1.001, 1, -1}, {0, 0, 1}, kTriangle));
  EXPECT_FALSE(crossing({0.5, 0.5, 3}, {0, 0, 1}, kTriangle));  // behind
  EXPECT_FALSE(crossing({0.5, 0.5, 0}, {1, 0, 0}, kTriangle));  // in the plane
}

TEST(Segment, HidesOnlyBetweenPointAndLight) {
  EXPECT_TRUE(hides(kTriangle, {0.5, 0.5, -1}, {0.5, 0.5, 1, 1}));
  EXPECT_FALSE(hides(kTriangle, {0.5, 0.5, -1}, {0.5, 0.5, -0.5, 1}));
  EXPECT_TRUE(hides(kTriangle, {0.5, 0.5, -1}, {0, 0, 1, 0}));
  EXPECT_FALSE(hides(kTriangle, {0.5, 0.5, 1}, {0, 0, 1, 0}));
  EXPECT_FALSE(hides(kTriangle, {0.5, 0.5, -1}, {0.5, 0.5, 0, 1}));  // the light lies in it
  EXPECT_FALSE(hides(kTriangle, {0.5, 0.5, 0}, {0.5, 0.5, 1, 1}));   // the point lies in it
}

TEST(Occlusion, OfNothingMeetsNothing) {
  const Occlusion nothing = make(shapes::scene({}));
  EXPECT_FALSE(nothing.nearest({0, 0, 0}, {1, 0, 0}));
  EXPECT_EQ(nothing.meetsCaster(oneRay({0, 0, 0}, {1, 0, 0}, 9)), 0u);
}

TEST(Occlusion, SeesBothSidesAndBothKindsOfSurfaces) {
  const Occlusion o = make(scene::withGround(shapes::scene({shapes::box({-1, -1, 1}, {1, 1, 2})}), 0.0));
  ASSERT_TRUE(o.nearest({0, 0, 9}, {0, 0, -2}));
  EXPECT_EQ(o.nearest({0, 0, 9}, {0, 0, -2})->at, 3.5);
  EXPECT_EQ(o.nearest({0.1, 0.2, 1.5}, {0, 0, 1})->at, 0.5);       // from inside
  EXPECT_EQ(o.nearest({0.1, 0.2, 0.25}, {0, 0, -1})->at, 0.25);    // the ground
  EXPECT_EQ(o.meetsCaster(oneRay({0, 0, 9}, {0, 0, -1}, 6)), 0u);  // ends before
  EXPECT_EQ(o.meetsCaster(oneRay({0, 0, 9}, {0, 0, -1}, 8)), 8u);
  EXPECT_EQ(o.meetsCaster(oneRay({0, 0, 0.5}, {0, 0, -1}, 8)), 0u);  // the ground casts nothing
}

TEST(Occlusion, MeetsNoSurfaceWhosePlaneHoldsTheStart) {
  const Occlusion o = make(shapes::scene({shapes::quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}),
                                          shapes::quad({-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2})}));
  EXPECT_EQ(o.nearest({0.1, 0.2, 0}, {0, 0, -1})->at, 2.0);
  EXPECT_EQ(o.nearest({0.1, 0.2, 1e-3}, {0, 0, -1})->at, 1e-3);
  EXPECT_NE(o.nearest({0.1, 0.2, 1e-12}, {0, 0, -1})->at, 1e-12);  // no technique could draw it
}

RC_GTEST_PROP(Occlusion, NearestAgreesWithEveryTriangleAsked, ()) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(1, 1u << 30);
  const Occlusion o = make(shapes::scene({shapes::soup(seed, 40, [](shapes::Random& r) {
    return r.point({Vec3(-2), Vec3(2)});
  })}));
  shapes::Random random(seed + 1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 from = random.point({Vec3(-3), Vec3(3)}), direction = random.point({Vec3(-1), Vec3(1)});
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < o.surfaces().triangles.size(); ++t)
      if (const auto at = crossing(from, direction, o.corners(t))) best = std::min(best, *at);
    const auto hit = o.nearest(from, direction);
    RC_ASSERT(hit.has_value() == std::isfinite(best));
    if (hit) RC_ASSERT(std::abs(hit->at - best) <= 1e-12 * best);
  }
}

TEST(LightRays, AskOnlyForHitsBetweenTheSurfaceAndTheLight) {
  const Occlusion o = make(shapes::scene({shapes::quad({-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}),
                                          shapes::quad({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0})}));
  SurfacePoints8 points;
  points.active = 0b111;
  const std::array<Vec3, 3> at{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(1.9, 0, 0)};
  for (std::size_t k = 0; k < 3; ++k) {
    points.position.set(k, at[k]);
    points.normal.set(k, {0, 0, 1});
    points.triangle[k] = ~0u;  // not said: the surface is known by its distance
    points.precision[k] = 1e-3;
    points.reach[k] = 0.0;
  }
  const auto hidden = [&](scene::Light light) { return LightRays(o, light).hidden(points); };
  EXPECT_EQ(hidden({scene::PointLight{{0, 0, 2}}, Vec3(1.0), 1.0, ""}), 0b101u);
  EXPECT_EQ(hidden({scene::PointLight{{0, 0, 0.9}}, Vec3(1.0), 1.0, ""}), 0u);
  EXPECT_EQ(hidden({scene::DirectionalLight{{0, 0, -1}}, Vec3(1.0), 1.0, ""}), 0b001u);
}

TEST(Lanes, AreSingleBits) {
  EXPECT_EQ(lanesWhere([](std::size_t k) { return k % 3 == 0; }), 0b1001001u);
  EXPECT_EQ(lanesWhere([](std::size_t) { return true; }), 0xffu);
  EXPECT_TRUE(hasLane(0b100u, 2));
  EXPECT_FALSE(hasLane(0b100u, 1));
}

// Points on the ground below a soup, hidden or not as one ray after the other says in double precision.
TEST(LightRays, AnswerManyPacketsAtOnceAsEachPointAlone) {
  const Occlusion o = make(shapes::scene({shapes::soup(7, 60, [](shapes::Random& r) {
    return r.point({Vec3(-2, -2, 1), Vec3(2, 2, 3)});
  })}));
  shapes::Random random(8);
  std::array<SurfacePoints8, LightRays::kBatch> packets;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    packets[i].active = 0xffu >> i;  // fewer and fewer; the others hold anything
    for (std::size_t k = 0; k < 8 - i; ++k) {
      packets[i].position.set(k, random.point({Vec3(-3, -3, 0), Vec3(3, 3, 0)}));
      packets[i].normal.set(k, {0, 0, 1});
      packets[i].triangle[k] = shadow::kNoTriangle;
      packets[i].precision[k] = k % 2 == 0 ? 1e-3 : 0.0;  // 0: every hit in double precision
      packets[i].reach[k] = 0.0;
    }
  }
  for (const scene::Light& light : {scene::Light{scene::PointLight{{0.5, 0.25, 6}}, Vec3(1.0), 1.0, ""},
                                    scene::Light{scene::DirectionalLight{{0.2, 0.1, -1}}, Vec3(1.0), 1.0, ""}}) {
    const LightRays rays(o, light);
    std::array<std::uint32_t, LightRays::kBatch> hidden;
    rays.hidden(packets, hidden);
    std::size_t dark = 0, lit = 0;
    for (std::size_t i = 0; i < packets.size(); ++i) {
      EXPECT_EQ(hidden[i], rays.hidden(packets[i]));
      EXPECT_EQ(hidden[i] & ~packets[i].active, 0u);
      for (std::size_t k = 0; k < 8 - i; ++k) {
        bool expected = false;
        for (std::uint32_t t = 0; t < o.surfaces().triangles.size(); ++t)
          expected = expected || hides(o.corners(t), packets[i].position[k], rays.light());
        EXPECT_EQ(hasLane(hidden[i], k), expected) << i << ' ' << k;
        (expected ? dark : lit) += 1;
      }
    }
    EXPECT_GT(dark, 5u);
    EXPECT_GT(lit, 5u);
  }
}

TEST(Tiles, CoverEveryPixelOnce) {
  image::Image<int> count(101, 67);
  ASSERT_TRUE(forEachTile(101, 67, [&](const Tile& tile) {
    for (int y = tile.y0; y < tile.y1; y += 2)
      for (int x = tile.x0; x < tile.x1; x += 4) forEachLane(tile, x, y, [&](int, int px, int py) { ++count(px, py); });
  }));
  EXPECT_TRUE(std::all_of(count.pixels().begin(), count.pixels().end(), [](int n) { return n == 1; }));
}

TEST(VisibleSurfaces, AreThoseThroughPixelCentresWithTheirExactDepths) {
  const Occlusion o = make(scene::withGround(shapes::scene({shapes::box({-1, -1, 0}, {1, 1, 2})}), 0.0));
  scene::Camera camera;
  camera.eye = {0.3, -8, 1}, camera.target = {0.3, 0, 1}, camera.width = 63, camera.height = 35;
  const auto seen = visibleSurfaces(o, camera);
  ASSERT_TRUE(seen.has_value());
  EXPECT_EQ(seen->depth(31, 17), 7.0f);  // the centre looks straight at the wall y = -1
  const auto rays = scene::pixelRays(camera);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const auto hit = o.nearest(camera.eye, rays.through(x + 0.5, y + 0.5));
      EXPECT_EQ(seen->triangle(x, y), hit ? hit->triangle : shadow::kNoTriangle);
      if (hit.has_value()) {
        EXPECT_EQ(seen->depth(x, y), static_cast<float>(hit->at));
      }
    }
  }
}

TEST(VisibleSurfaces, OfAnEyeAMillionSizesAway) {
  const Occlusion o = make(shapes::scene({shapes::box({-1, -1, -1}, {1, 1, 1})}));
  scene::Camera camera;
  camera.eye = {2e6, 3e5, 0}, camera.target = {0, 0, 0}, camera.width = 64, camera.height = 64;
  camera.fovY = Angle::radians(2e-6);
  const auto seen = visibleSurfaces(o, camera);
  ASSERT_TRUE(seen.has_value());
  // At this distance rows 16..47 look through the box: 32 rows of 64 for a height of 2 in 4.04.
  int covered = 0;
  for (int y = 0; y < 64; ++y) covered += seen->triangle(32, y) != shadow::kNoTriangle;
  EXPECT_NEAR(covered, 64 * 2 / (2e-6 * std::hypot(2e6, 3e5)), 1.0);
}

}  // namespace
}  // namespace umbrage::trace
