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
  return {"colonnade",
          shadow::makeGeometry(scene::withGround(shapes::scene(std::move(parts)), 0.0)),
          camera({0.1, -3.0, 1.7}, {0, 20, 1.0}),
          {scene::DirectionalLight{{0.5, 0.15, -1.0}}}};
}

Stage villageInTheSun() {
  return {"village",
          shadow::makeGeometry(village()),
          camera({9, -11, 7}, {0, 1, 1}),
          {scene::DirectionalLight{{0.5, 0.3, -0.8}}}};
}

Stage knotUnderALamp() {
  return {"knot",
          shadow::makeGeometry(scene::withGround(shapes::scene({shapes::knot({0, 0, 2}, 1.5, 0.3, 128, 12)}), 0.0)),
          camera({4, -5, 4}, {0, 0, 1}),
          {scene::PointLight{{1.5, -2.0, 6.0}}}};
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

double percent(std::size_t wrong, const shadow::LightMask& of) {
  return 100.0 * double(wrong) / double(of.light.size());
}

TEST_F(ShadowMaps, ErrorFallsAsTheMapGrows) {
  for (const Stage& stage : {villageInTheSun(), knotUnderALamp(), colonnade(40)}) {
    const shadow::LightMask expected = truth(stage);
    for (const Make make : {makeShadowMap, makePerspectiveShadowMap}) {
      std::vector<std::size_t> errors;
      for (int texels = 256; texels <= 4096; texels *= 2)
        errors.push_back(wrong(mapped(make, stage, {.texels = texels, .filter = 0}).masks[0], expected));
      std::printf("%-10s %-11s", stage.name, make == makeShadowMap ? "uniform" : "perspective");
      for (const std::size_t e : errors) std::printf(" %8.3f %%", percent(e, expected));
      std::printf("\n");
      for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], errors[i - 1]) << stage.name << " " << i;
      // Borders are as wrong as texels are wide: a sixteenth, if all were borders.
      EXPECT_LT(8 * errors.back(), errors.front()) << stage.name;
    }
  }
}

TEST_F(ShadowMaps, PerspectiveBeatsUniformInADeepScene) {
  const Stage stage = colonnade(40);
  const shadow::LightMask expected = truth(stage);
  for (const int texels : {512, 1024, 2048}) {
    const auto uniform = mapped(makeShadowMap, stage, {.texels = texels, .filter = 0});
    const auto perspective = mapped(makePerspectiveShadowMap, stage, {.texels = texels, .filter = 0});
    const std::size_t a = wrong(uniform.masks[0], expected), b = wrong(perspective.masks[0], expected);
    std::printf("%4d texels: uniform %.3f %%, perspective %.3f %%\n", texels, percent(a, expected),
                percent(b, expected));
    EXPECT_LT(2 * b, a);
    EXPECT_EQ(uniform.stats.lights[0].mapTexels, perspective.stats.lights[0].mapTexels);
    EXPECT_NE(perspective.stats.lights[0].reason.find("perspective"), std::string::npos);
  }
}

// Lights before and behind the eye, beside it, in the picture and out of it, from eyes in and out of shadow.
TEST_F(ShadowMaps, KnowEveryKindOfLightFromEveryEye) {
  const auto geometry = shadow::makeGeometry(village());
  std::vector<Light3> all = lights();
  for (const Vec3& d : {Vec3(-9, 11, -6), Vec3(9, -11, -6), Vec3(11, 9, -5), Vec3(-9, 11, -0.9), Vec3(0, 0, -1)})
    all.push_back({"a sun", {scene::DirectionalLight{d}}});
  for (const Make make : {makeShadowMap, makePerspectiveShadowMap}) {
    std::size_t sum = 0, pixels = 0;
    double worst = 0.0;
    for (const Eye& eye : eyes())
      for (const Light3& light : all) {
        const Stage stage{"", geometry, eye.camera, light.light};
        const shadow::LightMask expected = truth(stage);
        const auto shading = mapped(make, stage, {.texels = 1024, .filter = 0});
        const std::size_t w = wrong(shading.masks[0], expected);
        EXPECT_LT(percent(w, expected), 2.0)
            << eye.name << ", " << light.name << ": " << shading.stats.lights[0].reason;
        sum += w, pixels += expected.light.size(), worst = std::max(worst, percent(w, expected));
      }
    std::printf("%s: %.4f %% of all pixels, worst picture %.3f %%\n", make == makeShadowMap ? "uniform" : "perspective",
                100.0 * double(sum) / double(pixels), worst);
    EXPECT_LT(1000 * sum, 2 * pixels);
  }
}

TEST_F(ShadowMaps, AreAsFineAsThePictureAsks) {
  const Stage stage = villageInTheSun();
  const shadow::LightMask expected = truth(stage);
  const auto side = [](const shadow::Shading& s) { return std::sqrt(double(s.stats.lights[0].mapTexels)); };
  const auto chosen = mapped(makeShadowMap, stage, {.filter = 0});
  // Texels are no larger than pixels nearly everywhere: what is wrong lies at borders.
  EXPECT_LT(percent(wrong(chosen.masks[0], expected), expected), 0.1);
  Stage twice = stage;
  twice.camera.width *= 2, twice.camera.height *= 2;
  EXPECT_NEAR(side(mapped(makeShadowMap, twice, {.filter = 0})) / side(chosen), 2.0, 0.3);
  EXPECT_EQ(side(mapped(makeShadowMap, stage, {.filter = 0, .mostBytes = 4 * 128 * 128})), 128.0);
  const auto most = context_->quirks().maxTextureSize;
  if (most <= 16384) {
    EXPECT_LE(side(mapped(makeShadowMap, {stage.name, stage.geometry, stage.camera, stage.light},
                          {.texels = 1 << 20, .filter = 0})),
              double(most));
  }
}

// Flat surfaces do not shade themselves, however flat the light falls; what touches the ground shades it up to where it touches.
TEST_F(ShadowMaps, NeitherShadeFlatSurfacesNorLeaveGaps) {
  scene::Scene s;
  s.materials = {{}};
  s.meshes = {boxMesh()};
  s.instances = {box({-6, -6, -1}, {12, 12, 1}), box({-1, -1, 0}, {2, 2, 1})};  // the ground casts, too
  const auto geometry = shadow::makeGeometry(s);
  for (const double height : {0.1, 0.4, 2.0})
    for (const Make make : {makeShadowMap, makePerspectiveShadowMap}) {
      const Stage stage{"", geometry, camera({7, -9, 6}, {0, 0, 0}), {scene::DirectionalLight{{0.7, 0.31, -height}}}};
      const auto expected = truth(stage);
      const auto difference = shadow::compare(mapped(make, stage, {.texels = 1024, .filter = 0}).masks[0], expected,
                                              Truth{geometry->surfaces}.edges(stage.camera, expected), 3);
      EXPECT_EQ(difference.farFromEdge, 0u) << height;
    }
}

TEST_F(ShadowMaps, FilterSoftensBordersAlone) {
  const Stage stage = villageInTheSun();
  const auto hard = mapped(makeShadowMap, stage, {.texels = 512, .filter = 0}).masks[0].light;
  const auto soft = mapped(makeShadowMap, stage, {.texels = 512, .filter = 2}).masks[0].light;
  std::size_t between = 0, flipped = 0;
  for (std::size_t i = 0; i < hard.size(); ++i) {
    const int a = hard.pixels()[i], b = soft.pixels()[i];
    EXPECT_TRUE(a == 0 || a == 255);
    between += b != 0 && b != 255;
    flipped += std::abs(a - b) == 255;
  }
  EXPECT_GT(between, 300u);
  EXPECT_LT(between, hard.size() / 20);
  EXPECT_EQ(flipped, 0u);
}

TEST_F(ShadowMaps, DrawThePictureThatTheProcessorComposes) {
  const scene::Scene s = village();
  const auto geometry = shadow::makeGeometry(s);
  std::vector<scene::Light> several;
  for (const Light3& l : lights()) several.push_back({l.light.shape, Vec3(0.2, 0.15, 0.1), 1.0, ""});
  several.push_back({scene::DiscLight{{4, -3, 8}, {-4, 3, -8}, 0.8}, Vec3(0.2), 1.0, ""});
  const shadow::Frame frame{.camera = eyes()[0].camera, .lights = several, .soft = {.samples = 16}};
  for (const Make make : {makeShadowMap, makePerspectiveShadowMap}) {
    const auto technique = make(context_, {.texels = 512});
    ASSERT_TRUE(technique->prepare(geometry));
    const auto shading = technique->shade(frame);
    ASSERT_TRUE(shading);
    EXPECT_GT(shading->stats.lights.back().soft->penumbra, 20u);
    const auto expected =
        shadow::composite(s, geometry->surfaces, frame.camera, shading->surface, several, shading->masks);
    const gl::CurrentContext current(context_);
    auto target = render::GpuFrame::make(kWidth, kHeight);
    ASSERT_TRUE(target);
    ASSERT_TRUE(technique->draw(*target, frame, {.materials = s.materials}));
    const gl::HostScope scope;
    const auto picture = gl::readRgba(scope, target->pictureTarget(), kWidth, kHeight);
    image::RgbImage drawn(kWidth, kHeight);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const auto p = picture.pixels()[i];
      drawn.pixels()[i] = {p.r, p.g, p.b};
    }
    EXPECT_LE(image::compare(drawn, expected).largest, 2);
  }
}

// No surface, no caster, a lamp in a corner of a caster, far from the origin, huge and tiny.
TEST_F(ShadowMaps, SurviveWhatIsOutOfTheWay) {
  scene::Scene nothing;
  nothing.materials = {{}};
  scene::Scene open = village();
  for (scene::Instance& i : open.instances) i.casts = false;
  for (const Make make : {makeShadowMap, makePerspectiveShadowMap}) {
    const scene::Light sun = lights()[0].light;
    Stage stage{"", shadow::makeGeometry(nothing), eyes()[0].camera, sun};
    EXPECT_EQ(mapped(make, stage, {}).stats.lights[0].shadowMaps, 0u);
    stage.geometry = shadow::makeGeometry(open);
    const auto lit = mapped(make, stage, {});
    EXPECT_EQ(lit.stats.lights[0].shadowMaps, 0u);
    EXPECT_EQ(wrong(lit.masks[0], truth(stage)), 0u);
    for (const auto& [scale, shift] :
         {std::pair(1.0, Vec3(0.0)), {1.0, Vec3(85000, 446000, 30)}, {0x1p20, Vec3(0.0)}, {0x1p-10, Vec3(0.0)}}) {
      scene::Scene s = village();
      for (scene::Instance& i : s.instances) {
        const Vec3 at(i.toWorld[3]);
        i.toWorld = Mat4(Mat3(i.toWorld) * scale);
        i.toWorld[3] = Vec4(scale * at + shift, 1.0);
      }
      stage.geometry = shadow::makeGeometry(s);
      stage.camera = cameraFrom(scale * Vec3(9, -11, 7) + shift, scale * Vec3(0, 1, 1) + shift);
      for (const Vec3& lamp : {Vec3(3.7, -1.2, 6.0), Vec3(2, 2, 3)}) {  // the second is a box's corner, to the bit
        stage.light = {scene::PointLight{scale * lamp + shift}};
        EXPECT_LT(
            percent(wrong(mapped(make, stage, {.texels = 1024, .filter = 0}).masks[0], truth(stage)), truth(stage)),
            1.0)
            << scale << " " << lamp.z;
      }
    }
  }
}

}  // namespace
}  // namespace umbrage::techniques
