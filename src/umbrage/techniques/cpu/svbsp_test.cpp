#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.hpp"
#include "umbrage/techniques/cpu/detail/ray_traced.hpp"
#include "umbrage/techniques/cpu/detail/svbsp.hpp"

namespace umbrage::techniques::detail {
namespace {

std::shared_ptr<const shadow::Geometry> site() {
  auto s = shapes::scene({shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}),
                          shapes::box({-1, -2, 0}, {2, 1, 3}), shapes::knot({-4, 3, 3}, 2, 0.4, 60, 8)});
  s.instances[0].casts = false;
  return shadow::makeGeometry(s);
}

scene::Camera camera(int width = 160, int height = 90) {
  scene::Camera c;
  c.eye = {9, -14, 11}, c.target = {-1, 0.5, 1}, c.up = {0, 0, 1};
  c.width = width, c.height = height;
  return c;
}

scene::Light sun(double turn) {
  return {scene::DirectionalLight{{std::cos(turn), std::sin(turn), -0.8}}, Vec3(1.0), 1.0, ""};
}

std::size_t differing(const shadow::LightMask& a, const shadow::LightMask& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.light.size(); ++i) count += a.light.pixels()[i] != b.light.pixels()[i];
  return count;
}

// A sun that goes round, more places than are kept, twice: cuts that are kept, dropped and made again are those of rays, but where a border passes
// through a pixel's centre within single precision.
TEST(Svbsp, ASunThatGoesRoundIsAsRaysHaveIt) {
  const auto geometry = site();
  auto svbsp = makeSvbsp().value();
  auto rays = makeRayTraced().value();
  ASSERT_TRUE(svbsp->prepare(geometry) && rays->prepare(geometry));
  std::size_t different = 0, dark = 0;
  for (int i = 0; i < 40; ++i) {
    const scene::Light light = sun(0.31 * (i % 20));
    const auto a = svbsp->shade({camera(), {&light, 1}}), b = rays->shade({camera(), {&light, 1}});
    ASSERT_TRUE(a && b);
    different += differing(a->masks[0], b->masks[0]);
    dark += static_cast<std::size_t>(std::ranges::count(a->masks[0].light.pixels(), std::uint8_t{0}));
  }
  EXPECT_LE(different, 4u);
  EXPECT_GT(dark, 100000u);
}

TEST(Svbsp, APictureIsTheSameTwiceAndFromCutsOfOthers) {
  const auto geometry = site();
  const std::vector<scene::Light> lights = {
      sun(1),
      {scene::PointLight{{4, -3, 6}}, Vec3(1.0), 1.0, ""},
      {scene::SpotLight{{-6, -6, 8}, {1, 1, -1}, Angle::degrees(20)}, Vec3(1.0), 1.0, ""}};
  auto one = makeSvbsp().value(), other = makeSvbsp().value();
  ASSERT_TRUE(one->prepare(geometry) && other->prepare(geometry));
  const auto first = one->shade({camera(), lights});
  ASSERT_TRUE(other->shade({camera(40, 30), lights}));
  const auto again = one->shade({camera(), lights}), later = other->shade({camera(), lights});
  ASSERT_TRUE(first && again && later);
  ASSERT_EQ(first->masks.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(differing(first->masks[k], again->masks[k]), 0u);
    EXPECT_EQ(differing(first->masks[k], later->masks[k]), 0u);
  }
}

TEST(Svbsp, AnotherSceneForgetsTheFirst) {
  auto technique = makeSvbsp().value(), fresh = makeSvbsp().value();
  const scene::Light light = sun(2);
  const auto other = shadow::makeGeometry(
      shapes::scene({shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}), shapes::box({2, 2, 1}, {3, 3, 2})}));
  ASSERT_TRUE(technique->prepare(site()));
  ASSERT_TRUE(technique->shade({camera(), {&light, 1}}));
  ASSERT_TRUE(technique->prepare(other) && fresh->prepare(other));
  const auto a = technique->shade({camera(), {&light, 1}}), b = fresh->shade({camera(), {&light, 1}});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(differing(a->masks[0], b->masks[0]), 0u);
  const auto none = technique->shade({camera(), {}});
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->masks.empty());
}

}  // namespace
}  // namespace umbrage::techniques::detail
