#include "umbrage/render/near_rectangle.hpp"

#include <gtest/gtest.h>

namespace umbrage::render {
namespace {

View view() {
  scene::Camera camera;
  camera.eye = {3, -2, 5};
  camera.target = {4, 1, 4.5};
  camera.fovY = Angle::degrees(50);
  return viewOf(camera, 10.0);
}

constexpr double kDistance = 0.01;

// A point of the rectangle, relative to the eye, by its place in the picture.
Vec3 onRectangle(const View& v, double x, double y) {
  return glm::inverse(glm::transpose(Mat3(Vec3(v.toClip[0][0], v.toClip[1][0], v.toClip[2][0]),
                                          Vec3(v.toClip[0][1], v.toClip[1][1], v.toClip[2][1]),
                                          Vec3(v.toClip[0][3], v.toClip[1][3], v.toClip[2][3])))) *
         (kDistance * Vec3(x, y, 1.0));
}

bool isInside(const Vec4& clip) {
  return std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && 0.0 <= clip.z && clip.z <= clip.w;
}

TEST(NearRectangle, ShowsWhatLiesBetweenItAndTheLightOnThePixelsBehind) {
  const View v = view();
  for (const Vec4& light : {Vec4(5, 4, 9, 1), Vec4(-3, -6, 2, 1), Vec4(0.3, 0.4, 0.8, 0), Vec4(-0.5, -0.6, -0.2, 0)}) {
    const auto m = throughNearRectangle(v, kDistance, light, 50.0);
    ASSERT_TRUE(m);
    for (const double x : {-0.9, 0.1, 0.7})
      for (const double y : {-0.8, 0.3}) {
        const Vec3 q = onRectangle(v, x, y), way = Vec3(light) - q * light.w;
        for (const double t : {0.01, 0.4, 0.95}) {
          const Vec4 clip = *m * Vec4(q + t * way, 1.0);
          EXPECT_TRUE(isInside(clip));
          EXPECT_NEAR(clip.x / clip.w, x, 1e-9);
          EXPECT_NEAR(clip.y / clip.w, y, 1e-9);
        }
        EXPECT_FALSE(isInside(*m * Vec4(q - 0.01 * way, 1.0)));  // beyond the rectangle
        if (light.w != 0.0) {
          EXPECT_FALSE(isInside(*m * Vec4(q + 1.01 * way, 1.0)));  // beyond the light
        }
      }
    EXPECT_FALSE(
        isInside(*m * Vec4(onRectangle(v, 1.1, 0) + 0.3 * (Vec3(light) - onRectangle(v, 1.1, 0) * light.w), 1.0)));
  }
}

TEST(NearRectangle, DegeneratesForLightsThatShineAlongItOrLieAtTheEye) {
  const View v = view();
  const Vec3 across = glm::normalize(Vec3(v.toClip[0][0], v.toClip[1][0], v.toClip[2][0]));
  EXPECT_FALSE(throughNearRectangle(v, kDistance, Vec4(across, 0.0), 50.0));
  EXPECT_FALSE(throughNearRectangle(v, kDistance, Vec4(9.0 * across, 1.0), 50.0));
  EXPECT_FALSE(throughNearRectangle(v, kDistance, Vec4(0.1, 0.2, 0.1, 1.0), 50.0));
}

TEST(NearRectangle, CoversEveryPixelOnceWithTwoTrianglesThatShareAnEdge) {
  const View v = view();
  const Vec4 light(5, 4, 9, 1);
  const auto m = throughNearRectangle(v, kDistance, light, 50.0);
  ASSERT_TRUE(m);
  // A square across the way from the middle of the rectangle to the light; its diagonal crosses the picture.
  const Vec3 middle = 0.5 * (onRectangle(v, 0, 0) + Vec3(light)),
             u = glm::normalize(glm::cross(Vec3(light), Vec3(1, 2, 0))), w = glm::normalize(glm::cross(u, Vec3(light)));
  const std::array<Vec3, 4> corner{middle - 3.0 * u, middle - 3.0 * w, middle + 3.0 * u, middle + 3.0 * w};
  std::vector<Vec4f> seen;
  appendSeen(*m, {corner[0], corner[1], corner[2]}, seen);
  appendSeen(*m, {corner[0], corner[2], corner[3]}, seen);
  double area = 0.0;
  for (std::size_t i = 0; i < seen.size(); i += 3) {
    const Vec2f a(seen[i]), b(seen[i + 1]), c(seen[i + 2]);
    area += 0.5 * std::abs(double((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
  }
  EXPECT_NEAR(area, 2.5 * 2.5, 1e-5);
  seen.clear();
  appendSeen(*m, {Vec3(1.0, 2.0, -9.0), Vec3(2.0, 2.0, -9.0), Vec3(1.0, 3.0, -9.0)}, seen);
  EXPECT_TRUE(seen.empty());
}

TEST(NearRectangle, CornersAreWithinTheRadius) {
  const View v = view();
  const double distance = nearRectangleDistance(v, 2.0);
  EXPECT_NEAR(glm::length(onRectangle(v, 1, -1)) / kDistance * distance, 2.0, 1e-9);
}

}  // namespace
}  // namespace umbrage::render
