#include <gtest/gtest.h>

#include "umbrage/coin/detail/subsets.hpp"

namespace umbrage::coin::detail {
namespace {

shadow::LightMask maskOf(int width, int height, std::uint8_t light) {
  return {image::GreyImage(width, height, light), {}, image::GreyImage(width, height, 1)};
}

TEST(Subsets, PixelsThatAllLightsReachAndEmptyOnesAreNone) {
  shadow::LightMask mask = maskOf(4, 3, 255);
  mask.covered(2, 1) = mask.light(2, 1) = 0;  // nothing is seen there
  const auto subsets = subsetsOf(std::vector{mask});
  EXPECT_TRUE(subsets.all.empty());
  EXPECT_EQ(roundsOf(subsets), 0u);
}

TEST(Subsets, TellWhichLightsAreOffWhere) {
  std::vector<shadow::LightMask> masks = {maskOf(4, 3, 255), maskOf(4, 3, 255)};
  masks[0].light(1, 0) = masks[0].light(2, 0) = masks[1].light(2, 0) = masks[1].light(3, 2) = 0;
  const auto subsets = subsetsOf(masks);
  ASSERT_EQ(subsets.all.size(), 3u);
  const auto at = [&](int x, int y) { return subsets.codes[std::size_t(2 - y) * 4 + std::size_t(x)]; };
  EXPECT_EQ(subsets.all[at(1, 0) - 1u].off, std::vector<std::size_t>{0});
  EXPECT_EQ(subsets.all[at(2, 0) - 1u].off, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(subsets.all[at(3, 2) - 1u].off, std::vector<std::size_t>{1});
  EXPECT_EQ(at(0, 0), 0u);
  EXPECT_EQ(subsets.all[at(3, 2) - 1u].box, (gl::Rect{3, 0, 1, 1}));
  EXPECT_EQ(boxOf(subsets), (gl::Rect{1, 0, 3, 3}));
  EXPECT_EQ(stencilOf(subsets, 0, {2, 2, 2, 1}), (std::vector<std::uint8_t>{static_cast<std::uint8_t>(at(2, 0)), 0}));
}

TEST(Subsets, LightsThatDoNotShineOnWhatIsSeenDoNotCount) {
  std::vector<shadow::LightMask> masks = {maskOf(2, 1, 0), maskOf(2, 1, 0)};
  image::Image<std::uint32_t> triangle(2, 1);
  triangle(1, 0) = 1;
  const std::vector<std::uint64_t> on = {0b01, 0b00};
  const auto subsets = subsetsOf(masks, {&triangle, on});
  ASSERT_EQ(subsets.all.size(), 1u);
  EXPECT_EQ(subsets.all[0].off, std::vector<std::size_t>{0});
  EXPECT_EQ(subsets.codes[1], 0u);
}

TEST(Subsets, MoreThanAStencilHoldsTakeTurns) {
  constexpr int kLights = 9;
  std::vector<shadow::LightMask> masks(kLights, maskOf(512, 1, 255));
  for (int x = 0; x < 512; ++x)
    for (int k = 0; k < kLights; ++k)
      if ((x >> k & 1) != 0) masks[std::size_t(k)].light(x, 0) = 0;
  const auto subsets = subsetsOf(masks);
  ASSERT_EQ(subsets.all.size(), 511u);
  ASSERT_EQ(roundsOf(subsets), 3u);
  // Every pixel has its turn exactly once.
  std::vector<int> turns(512);
  for (std::size_t round = 0; round < 3; ++round) {
    const auto stencil = stencilOf(subsets, round, {0, 0, 512, 1});
    for (std::size_t x = 0; x < 512; ++x) turns[x] += stencil[x] != kNotNow;
  }
  EXPECT_EQ(turns, std::vector<int>(512, 1));
}

}  // namespace
}  // namespace umbrage::coin::detail
