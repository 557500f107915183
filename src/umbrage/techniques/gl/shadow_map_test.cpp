// Shadow maps: their error against the truth is a number, and it falls as it should.
#include "umbrage/techniques/gl/shadow_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/shapes.hpp"
#include "support/village.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/gl/read_back.hpp"
#include "umbrage/image/compare.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/techniques/gl/shadow_map_perspective.hpp"
#include "umbrage/techniques/gl/zfail.hpp"

namespace umbrage::techniques {
namespace {

using namespace support;

using Make = std::unique_ptr<render::GlTechnique> (*)(std::shared_ptr<gl::Context>, const render::ShadowMapOptions&);

// ---- scenes ----

struct Stage {
  const char* name;
  std::shared_ptr<const shadow::Geometry> geometry;
  scene::Camera camera;
  scene::Light light;
};

scene::Camera camera(const Vec3& eye, const Vec3& target) {
  scene::Camera c = cameraFrom(eye, target);
  c.width = 480, c.height = 270;
  return c;
}

// Two rows of columns under beams that run away from the eye, the sun overhead.
Stage colonnade(int pairs) {
  std::vector<mesh::Mesh> parts;
  for (int i = 0; i < pairs; ++i)
    for (const double x : {-2.0, 1.7}) parts.push_back(shapes::box({x, 2.0 * i, 0}, {x + 0.3, 2.0 * i + 0.3, 3}));
  for (const double x : {-2.0, 1.7}) parts.push_back(shapes::box({x, 0, 3}, {x + 0.3, 2.0 * pairs, 3.3}));
  for (int i = 0; i < pairs; ++i) parts.push_back(shapes::box({-2.5, 2.0 * i + 0.1, 3.3}, {2.5, 2.0 * i + 0.25, 3.4}));
  return {"colonnade", shadow::makeGeometry(scene::withGround(shapes::scene(std::move(parts)), 0.0)),
          camera({0.1, -3.0, 1.7}, {0, 20, 1.0}), {scene::DirectionalLight{{0.5, 0.15, -1.0}}}};
}

Stage villageInTheSun() {
  return {"village", shadow::makeGeometry(village()), camera({9, -11, 7}, {0, 1, 1}), {scene::DirectionalLight{{0.5, 0.3, -0.8}}}};
}

Stage knotUnderALamp() {
  return {"knot", shadow::makeGeometry(scene::withGround(shapes::scene({shapes::knot({0, 0, 2}, 1.5, 0.3, 128, 12)}), 0.0)),
          camera({4, -5, 4}, {0, 0, 1}), {scene::PointLight{{1.5, -2.0, 6.0}}}};
}

// ---- errors ----

class ShadowMaps : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gl::Context::createHeadless();
    if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
    context_ = *context;
  }

  shadow::Shading shade(render::GlTechnique& technique, const Stage& stage) const {
    EXPECT_TRUE(technique.prepare(stage.geometry));
    auto shading = technique.shade({stage.camera, {&stage.light, 1}});
    EXPECT_TRUE(shading);
    return std::move(*shading);
  }
  // By shadow volumes, which every conformance scene holds against rays.
  shadow::LightMask truth(const Stage& stage) const { return shade(*makeZFail(context_), stage).masks[0]; }
  shadow::Shading mapped(Make make, const Stage& stage, const render::ShadowMapOptions& options) const {
    return shade(*make(context_, options), stage);
  }
  static std::size_t wrong(const shadow::LightMask& mask, const shadow::LightMask& truth) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < truth.light.size(); ++i) count += mask.light.pixels()[i] != truth.light.pixels()[i];
    return count;
  }
  std::shared_ptr<gl::Context> context_;
};

TEST_F(ShadowMaps, ErrorFallsAsTheMapGrows) {
  for (const Stage& stage : {villageInTheSun(), knotUnderALamp(), colonnade(12)}) {
    const shadow::LightMask expected = truth(stage);
    for (const Make make : {makeShadowMap, makePerspectiveShadowMap}) {
      std::vector<double> errors;
      for (int texels = 256; texels <= 4096; texels *= 2)
        errors.push_back(double(wrong(mapped(make, stage, {.texels = texels, .filter = 0}).masks[0], expected)));
      std::printf("%-10s %-11s", stage.name, make == makeShadowMap ? "uniform" : "perspective");
      for (const double e : errors) std::printf(" %8.3f %%", 100.0 * e / double(expected.light.size()));
      std::printf("\n");
      for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], errors[i - 1]) << stage.name << " " << i;
    }
  }
}

}  // namespace
}  // namespace umbrage::techniques
