#include <gmock/gmock.h>

#include "umbrage/image/compare.hpp"
#include "viewer.hpp"

// What keys do to the shadows and to the objects.
namespace umbrage::demo_test {
namespace {

using testing::HasSubstr;
using testing::Not;

using Keys = ViewerTest;

bool isBrighter(const image::Rgb8& a, const image::Rgb8& b) { return a.r + a.g + a.b > b.r + b.g + b.b; }

TEST_F(Keys, ShadowsGoAndComeWithF1) {
  start();
  const View shadowed = view();
  press("F1", "shadows off");
  const View plain = changedFrom(shadowed);
  std::size_t brighter = 0, darker = 0;
  for (int y = 0; y < plain.picture.height(); ++y) {
    for (int x = 0; x < plain.picture.width(); ++x) {
      brighter += isBrighter(plain.picture(x, y), shadowed.picture(x, y));
      darker += isBrighter(shadowed.picture(x, y), plain.picture(x, y));
    }
  }
  EXPECT_GT(brighter, 1500u);  // the shadow on floor and wall
  EXPECT_EQ(darker, 0u);
  press("F1", "shadows on");
  expectAgain(shadowed);
}

TEST_F(Keys, ShadowsAreTheSameByZFailAndZPass) {
  start();
  const View automatic = view();
  for (const auto& [says, technique] : {std::pair{"z-fail", "zfail"}, {"z-pass", "zpass"}, {"z-fail", "zfail"}}) {
    press("F2", says);
    ASSERT_TRUE(hears(technique)) << demo().said();
    // Two ways of rasterising may put a border on another pixel.
    EXPECT_LT(differing(automatic, view()), 60u) << technique;
  }
}

TEST_F(Keys, WithoutSensorsThePictureWaits) {
  start();
  enterAction();
  const View here = view();
  press("Left", "moved");
  const View left = changedFrom(here);
  press("Right", "moved");
  expectAgain(here);
  press("F3", "sensors off");
  press("Left", "moved");
  EXPECT_EQ(differing(here, view()), 0u);
  press("F3", "sensors on");
  expectAgain(left);
}

TEST_F(Keys, VolumesAreShownByF4) {
  start();
  const View shadowed = view();
  press("F4", "volumes shown");
  EXPECT_GT(differing(shadowed, changedFrom(shadowed)), 1500u);
  press("F4", "volumes hidden");
  expectAgain(shadowed);
}

TEST_F(Keys, TheObjectGrowsAndShrinks) {
  start();
  const View first = view();
  const auto size = static_cast<double>(object(first).pixels);
  ASSERT_GT(size, 1000);
  press("F6", "0.5 times");
  const View half = changedFrom(first);
  EXPECT_NEAR(static_cast<double>(object(half).pixels) / size, 0.25, 0.1);
  press("F5", "2 times");
  expectAgain(first);
  press("F7", "1.1 times");
  const View larger = changedFrom(first);
  EXPECT_NEAR(static_cast<double>(object(larger).pixels) / size, 1.21, 0.15);
  press("F8", "0.91 times");
  EXPECT_NEAR(static_cast<double>(object(changedFrom(larger)).pixels) / size, 1.0, 0.02);
}

TEST_F(Keys, ArrowsMoveTheObjectAndItsShadowInActionMode) {
  start();
  const View first = view();
  display().act({"key", "Left"});  // the camera's, in viewer mode
  EXPECT_GT(differing(first, changedFrom(first)), 5000u);
  enterAction();
  EXPECT_THAT(demo().said(), Not(HasSubstr("moved")));
  const View here = view();
  const Spot middle = object(here);
  const auto moved = [&](const std::string& key, const std::string& back) {
    press(key, "moved");
    const View there = changedFrom(here);
    std::size_t beside = 0;  // the shadow
    for (int y = 0; y < here.picture.height(); ++y)
      for (int x = 0; x < here.picture.width(); ++x)
        beside += !(here.picture(x, y) == there.picture(x, y)) && !isOrange(here.picture(x, y)) &&
                  !isOrange(there.picture(x, y));
    EXPECT_GT(beside, 200u) << key;
    press(back, "moved");
    expectAgain(here);
    return object(there);
  };
  EXPECT_LT(moved("Left", "Right").x, middle.x - 2);
  EXPECT_GT(moved("Right", "Left").x, middle.x + 2);
  EXPECT_LT(moved("Up", "Down").y, middle.y - 2);
  EXPECT_GT(moved("Down", "Up").y, middle.y + 2);
  EXPECT_LT(moved("Prior", "Next").pixels, middle.pixels);
  EXPECT_GT(moved("Next", "Prior").pixels, middle.pixels);
}

TEST_F(Keys, TheSecondObjectComesAndGoes) {
  start();
  const View one = view();
  press("o", "second object added");
  const auto isGreen = [](const image::Rgb8& p) { return p.g > 1.2 * p.r && p.g > 1.2 * p.b; };
  EXPECT_GT(changedFrom(one).count(isGreen), one.count(isGreen) + 100);
  press("o", "second object removed");
  expectAgain(one);
}

TEST_F(Keys, WhatIsExportedCanBeShown) {
  start();
  press("v", "written to");
  press("x", "written to");
  const std::string volumes = textOf(folder() / "ShadowVolumes.iv"), scene = textOf(folder() / "SceneRoot.iv");
  EXPECT_THAT(volumes, HasSubstr("#Inventor"));
  EXPECT_THAT(scene, HasSubstr("QuadMesh"));
  EXPECT_GT(scene.size(), volumes.size());
  press("1", "removed");
  press("v", "error");  // no light, no volumes
  const View before = view();
  start({"-f", (folder() / "SceneRoot.iv").string()});
  EXPECT_GT(differing(before, view()), 1000u);
}

TEST_F(Keys, EscapeAndSeekChangeTheMode) {
  start();
  press("Escape", "mode: action");
  EXPECT_THAT(display().act({"search", "--name", "Umbrage shadows demo: action"}), HasSubstr("\n"));
  press("Escape", "mode: viewer");
  EXPECT_THAT(display().act({"search", "--name", "Umbrage shadows demo: viewer"}), HasSubstr("\n"));
  const View far = view();
  press("s", "mode: seek");
  const Spot middle = object(far);
  display().act(
      {"mousemove", std::to_string(36 + int(middle.x) - 14), std::to_string(2 + int(middle.y) + 12), "click", "1"});
  ASSERT_TRUE(hears("mode: viewer")) << demo().said();
  // The camera takes a moment to get there.
  EXPECT_TRUE(eventually([&] { return object(view()).pixels > 2 * middle.pixels; }));
}

}  // namespace
}  // namespace umbrage::demo_test
