#include <gmock/gmock.h>

#include "viewer.hpp"

// What keys and the mouse do to the lights.
namespace umbrage::demo_test {
namespace {

using Lights = ViewerTest;

TEST_F(Lights, EachComesAndGoesByItsKey) {
  start();
  View before = view();
  const double first = before.brightness();
  press("1", "point light 1 removed");
  const View dark = changedFrom(before);
  EXPECT_LT(dark.brightness(), first / 2);
  for (const std::string key : {"2", "3", "4", "5", "6"}) {
    press(key, "added");
    EXPECT_GT(changedFrom(dark).brightness(), dark.brightness() + 2) << key;
    press(key, "removed");
    expectAgain(dark);
  }
  press("1", "point light 1 added");
  expectAgain(before);
}

TEST_F(Lights, SeveralAtOnceCastShadowsOfTheirOwn) {
  start();
  const View one = view();
  press("2", "added");
  const View two = changedFrom(one);
  press("5", "added");
  const View lit = changedFrom(two);
  press("F1", "off");
  // One shadow has some 2,000 pixels here.
  EXPECT_GT(differing(lit, changedFrom(lit)), 5000u);
}

TEST_F(Lights, TheFirstIsSwitchedAndDimmed) {
  start();
  const View lit = view();
  press("F9", "light 1 off");
  EXPECT_LT(changedFrom(lit).brightness(), lit.brightness() / 2);
  press("F9", "light 1 on");
  expectAgain(lit);
  press("braceright", "light 1 at 70 %");
  const View dimmed = changedFrom(lit);
  EXPECT_LT(dimmed.brightness(), lit.brightness() - 2);
  press("braceleft", "light 1 at 80 %");
  expectAgain(lit);
}

TEST_F(Lights, AmbientLightIsMoreAndLess) {
  start();
  const View lit = view();
  press("F11", "ambient light 30 %");
  const View more = changedFrom(lit);
  EXPECT_GT(more.brightness(), lit.brightness() + 2);
  press("F12", "ambient light 20 %");
  expectAgain(lit);
}

TEST_F(Lights, TheMouseDragsThemInActionMode) {
  start();
  enterAction();
  const View before = view();
  double x = 0, y = 0, count = 0;
  for (int row = 0; row < before.picture.height(); ++row) {
    for (int column = 0; column < before.picture.width(); ++column) {
      if (!(before.picture(column, row) == image::Rgb8{255, 255, 255})) continue;
      x += column;
      y += row;
      ++count;
    }
  }
  ASSERT_GT(count, 20);
  const int fromX = 36 + int(x / count), fromY = 2 + int(y / count);
  display().act({"mousemove", std::to_string(fromX), std::to_string(fromY), "mousedown", "1"});
  for (int step = 1; step <= 6; ++step)
    display().act({"mousemove", std::to_string(fromX - 10 * step), std::to_string(fromY)});
  display().act({"mouseup", "1", "mousemove", "200", std::to_string(kHeight - 8)});
  const View after = changedFrom(before);
  EXPECT_GT(differing(before, after), 5000u);  // its light on everything, not only its handle
}

}  // namespace
}  // namespace umbrage::demo_test
