#include <gmock/gmock.h>

#include <fstream>

#include "umbrage/png/png.hpp"
#include "viewer.hpp"

// Windows and files.
namespace umbrage::demo_test {
namespace {

using Windows = ViewerTest;

TEST_F(Windows, TwoOnOneSceneBothHaveTheirShadows) {
  start({"--windows", "2"});
  const int right = Display::kWidth - kWidth;
  std::string second;
  ASSERT_TRUE(eventually([&] {
    second = display().act({"search", "--name", "Umbrage shadows demo 2"});
    return second.size() > 1;
  }));
  second.erase(second.find('\n'));
  display().act({"windowmove", second, std::to_string(right), "0"});
  // Both are there when the object is seen in both.
  ASSERT_TRUE(eventually([&] { return object(view(0)).pixels > 1000 && object(view(right)).pixels > 1000; }));
  const View shadowed[] = {view(0), view(right)};
  EXPECT_GT(differing(shadowed[0], shadowed[1]), 5000u);  // from two sides
  press("F1", "shadows off");
  EXPECT_GT(differing(shadowed[0], changedFrom(shadowed[0], 0)), 1500u);
  EXPECT_GT(differing(shadowed[1], changedFrom(shadowed[1], right)), 1500u);
  press("F1", "shadows on");
  expectAgain(shadowed[0], 0);
  expectAgain(shadowed[1], right);
  press("F2", "z-fail");
  press("2", "point light 2 added");
  for (const int i : {0, 1})
    EXPECT_TRUE(eventually([&] { return differing(shadowed[i], view(i == 0 ? 0 : right)) > 1500; })) << i;
}

TEST_F(Windows, AModelIsShownInTheRoomWithoutItsOwnCameraAndLights) {
  const auto model = folder() / "model.iv";
  std::ofstream(model)
      << "#Inventor V2.1 ascii\n"
         "Separator { PerspectiveCamera { position 0 0 900 } DirectionalLight { color 0 1 0 }\n"
         "  Material { diffuseColor 0.1 0.1 0.9 } Translation { translation 500 0 0 } Cone { height 90 "
         "bottomRadius 30 } }\n";
  start({"-f", model.string()});
  const auto isBlue = [](const image::Rgb8& p) { return p.b > 60 && p.b > 2 * p.r && p.b > 2 * p.g; };
  const View shown = view();
  EXPECT_GT(shown.count(isBlue), 300u);
  EXPECT_EQ(object(shown).pixels, 0u);
  press("F1", "off");
  EXPECT_GT(differing(shown, changedFrom(shown)), 500u);
}

TEST_F(Windows, AVrmlModelIsShown) {
  const auto model = folder() / "model.wrl";
  std::ofstream(model) << "#VRML V2.0 utf8\nPointLight { location 0 5 0 }\nViewpoint { position 0 0 9 }\n"
                          "Shape { appearance Appearance { material Material { diffuseColor 0.9 0.3 0.1 } } geometry "
                          "Box { size 2 3 2 } }\n";
  start({"-f", model.string()});
  EXPECT_GT(object(view()).pixels, 1000u);
}

TEST_F(Windows, KeysCanBePressedAtTheBeginning) {
  start();
  const View one = view();
  press("2", "added");
  const View two = changedFrom(one);
  start({"--press", "2"});
  expectAgain(two);
}

TEST_F(Windows, ThePictureOptionWritesTheWindowAndEnds) {
  const auto file = folder() / "window.png";
  Process demo({UMBRAGE_DEMO, "--size", "400x300", "--picture", file.string()}, display().environment(),
               folder() / "said");
  EXPECT_EQ(demo.wait(), 0) << demo.said();
  const auto picture = png::read(file);
  ASSERT_TRUE(picture) << picture.error().text();
  EXPECT_EQ(picture->width(), 400);
  EXPECT_EQ(picture->height(), 300);
  std::size_t orange = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x) orange += isOrange({(*picture)(x, y).r, (*picture)(x, y).g, (*picture)(x, y).b});
  EXPECT_GT(orange, 300u);
}

}  // namespace
}  // namespace umbrage::demo_test
