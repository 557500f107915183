#include <gtest/gtest.h>

#include "display.hpp"
#include "umbrage/image/compare.hpp"

// examples/05_coin_viewer in its window.
namespace umbrage::demo_test {
namespace {

bool isDark(const image::Rgb8& pixel) { return pixel.r < 60; }

// Between the first and the last lit pixel of the rows that show the floor: black there is the ball's shadow, or the ball's own dark side.
std::size_t shadowPixels(const image::RgbImage& screen) {
  constexpr int kLeft = 40, kRight = 460, kFloorTop = 195, kFloorBottom = 215;
  std::size_t dark = 0;
  for (int y = kFloorTop; y < kFloorBottom; ++y) {
    int first = kRight, last = kLeft;
    for (int x = kLeft; x < kRight; ++x) {
      if (isDark(screen(x, y))) continue;
      first = std::min(first, x);
      last = x;
    }
    for (int x = first; x < last; ++x) dark += isDark(screen(x, y));
  }
  return dark;
}

TEST(Example, TheShadowOfTheBallFollowsItOverTheFloor) {
  if (const auto missing = Display::missing(); !missing.empty())
    GTEST_SKIP() << "no windows here: " << missing << " is missing (scripts/deps)";
  const auto display = Display::open();
  ASSERT_NE(display, nullptr);
  const Folder folder;
  Process example({UMBRAGE_COIN_VIEWER}, display->environment(), folder / "said");
  image::RgbImage before;
  ASSERT_TRUE(eventually([&] { return shadowPixels(before = display->look()) > 60; })) << example.said();
  EXPECT_TRUE(eventually([&] {
    const image::RgbImage now = display->look();
    return shadowPixels(now) > 60 && image::compare(before, now).pixels > 500;
  }));
  EXPECT_TRUE(example.runs());
}

}  // namespace
}  // namespace umbrage::demo_test
