#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "umbrage/coin/detail/subsets.hpp"

namespace umbrage::coin::detail {
namespace {

shadow::LightMask maskOf(int width, int height, std::uint8_t light) {
  return {image::GreyImage(width, height, light), {}, image::GreyImage(width, height, 1)};
}

TEST(Subsets, PixelsThatAllLightsReachAndEmptyOnesAreNone) {
  shadow::LightMask mask = maskOf(4, 3, 255);
  mask.covered(2, 1) = mask.light(2, 1) = 0;  // nothing is seen there
  const auto subsets = *subsetsOf(std::vector{mask});
  EXPECT_TRUE(subsets.all.empty());
  EXPECT_EQ(roundsOf(subsets), 0u);
}

TEST(Subsets, TellWhichLightsAreOffWhere) {
  std::vector<shadow::LightMask> masks = {maskOf(4, 3, 255), maskOf(4, 3, 255)};
  masks[0].light(1, 0) = masks[0].light(2, 0) = masks[1].light(2, 0) = masks[1].light(3, 2) = 0;
  const auto subsets = *subsetsOf(masks);
  ASSERT_EQ(subsets.all.size(), 3u);
  const auto at = [&](int x, int y) { return subsets.codes[std::size_t(2 - y) * 4 + std::size_t(x)]; };
  EXPECT_EQ(subsets.all[at(1, 0) - 1u].off, std::vector<std::size_t>{0});
  EXPECT_EQ(subsets.all[at(2, 0) - 1u].off, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(subsets.all[at(3, 2) - 1u].off, std::vector<std::size_t>{1});
  EXPECT_EQ(at(0, 0), 0u);
  EXPECT_EQ(subsets.all[at(3, 2) - 1u].box, (gl::Rect{3, 0, 1, 1}));
  EXPECT_EQ(boxOf(subsets), (gl::Rect{1, 0, 3, 3}));
  const auto stencil = *stencilOf(subsets, 0, {2, 2, 2, 1});
  EXPECT_EQ(std::vector(stencil.begin(), stencil.end()),
            (std::vector<std::uint8_t>{static_cast<std::uint8_t>(at(2, 0)), 0}));
}

TEST(Subsets, LightsThatDoNotShineOnWhatIsSeenDoNotCount) {
  std::vector<shadow::LightMask> masks = {maskOf(2, 1, 0), maskOf(2, 1, 0)};
  image::Image<std::uint32_t> triangle(2, 1);
  triangle(1, 0) = 1;
  const std::vector<std::uint64_t> on = {0b01, 0b00};
  const auto subsets = *subsetsOf(masks, {&triangle, on});
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
  const auto subsets = *subsetsOf(masks);
  ASSERT_EQ(subsets.all.size(), 511u);
  ASSERT_EQ(roundsOf(subsets), 3u);
  // Every pixel has its turn exactly once.
  std::vector<int> turns(512);
  for (std::size_t round = 0; round < 3; ++round) {
    const auto stencil = *stencilOf(subsets, round, {0, 0, 512, 1});
    for (std::size_t x = 0; x < 512; ++x) turns[x] += stencil[x] != kNotNow;
  }
  EXPECT_EQ(turns, std::vector<int>(512, 1));
}

// Many bands of rows, each of which meets the sets in an order of its own, and runs of any length.
TEST(Subsets, AreThoseOfEveryPixelWhateverTheSizeAndTheNumberOfLights) {
  std::mt19937 random(3);
  for (const std::size_t lights : {1u, 2u, 3u, 8u, 9u, 64u}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {7, 40}, {64, 33}, {129, 17}, {200, 100}}) {
      std::vector<shadow::LightMask> masks(lights, maskOf(width, height, 255));
      for (auto& mask : masks)
        for (int run = 0; run < 12; ++run) {
          const int x0 = int(random() % unsigned(width)), y0 = int(random() % unsigned(height));
          const int x1 = std::min(width, x0 + 1 + int(random() % 40)),
                    y1 = std::min(height, y0 + 1 + int(random() % 30));
          for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) (run % 4 == 0 ? mask.covered : mask.light)(x, y) = 0;
        }
      const auto subsets = *subsetsOf(masks);
      std::vector<gl::Rect> boxes(subsets.all.size());
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          std::vector<std::size_t> off;
          for (std::size_t k = 0; k < lights; ++k)
            if (masks[k].covered(x, y) != 0 && masks[k].light(x, y) == 0) off.push_back(k);
          const std::size_t code = subsets.codes[std::size_t(height - 1 - y) * std::size_t(width) + std::size_t(x)];
          ASSERT_EQ(code == 0, off.empty());
          if (code == 0) continue;
          ASSERT_EQ(subsets.all[code - 1].off, off);
          gl::Rect& box = boxes[code - 1];
          const gl::Rect here{x, height - 1 - y, 1, 1};
          box = box.empty() ? here
                            : gl::Rect{std::min(box.x, here.x), std::min(box.y, here.y),
                                       std::max(box.x + box.width, here.x + 1) - std::min(box.x, here.x),
                                       std::max(box.y + box.height, here.y + 1) - std::min(box.y, here.y)};
        }
      for (std::size_t i = 0; i < boxes.size(); ++i) EXPECT_EQ(subsets.all[i].box, boxes[i]);
    }
  }
}

}  // namespace
}  // namespace umbrage::coin::detail
