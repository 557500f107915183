#include "umbrage/render/overlay.hpp"

#include <gtest/gtest.h>

#include "support/box_scene.hpp"

namespace umbrage::render {
namespace {

scene::Camera camera() {
  scene::Camera c;
  c.eye = {6, -9, 5};
  c.target = {0, 1, 1};
  c.width = 160;
  c.height = 90;
  return c;
}

std::size_t changed(const image::RgbImage& a, const image::RgbImage& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a.pixels()[i] != b.pixels()[i];
  return count;
}

TEST(Overlay, DrawsWhatIsAskedForAndNothingElse) {
  const auto geometry = shadow::makeGeometry(scene::withGround(support::boxScene({{"tower", {0, 0, 0}, {1, 1, 3}}})));
  const scene::Light sun{scene::DirectionalLight{{0.8, 0.1, -0.6}}};
  const image::RgbImage grey(160, 90, {120, 120, 120});
  const auto draw = [&](const OverlayOptions& options) {
    return drawOverlay(grey, *geometry, camera(), std::span(&sun, 1), options);
  };
  const auto nothing = draw({});
  if (!nothing && nothing.error().code == ErrorCode::device) GTEST_SKIP() << "no graphics: " << nothing.error().text();
  ASSERT_TRUE(nothing);
  EXPECT_EQ(*nothing, grey);
  const auto lines = draw({.silhouette = true});
  const auto volumes = draw({.volumes = true});
  ASSERT_TRUE(lines && volumes);
  // Lines are thin, faces are not, and both leave most of the picture alone.
  EXPECT_GT(changed(grey, *lines), 50u);
  EXPECT_GT(changed(grey, *volumes), 2 * changed(grey, *lines));
  EXPECT_LT(changed(grey, *volumes), grey.size() / 2);
}

TEST(Overlay, IsHiddenBehindSurfaces) {
  // The box stands behind a wall that casts nothing.
  scene::Scene s = support::boxScene({{"box", {0, 5, 0}, {1, 6, 1}}, {"wall", {-9, 0, -9}, {9, 1, 9}}});
  s.instances[1].casts = false;
  const auto geometry = shadow::makeGeometry(s);
  const scene::Light sun{scene::DirectionalLight{{0, 1, -0.5}}};
  const image::RgbImage grey(160, 90, {120, 120, 120});
  const auto drawn = drawOverlay(grey, *geometry, camera(), std::span(&sun, 1), {.volumes = true, .silhouette = true});
  if (!drawn && drawn.error().code == ErrorCode::device) GTEST_SKIP() << "no graphics: " << drawn.error().text();
  ASSERT_TRUE(drawn);
  EXPECT_EQ(*drawn, grey);
}

}  // namespace
}  // namespace umbrage::render
