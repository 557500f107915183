#include "umbrage/render/view.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

#include "umbrage/render/uniforms.hpp"

namespace umbrage::render {
namespace {

constexpr int kWidth = 160, kHeight = 90;

gl::PassState placement() {
  gl::PassState state;
  state.viewport = {0, 0, kWidth, kHeight};
  return state;
}

scene::Camera camera(const Vec3& eye, const Vec3& target) {
  scene::Camera c;
  c.eye = eye;
  c.target = target;
  c.width = kWidth;
  c.height = kHeight;
  return c;
}

// The pixel, from the lower left, that a homogeneous point (relative to the eye) falls on.
Vec2 pixelOf(const View& view, const Vec4& p) {
  const Vec4 clip = view.toClip * p;
  return {(0.5 + 0.5 * clip.x / clip.w) * kWidth, (0.5 + 0.5 * clip.y / clip.w) * kHeight};
}

double number(int low, int high) { return *rc::gen::inRange(low * 16, high * 16) / 16.0; }
Vec3 point(int size) { return {number(-size, size), number(-size, size), number(-size, size)}; }

TEST(View, PutsPixelCentresWhereTheCameraLooks) {
  const scene::Camera c = camera({3, -7, 4}, {1, 2, 0});
  const View view = viewOf(c, 10.0);
  const scene::PixelRays rays = scene::pixelRays(c);
  const Vec2 p = pixelOf(view, Vec4(5.0 * rays.through(12.5, 30.5), 1.0));
  EXPECT_NEAR(p.x, 12.5, 1e-9);
  EXPECT_NEAR(kHeight - p.y, 30.5, 1e-9);
  const Vec4 clip = view.toClip * Vec4(7.0 * scene::basis(c).forward, 1.0);
  EXPECT_NEAR(depthToDistance(view, static_cast<float>(clip.z / clip.w)), 7.0, 1e-6);
  EXPECT_TRUE(std::isinf(depthToDistance(view, 0.0f)));
}

TEST(View, KnowsAMirrorImage) {
  EXPECT_FALSE(mirrors(viewOf(camera({3, -7, 4}, {1, 2, 0}), 1.0)));
  const Mat4 look = glm::lookAt(Vec3(1, 2, 3), Vec3(0, 0, 0), Vec3(0, 0, 1));
  const Mat4 lens = glm::perspective(1.0, 1.5, 0.1, 100.0);
  EXPECT_FALSE(mirrors(viewOf(look, lens, false)));
  EXPECT_TRUE(mirrors(viewOf(look, glm::scale(Mat4(1.0), Vec3(1, -1, 1)) * lens, false)));
  EXPECT_LT(glm::length(viewOf(look, lens, false).eye - Vec3(1, 2, 3)), 1e-12);
}

TEST(ViewBlock, KeepsTheEyeInTwoFloats) {
  View view;
  view.eye = Vec3(85000.123456789, -446000.987654321, 1.1);
  const ViewBlock block = viewBlock(view, Vec3(0.0), Vec4(0.0));
  const Vec3 sum = Vec3(Vec3f(block.eyeHigh)) + Vec3(Vec3f(block.eyeLow));
  EXPECT_LT(glm::length(sum - view.eye), 1e-9);
}

TEST(PackBits, PutsTheFirstFlagLowest) {
  const std::vector<std::uint8_t> flags{1, 0, 1};
  EXPECT_EQ(packBits(flags), std::vector<std::uint32_t>{5});
  EXPECT_EQ(packBits(std::vector<std::uint8_t>(33, 1)).back(), 1u);
}

// Every point of the swept box that is in front of the eye and in the picture lies in the area.
// Every point of the swept box that is among the receivers, in front of the eye and in the picture lies in the area.
RC_GTEST_PROP(VolumeArea, HoldsEveryPointOfTheSweptBox, ()) {
  const Vec3 eye = point(40);
  const Vec3 target = point(10);
  RC_PRE(glm::length(eye - target) > 0.5);
  const View view = viewOf(camera(eye, target), 10.0);
  const auto boxOf = [](const Vec3& centre, const Vec3& size) {
    Box3 box;
    box.add(centre);
    box.add(centre + size);
    return box;
  };
  const Box3 box = boxOf(point(10), Vec3(1, 2, 3));
  const bool bounded = *rc::gen::inRange(0, 3) > 0;
  const Box3 receivers = bounded ? boxOf(point(20), Vec3(number(0, 30), number(0, 30), number(0, 3))) : Box3{};
  const Vec3 origin = point(5);
  const Vec4 light(point(20), *rc::gen::inRange(0, 2));
  RC_PRE(glm::length(Vec3(light)) > 0.1);
  const gl::Rect area = volumeArea(view, box, receivers, light, origin, placement());
  const gl::Rect seen = bounded ? boxArea(view, receivers, origin, placement()) : placement().viewport;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = box.min + box.size() * Vec3(number(0, 1), number(0, 1), number(0, 1));
    const Vec3 swept = p + number(0, 50) * 0.2 * (p * light.w - Vec3(light));
    if (bounded && (glm::any(glm::lessThan(swept, receivers.min)) || glm::any(glm::greaterThan(swept, receivers.max))))
      continue;
    const Vec4 relative(swept + origin - eye, 1.0);
    if ((view.toClip * relative).w <= 1e-6) continue;
    const Vec2 pixel = pixelOf(view, relative);
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= kWidth || pixel.y >= kHeight) continue;
    RC_ASSERT(!gl::intersect(area, {int(pixel.x), int(pixel.y), 1, 1}).empty());
    RC_ASSERT(!gl::intersect(seen, {int(pixel.x), int(pixel.y), 1, 1}).empty());
  }
}

RC_GTEST_PROP(LitArea, HoldsEveryPointOfTheCone, ()) {
  const Vec3 eye = point(40);
  const Vec3 target = point(10);
  RC_PRE(glm::length(eye - target) > 0.5);
  const View view = viewOf(camera(eye, target), 10.0);
  scene::SpotLight spot{point(20), point(3), Angle::degrees(*rc::gen::inRange(1, 120))};
  RC_PRE(glm::length(spot.direction) > 0.1);
  const scene::Light light{spot};
  const gl::Rect area = litArea(view, light, placement());
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = spot.position + number(0, 30) * (glm::normalize(spot.direction) + number(0, 3) * point(1));
    if (!scene::insideCone(light, p)) continue;
    const Vec4 relative(p - eye, 1.0);
    if ((view.toClip * relative).w <= 1e-6) continue;
    const Vec2 pixel = pixelOf(view, relative);
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= kWidth || pixel.y >= kHeight) continue;
    RC_ASSERT(!gl::intersect(area, {int(pixel.x), int(pixel.y), 1, 1}).empty());
  }
}

TEST(VolumeArea, LeavesOutWhatTheShadowCannotReach) {
  // A box below the line of sight, lit from above: its shadow stays in the lower half.
  Box3 box;
  box.add(Vec3(-1, 10, -3));
  box.add(Vec3(1, 12, -2));
  const View view = viewOf(camera({0, 0, 0}, {0, 10, 0}), 10.0);
  const gl::Rect area = volumeArea(view, box, {}, Vec4(0, -1, 1, 0), Vec3(0.0), placement());
  EXPECT_FALSE(area.empty());
  EXPECT_LT(area.y + area.height, kHeight / 2);
  EXPECT_TRUE(volumeArea(view, Box3{}, {}, Vec4(0, -1, 1, 0), Vec3(0.0), placement()).empty());
  // Receivers just below the box end the shadow early.
  Box3 floor;
  floor.add(Vec3(-50, -50, -3.5));
  floor.add(Vec3(50, 50, -2));
  const gl::Rect ended = volumeArea(view, box, floor, Vec4(0, -1, 1, 0), Vec3(0.0), placement());
  EXPECT_LT(ended.height, area.height);
  // With the light in front, the volume comes at the eye.
  EXPECT_EQ(volumeArea(view, box, {}, Vec4(0, 1, 1, 0), Vec3(0.0), placement()), placement().viewport);
}

}  // namespace
}  // namespace umbrage::render
