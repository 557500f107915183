// What a volume for every triangle costs, and what it did to counters of 8 bits.
#include "umbrage/techniques/gl/volumes_brute.hpp"

#include <gtest/gtest.h>

#include "support/shapes.hpp"
#include "umbrage/techniques/gl/zfail.hpp"

namespace umbrage::techniques {
namespace {

using render::Overflow;
using render::VolumeOptions;
using Make = std::unique_ptr<render::GlTechnique> (*)(std::shared_ptr<gl::Context>, const VolumeOptions&);

// A long plank over the ground, in so many cells, seen along its length.
scene::Scene plank(int cells) {
  return scene::withGround(shapes::scene({shapes::grid(cells, 1, false, false,
                                                       [](double u, double v) { return Vec3(10 * u, v - 0.5, 1.0); })}),
                           0.0);
}
scene::Camera alongIt() {
  scene::Camera camera;
  camera.eye = {-2.0, 0.0, 0.55}, camera.target = {5.0, 0.0, 0.0};
  camera.width = 96, camera.height = 54;
  return camera;
}
const scene::Light kSun{scene::DirectionalLight{{0.01, 0.02, -1.0}}, Vec3(1.0), 1.0, ""};

class Counters : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gl::Context::createHeadless();
    if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
    context_ = *context;
  }
  shadow::Shading shade(Make make, Overflow overflow, const scene::Scene& scene) const {
    auto technique = make(context_, {.overflow = overflow});
    EXPECT_TRUE(technique->prepare(shadow::makeGeometry(scene)));
    auto shading =
        technique->shade({.camera = alongIt(), .lights = std::span(&kSun, 1), .fill = shadow::VolumeFill::plain});
    EXPECT_TRUE(shading);
    return std::move(*shading);
  }
  static std::size_t differing(const shadow::Shading& a, const shadow::Shading& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.masks[0].light.size(); ++i)
      count += a.masks[0].light.pixels()[i] != b.masks[0].light.pixels()[i];
    return count;
  }
  std::shared_ptr<gl::Context> context_;
};

// One layer of shadow, and 600 sides to look through: no silhouette, no shadow.
TEST_F(Counters, ThatSaturateLoseTheShadowOfManyTrianglesAndKeepThatOfASilhouette) {
  const scene::Scene scene = plank(300);
  const auto exact = shade(makeVolumesBrute, Overflow::none, scene);
  const auto dark = std::count(exact.masks[0].light.pixels().begin(), exact.masks[0].light.pixels().end(), 0);
  ASSERT_GT(dark, 100);
  EXPECT_EQ(differing(exact, shade(makeZFail, Overflow::none, scene)), 0u);
  EXPECT_EQ(differing(exact, shade(makeZFail, Overflow::saturates, scene)), 0u);
  EXPECT_EQ(differing(exact, shade(makeVolumesBrute, Overflow::wraps, scene)), 0u);
  EXPECT_GT(differing(exact, shade(makeVolumesBrute, Overflow::saturates, scene)), 100u);
}

TEST_F(Counters, ThatSaturateAreRightForFewTriangles) {
  const scene::Scene scene = plank(40);
  EXPECT_EQ(
      differing(shade(makeVolumesBrute, Overflow::none, scene), shade(makeVolumesBrute, Overflow::saturates, scene)),
      0u);
}

// A silhouette does not help where there really are 256 layers.
TEST_F(Counters, ThatWrapLightWhatIsIn256Shadows) {
  std::vector<shapes::Mesh> sheets;
  for (int i = 0; i < 256; ++i) {
    const double z = 1.0 + 0.01 * i;
    sheets.push_back(shapes::quad({0, -1, z}, {9, -1, z}, {9, 1, z}, {0, 1, z}));
  }
  const scene::Scene scene = scene::withGround(shapes::scene(std::move(sheets)), 0.0);
  for (const Make make : {Make(makeZFail), Make(makeVolumesBrute)}) {
    const auto exact = shade(make, Overflow::none, scene);
    EXPECT_NE(exact.stats.lights[0].reason.find("groups"), std::string::npos);
    EXPECT_GT(differing(exact, shade(make, Overflow::wraps, scene)), 100u);
  }
}

TEST_F(Counters, ThatAreNotExactSayIt) {
  const auto wraps = shade(makeZFail, Overflow::wraps, plank(2)),
             stops = shade(makeZFail, Overflow::saturates, plank(2));
  EXPECT_NE(wraps.stats.lights[0].reason.find("wrap"), std::string::npos);
  EXPECT_NE(stops.stats.lights[0].reason.find("stop at 255"), std::string::npos);
}

TEST_F(Counters, SeeManyTimesTheSidesWithoutASilhouette) {
  const scene::Scene scene = plank(100);
  const auto brute = shade(makeVolumesBrute, Overflow::none, scene), zfail = shade(makeZFail, Overflow::none, scene);
  EXPECT_EQ(brute.stats.lights[0].silhouetteEdges, 600u);
  EXPECT_EQ(zfail.stats.lights[0].silhouetteEdges, 202u);
  EXPECT_TRUE(brute.stats.lights[0].finder.empty());
}

}  // namespace
}  // namespace umbrage::techniques
