#include <gtest/gtest.h>

#include "support/shapes.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::techniques {
namespace {

struct Picture {
  image::RgbImage rgb;
  image::Image<std::uint32_t> triangle;
};

constexpr std::uint32_t kBallTriangles = 2 * 24 * 11;  // the scene's first

/// A coarse ball over a floor, lit from the side.
Picture ball(bool smooth, bool hide) {
  const scene::Scene scene = shapes::scene(
      {shapes::sphere({0, 0, 1}, 1, 24, 12), shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})});
  const auto geometry = shadow::makeGeometry(scene);
  scene::Camera camera;
  camera.eye = {2.5, -4, 2}, camera.target = {0, 0, 0.9}, camera.up = {0, 0, 1};
  camera.width = 320, camera.height = 240;
  const std::vector<scene::Light> lights{{scene::DirectionalLight{{1, 0.2, -0.7}}}};
  const auto technique = cpuTechniques().front().create();
  EXPECT_TRUE((*technique)->prepare(geometry));
  const auto shading = (*technique)->shade({.camera = camera, .lights = lights});
  const auto normals = shadow::smoothNormals(geometry->surfaces, Angle::degrees(40));
  return {shadow::composite(scene, geometry->surfaces, camera, *shading, lights,
                            {.smooth = smooth ? &normals : nullptr, .hideTerminator = hide}),
          shading->surface.triangle};
}

/// Neighbours on the ball that differ by more than smooth shading explains.
std::size_t jumps(const Picture& p) {
  std::size_t count = 0;
  const auto onBall = [&](int x, int y) { return p.triangle(x, y) < kBallTriangles; };
  for (int y = 2; y + 2 < p.rgb.height(); ++y)
    for (int x = 2; x + 2 < p.rgb.width(); ++x) {
      if (!onBall(x - 2, y) || !onBall(x + 2, y) || !onBall(x, y - 2) || !onBall(x, y + 2)) continue;
      count += std::abs(int(p.rgb(x, y).r) - int(p.rgb(x + 1, y).r)) > 10 ||
               std::abs(int(p.rgb(x, y).r) - int(p.rgb(x, y + 1).r)) > 10;
    }
  return count;
}

TEST(Terminator, OfSmoothShadingShowsNoFacetsWhenHidden) {
  const Picture plain = ball(true, false), hidden = ball(true, true);
  std::printf("%zu jumps, %zu when hidden\n", jumps(plain), jumps(hidden));
  EXPECT_GT(jumps(plain), 50u);
  EXPECT_LT(jumps(hidden), jumps(plain) / 10);
  // What is flat, and the shadow on it, stay as they are.
  std::size_t changed = 0;
  for (std::size_t i = 0; i < plain.rgb.size(); ++i)
    changed += plain.triangle.pixels()[i] >= kBallTriangles && plain.rgb.pixels()[i] != hidden.rgb.pixels()[i];
  EXPECT_EQ(changed, 0u);
}

}  // namespace
}  // namespace umbrage::techniques
