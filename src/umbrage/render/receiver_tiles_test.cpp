#include "umbrage/render/receiver_tiles.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace umbrage::render {
namespace {

// 64 x 32 pixels, looking along +y; depth = distance along y.
View viewAlongY() {
  scene::Camera camera;
  camera.eye = {0, 0, 0};
  camera.target = {0, 1, 0};
  camera.fovY = Angle::degrees(90);
  camera.width = 64;
  camera.height = 32;
  return viewOf(camera, 1.0);
}

float depthAt(double distance) { return static_cast<float>(viewAlongY().nearDistance / distance); }

// Receivers at 4 to 10 in the left half of the picture, none in the right half.
ReceiverTiles tiles() {
  image::Image<Vec2f> depths(4, 2, Vec2f(2.0f, -1.0f));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) depths(x, y) = {depthAt(10), depthAt(4)};
  return {viewAlongY(), depths, 64, 32};
}

// A small square at a distance along the view, `x` of it to the right.
std::vector<Vec4> square(double x, double distance, double size = 0.1) {
  return {{x, distance, 0, 1}, {x + size, distance, 0, 1}, {x, distance, size, 1}, {x + size, distance, size, 1}};
}

TEST(ReceiverTiles, AreFoundFromPixelsThatFaceTheLight) {
  image::Image<std::uint32_t> ids(33, 18, ~std::uint32_t{0});
  image::Image<float> depths(33, 18, 0.0f);
  const auto set = [&](int x, int y, std::uint32_t id, float depth) { ids(x, y) = id, depths(x, y) = depth; };
  set(0, 17, 1, 0.5f);    // the lower left tile
  set(15, 2, 1, 0.25f);   // its uppermost row, for tiles are counted from the bottom
  set(3, 5, 0, 0.9f);     // turned away
  set(32, 1, 1, 0.125f);  // the narrow and flat tile in the upper right
  const std::vector<std::uint8_t> facing{0, 1};
  const auto tiles = receiverDepths(ids, depths, facing);
  ASSERT_EQ(tiles.width(), 3);
  ASSERT_EQ(tiles.height(), 2);
  EXPECT_EQ(tiles(0, 1), Vec2f(0.25f, 0.5f));
  EXPECT_EQ(tiles(1, 1), Vec2f(2.0f, -1.0f));
  EXPECT_EQ(tiles(2, 0), Vec2f(0.125f, 0.125f));
  EXPECT_EQ(tiles(0, 0), Vec2f(2.0f, -1.0f));
}

TEST(ReceiverTiles, TellWhatLiesBehindAndBefore) {
  const ReceiverTiles t = tiles();
  EXPECT_TRUE(t.behindAll(square(-5, 11)));
  EXPECT_FALSE(t.behindAll(square(-5, 9.9)));
  EXPECT_FALSE(t.beforeAll(square(-5, 9.9)));
  EXPECT_TRUE(t.beforeAll(square(-1, 3.9)));
  EXPECT_FALSE(t.beforeAll(square(-1, 4.1)));
}

TEST(ReceiverTiles, WithoutReceiversNothingCounts) {
  const ReceiverTiles t = tiles();
  EXPECT_TRUE(t.behindAll(square(5, 7)));
  EXPECT_TRUE(t.beforeAll(square(5, 7)));
  // Half a pixel from the border a snapped corner may reach into the other half.
  EXPECT_FALSE(t.behindAll(square(0.1, 7)));
}

TEST(ReceiverTiles, WithinRoundingNothingIsBehind) {
  EXPECT_FALSE(tiles().behindAll(square(-5, 10.005)));
  EXPECT_FALSE(tiles().beforeAll(square(-1, 3.999)));
}

TEST(ReceiverTiles, WhatIsNotInThePictureDoesNotCount) {
  const ReceiverTiles t = tiles();
  EXPECT_TRUE(t.behindAll(square(-500, 7)));
  EXPECT_TRUE(t.behindAll(square(-1, -7)));
  EXPECT_TRUE(t.beforeAll(square(0, -7)));
}

TEST(ReceiverTiles, WhatCrossesThePlaneOfTheEyeMayBeAnywhere) {
  const ReceiverTiles t = tiles();
  const std::array<Vec4, 3> through{Vec4(-1, -3, 0, 1), Vec4(-1, 20, 0, 1), Vec4(-1, 20, 1, 1)};
  EXPECT_FALSE(t.behindAll(through));
  const std::array<Vec4, 3> nearby{Vec4(-1, -3, 0, 1), Vec4(-1, 2, 0, 1), Vec4(-1, 2, 1, 1)};
  EXPECT_TRUE(t.beforeAll(nearby));
}

TEST(ReceiverTiles, HullsMayReachToInfinity) {
  const ReceiverTiles t = tiles();
  const std::array<Vec4, 3> away{Vec4(-5, 11, 0, 1), Vec4(-5, 11, 1, 1), Vec4(-0.4, 1, 0, 0)};
  EXPECT_TRUE(t.behindAll(away));
  EXPECT_FALSE(t.beforeAll(away));
  const std::array<Vec4, 3> back{Vec4(-5, 11, 0, 1), Vec4(-5, 11, 1, 1), Vec4(0.1, -1, 0, 0)};
  EXPECT_FALSE(t.behindAll(back));
}

}  // namespace
}  // namespace umbrage::render
