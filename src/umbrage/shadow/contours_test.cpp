#include "umbrage/shadow/contours.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrage::shadow {
namespace {

// A square in the plane z = 0 of two triangles, with half the side `half`, and a wall on its far border y = half.
scene::Surfaces squareAndWall(float half, bool wall) {
  scene::Surfaces s;
  s.positions = {{-half, -half, 0}, {-half, half, 0}, {half, -half, 0},
                 {half, half, 0},   {-half, half, 2}, {half, half, 2}};
  s.triangles = {{0, 1, 2}, {1, 2, 3}};
  if (wall) {
    s.triangles.push_back({1, 4, 3});  // sorted: (-half, half, 0) < (-half, half, 2) < (half, half, 0)
    s.triangles.push_back({4, 3, 5});
  }
  return s;
}

// From straight above the square: one unit is 100 pixels.
scene::Camera above() {
  scene::Camera c;
  c.eye = {0, 0, 10}, c.target = {0, 0, 0}, c.up = {0, 1, 0};
  c.width = c.height = 400;
  c.fovY = Angle::radians(2.0 * std::atan(0.2));
  return c;
}

scene::Light lampAt(const Vec3& p) { return {scene::PointLight{p}, Vec3(1.0), 1.0, ""}; }

TEST(Contours, RunAlongBordersAndNotAlongDiagonals) {
  const scene::Surfaces s = squareAndWall(1.0f, false);
  const Contours contours(s);
  const auto lamp = lampAt({0, 0, 5});
  EXPECT_TRUE(contours.near(above(), lamp, 200, 200, 5).empty()) << "on the diagonal";
  const auto border = contours.near(above(), lamp, 303, 200, 5);  // x = 1 is at 300
  ASSERT_EQ(border.size(), 1u);
  EXPECT_NEAR(border[0].x, 300, 1e-9);
  EXPECT_NEAR(border[0].y, 200, 1e-9);
  EXPECT_NEAR(glm::length(border[0].fromEye - Vec3(1, 0, -10)), 0, 1e-12);
  EXPECT_TRUE(contours.near(above(), lamp, 303, 200, 2.9).empty());
  EXPECT_EQ(contours.near(above(), lamp, 304, 97, 5).size(), 2u) << "two borders meet in a corner, 5 pixels off";
}

// The crease between floor and wall, seen from inside and from behind the wall.
TEST(Contours, RunAlongTheCreaseOnlyWhereOneOfItsFacesTurnsAway) {
  const scene::Surfaces s = squareAndWall(1.0f, true);
  const Contours contours(s);
  scene::Camera camera = above();
  camera.eye = {0, -1, 10};
  camera.target = {0, 1, 0};
  EXPECT_TRUE(contours.near(camera, lampAt({0, 0, 5}), 200, 200, 1).empty());
  EXPECT_EQ(contours.near(camera, lampAt({0, 3, 5}), 200, 200, 1).size(), 1u) << "the lamp sees the wall from behind";
  camera.eye = {0, 3, 10};
  EXPECT_EQ(contours.near(camera, lampAt({0, 0, 5}), 200, 200, 1).size(), 1u) << "the eye does";
}

TEST(Contours, BehindTheEyeAreNotInThePicture) {
  const scene::Surfaces s = squareAndWall(1.0f, true);
  scene::Camera camera = above();
  camera.target = {0, 0, 20};
  EXPECT_TRUE(Contours(s).near(camera, lampAt({0, 0, 5}), 200, 200, 1e9).empty());
}

}  // namespace
}  // namespace umbrage::shadow
