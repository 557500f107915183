#include "umbrage/render/depth_bounds.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

namespace umbrage::render {
namespace {

constexpr int kWidth = 160, kHeight = 90;
const std::vector<GroupPlan> kFromZero{{.eyeCount = 0, .passSides = true}};

gl::PassState placement() {
  gl::PassState state;
  state.viewport = {0, 0, kWidth, kHeight};
  return state;
}

View look(const Vec3& eye, const Vec3& target) {
  scene::Camera c;
  c.eye = eye;
  c.target = target;
  c.width = kWidth;
  c.height = kHeight;
  return viewOf(c, 10.0);
}

double number(int low, int high) { return *rc::gen::inRange(low * 16, high * 16) / 16.0; }
Vec3 point(int size) { return {number(-size, size), number(-size, size), number(-size, size)}; }

Box3 boxAround(const Vec3& a, const Vec3& b) {
  Box3 box;
  box.add(a);
  box.add(b);
  return box;
}

// The law, by points of the swept box itself.
RC_GTEST_PROP(VolumeDistances, HoldEveryPointOfTheSweptBoxWhereReceiversAre, ()) {
  const Vec3 eye = point(30), target = point(10), origin = point(20);
  RC_PRE(glm::length(eye - target) > 0.5);
  const View view = look(eye, target);
  const Box3 casters = boxAround(point(8), point(8));
  Box3 receivers = boxAround(point(20), point(20));
  receivers.add(casters.min);
  receivers.add(casters.max);
  receivers.add(eye - origin);
  const Vec4 light(point(20), number(0, 1) < 0.5 ? 0.0 : 1.0);
  RC_PRE(glm::length(Vec3(light)) > 0.1);
  const ViewDistances distances = volumeDistances(view, casters, receivers, light, origin);
  const auto bounds = depthBounds(view, placement(), distances, kFromZero);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = casters.min + casters.size() * Vec3(number(0, 1), number(0, 1), number(0, 1));
    const Vec3 swept = p + number(0, 30) * 0.2 * (p * light.w - Vec3(light));
    if (glm::any(glm::lessThan(swept, receivers.min)) || glm::any(glm::greaterThan(swept, receivers.max))) continue;
    const Vec4 clip = view.toClip * Vec4(swept + origin - eye, 1.0);
    if (clip.w <= 1e-6) continue;
    RC_ASSERT(clip.w >= distances.nearest);
    RC_ASSERT(clip.w <= distances.farthest);
    const auto stored = static_cast<float>(std::clamp(clip.z / clip.w, 0.0, 1.0));
    if (bounds) RC_ASSERT(stored >= (*bounds)[0] && stored <= (*bounds)[1]);
  }
}

// A host's own depth: ordinary, -1..1, in a part of the range.
TEST(DepthBounds, AreWhatTheHostsDepthBufferHolds) {
  const Mat4 rotated = glm::lookAt(Vec3(1, 2, 3), Vec3(0, 0, 0), Vec3(0, 0, 1));
  const View view = viewOf(rotated, glm::perspective(1.0, 1.5, 0.5, 100.0), false);
  gl::PassState host = placement();
  host.clipDepth = gl::ClipDepth::minusOneToOne;
  host.depthRange = {0.25f, 0.75f};
  const auto bounds = depthBounds(view, host, {0.5, 100.0}, kFromZero);
  ASSERT_TRUE(bounds);
  EXPECT_NEAR((*bounds)[0], 0.25, 1e-6);
  EXPECT_NEAR((*bounds)[1], 0.75, 1e-6);
  host.depthRange = {0.75f, 0.25f};
  const auto turned = depthBounds(view, host, {0.5, 2.0}, kFromZero);
  ASSERT_TRUE(turned);
  EXPECT_LT((*turned)[0], (*turned)[1]);
  EXPECT_NEAR((*turned)[1], 0.75, 1e-6);
}

TEST(DepthBounds, EndAFarBoundWhereTheCountDoesNotStartFromZero) {
  const View view = look({0, 0, 0}, {0, 1, 0});
  const auto at = [&](double d) { return static_cast<float>(view.nearDistance / d); };
  const auto both = depthBounds(view, placement(), {2.0, 8.0}, kFromZero);
  ASSERT_TRUE(both);
  EXPECT_FLOAT_EQ((*both)[0], at(8.0));
  EXPECT_FLOAT_EQ((*both)[1], at(2.0));
  const auto near = depthBounds(view, placement(), {2.0, 8.0}, {{.eyeCount = 1, .passSides = true}});
  ASSERT_TRUE(near);
  EXPECT_EQ((*near)[0], 0.0f);
  EXPECT_FALSE(depthBounds(view, placement(), {2.0, 8.0}, {{.nearCasters = true}}));
  EXPECT_FALSE(depthBounds(view, placement(), {}, kFromZero));
  const auto far = depthBounds(view, placement(), {0.0, 8.0}, kFromZero);
  ASSERT_TRUE(far);
  EXPECT_EQ((*far)[1], 1.0f);
}

TEST(VolumeDistances, EndAtTheReceiversAndAtTheEye) {
  const View view = look({0, 0, 0}, {0, 1, 0});
  const Box3 casters = boxAround({-1, 10, 2}, {1, 12, 3}), room = boxAround({-50, -1, -1}, {50, 60, 4});
  const ViewDistances down = volumeDistances(view, casters, room, {0, -1, 1, 0}, Vec3(0.0));
  EXPECT_NEAR(down.nearest, 10.0, 0.02);
  EXPECT_NEAR(down.farthest, 16.0, 0.03);  // 4 down, and as far along
  EXPECT_TRUE(std::isinf(volumeDistances(view, casters, {}, {0, -1, 1, 0}, Vec3(0.0)).farthest));
  EXPECT_EQ(volumeDistances(view, casters, {}, {0, 1, 1, 0}, Vec3(0.0)).nearest, 0.0);
}

}  // namespace
}  // namespace umbrage::render
