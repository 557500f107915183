#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/village.hpp"
#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/read_back.hpp"
#include "umbrage/image/compare.hpp"
#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/shadow/facing.hpp"
#include "umbrage/techniques/gl/registry.hpp"
#include "umbrage/techniques/gl/volumes_brute.hpp"
#include "umbrage/techniques/gl/zfail.hpp"
#include "umbrage/techniques/gl/zmixed.hpp"
#include "umbrage/techniques/gl/zp_plus.hpp"
#include "umbrage/techniques/gl/zpass.hpp"

namespace umbrage::techniques {
namespace {

using namespace support;

using Make = std::unique_ptr<render::GlTechnique> (*)(std::shared_ptr<gl::Context>);

std::unique_ptr<render::GlTechnique> reducedZFail(std::shared_ptr<gl::Context> context) {
  return makeZFail(std::move(context));
}
std::unique_ptr<render::GlTechnique> reducedZPass(std::shared_ptr<gl::Context> context) {
  return makeZPass(std::move(context));
}
std::unique_ptr<render::GlTechnique> reducedZMixed(std::shared_ptr<gl::Context> context) {
  return makeZMixed(std::move(context));
}
std::unique_ptr<render::GlTechnique> reducedZPassPlus(std::shared_ptr<gl::Context> context) {
  return makeZPassPlus(std::move(context));
}
std::unique_ptr<render::GlTechnique> reducedBrute(std::shared_ptr<gl::Context> context) {
  return makeVolumesBrute(std::move(context));
}
std::unique_ptr<render::GlTechnique> zFailFaceByFace(std::shared_ptr<gl::Context> context) {
  return makeZFail(std::move(context), {.twoSided = false});
}
std::unique_ptr<render::GlTechnique> plainZFail(std::shared_ptr<gl::Context> context) {
  return makeZFail(std::move(context), render::kPlainVolumes);
}
std::unique_ptr<render::GlTechnique> plainZPass(std::shared_ptr<gl::Context> context) {
  return makeZPass(std::move(context), render::kPlainVolumes);
}

class StencilTechniques : public ::testing::TestWithParam<Make> {
 protected:
  void SetUp() override {
    auto context = gl::Context::createHeadless();
    if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
    context_ = *context;
    technique_ = GetParam()(context_);
  }
  static bool isPlain() { return GetParam() == plainZFail || GetParam() == plainZPass; }
  std::shared_ptr<gl::Context> context_;
  std::unique_ptr<render::GlTechnique> technique_;
};

TEST_P(StencilTechniques, AgreeWithBruteForceForEveryEyeAndLight) {
  const auto geometry = shadow::makeGeometry(village());
  ASSERT_TRUE(technique_->prepare(geometry));
  const Truth truth{geometry->surfaces};
  for (const Eye& eye : eyes())
    for (const Light3& light : lights()) {
      SCOPED_TRACE(std::string(eye.name) + ", " + light.name);
      const auto shading = technique_->shade({eye.camera, std::span(&light.light, 1)});
      ASSERT_TRUE(shading) << shading.error().text();
      const auto expected = truth.mask(eye.camera, light.light);
      const auto difference = shadow::compare(shading->masks[0], expected, truth.edges(eye.camera, expected), 1);
      EXPECT_EQ(difference.farFromEdge, 0u) << difference.differing << " differ in all";
    }
}

// The ground at the eye's own height is not seen, and comes back when the eye rises.
TEST_P(StencilTechniques, DoNotSeeSurfacesInWhosePlaneTheEyeLies) {
  const auto geometry = shadow::makeGeometry(village());
  ASSERT_TRUE(technique_->prepare(geometry));
  const Truth truth{geometry->surfaces};
  const Light3 light = lights()[0];
  for (const Vec3& eye : {Vec3(-9, -7, 0), Vec3(-9, -7, 1), Vec3(2, -7, 3), Vec3(-13.3, 9.1, 0)}) {
    for (const Vec3& target : {Vec3(0, 0, 1), Vec3(0.3, 0.2, 0)}) {
      const scene::Camera camera = cameraFrom(eye, target);
      const auto shading = technique_->shade({camera, std::span(&light.light, 1)});
      ASSERT_TRUE(shading);
      const auto expected = truth.mask(camera, light.light);
      const auto difference = shadow::compare(shading->masks[0], expected, truth.edges(camera, expected), 1);
      EXPECT_EQ(difference.farFromEdge, 0u) << eye.x << " " << eye.z << " to " << target.z;
    }
  }
}

// Eyes on and beside the sides of the shadow volumes themselves, where counting from the eye is a coin toss.
TEST_P(StencilTechniques, AgreeWithBruteForceForEyesAtTheSidesOfVolumes) {
  const auto geometry = shadow::makeGeometry(village());
  ASSERT_TRUE(technique_->prepare(geometry));
  const Truth truth{geometry->surfaces};
  std::size_t attacks = 0;
  for (const Light3& light : {lights()[0], lights()[2]}) {
    const auto silhouette = shadow::findSilhouette(geometry->casters, scene::homogeneous(light.light, Vec3(0.0)));
    for (std::size_t i = 0; i < silhouette.edges.size(); i += 3)
      for (const double distance : {0.0, 1e-7, -1e-6, 1e-5, -1e-4, 1e-3}) {
        const Vec3 a = geometry->casters.position(silhouette.edges[i].a),
                   b = geometry->casters.position(silhouette.edges[i].b);
        const Vec3 middle = glm::mix(a, b, 0.37);
        const Vec3 away = glm::normalize(middle * silhouette.light.w - Vec3(silhouette.light));
        const Vec3 normal = glm::normalize(glm::cross(b - a, away));
        scene::Camera camera = cameraFrom(middle + 0.31 * away + distance * normal, {-0.4, 1.7, 0.6});
        if (camera.eye.z < 0.05) continue;
        camera.width = 40;
        camera.height = 23;
        const auto shading = technique_->shade({camera, std::span(&light.light, 1)});
        ASSERT_TRUE(shading);
        const auto expected = truth.mask(camera, light.light);
        const auto difference = shadow::compare(shading->masks[0], expected, truth.edges(camera, expected), 1);
        EXPECT_EQ(difference.farFromEdge, 0u)
            << light.name << ", edge " << i << " at " << distance << ": " << shading->stats.lights[0].reason;
        ++attacks;
      }
  }
  EXPECT_GT(attacks, 40u);
}

// An eye beyond the scene, in the long shadow of a tower, that looks back at lit roofs: the volume that holds it ends nowhere
// near a surface.
TEST_P(StencilTechniques, AgreeWithBruteForceForAnEyeInTheShadowBeyondTheScene) {
  scene::Scene s = village();
  s.instances = {box({0, 0, 0}, {1, 1, 12}), box({-3, 4, 0}, {1, 3, 4}), box({-6, 20, 0}, {9, 9, 2})};
  s.instances[2].casts = false;  // far to the side, where no shadow goes
  const auto geometry = shadow::makeGeometry(s);
  ASSERT_TRUE(technique_->prepare(geometry));
  const Truth truth{geometry->surfaces};
  const scene::Light sun{scene::DirectionalLight{{-1.0, 0.2, -0.1}}};
  for (const double distance : {2.0, 15.0, 40.0}) {
    const scene::Camera camera = cameraFrom(Vec3(0.5, 0.5, 10.5) + distance * Vec3(-1.0, 0.2, -0.1), Vec3(-1.5, 12, 2));
    const auto shading = technique_->shade({camera, std::span(&sun, 1)});
    ASSERT_TRUE(shading);
    const auto expected = truth.mask(camera, sun);
    EXPECT_EQ(shadow::compare(shading->masks[0], expected, truth.edges(camera, expected), 1).farFromEdge, 0u)
        << "from " << distance << ": " << shading->stats.lights[0].reason;
  }
}

// Neither the origin of the file nor the size of the scene may matter.
TEST_P(StencilTechniques, AgreeWithBruteForceFarFromTheOriginAndInMillimetres) {
  for (const double scale : {1.0, 1000.0}) {
    scene::Scene s = village();
    const Vec3 shift = scale == 1.0 ? Vec3(85000, 446000, 30) : Vec3(0.0);
    for (scene::Instance& i : s.instances) {
      i.toWorld = Mat4(Mat3(i.toWorld) * scale);
      i.toWorld[3] =
          Vec4(scale * Vec3(village().instances[std::size_t(&i - s.instances.data())].toWorld[3]) + shift, 1.0);
    }
    const auto geometry = shadow::makeGeometry(s);
    ASSERT_TRUE(technique_->prepare(geometry));
    scene::Camera camera = cameraFrom(scale * Vec3(9, -11, 7) + shift, scale * Vec3(0, 1, 1) + shift);
    const scene::Light lamp{scene::PointLight{scale * Vec3(3.7, -1.2, 6.0) + shift}};
    const auto shading = technique_->shade({camera, std::span(&lamp, 1)});
    ASSERT_TRUE(shading);
    const Truth truth{geometry->surfaces};
    const auto expected = truth.mask(camera, lamp);
    EXPECT_EQ(shadow::compare(shading->masks[0], expected, truth.edges(camera, expected), 1).farFromEdge, 0u) << scale;
  }
}

TEST_P(StencilTechniques, SeeWhatTheCameraSees) {
  const auto geometry = shadow::makeGeometry(village());
  ASSERT_TRUE(technique_->prepare(geometry));
  const scene::Camera camera = eyes()[0].camera;
  const auto shading = technique_->shade({camera, {}});
  ASSERT_TRUE(shading);
  EXPECT_TRUE(shading->masks.empty());
  const Truth truth{geometry->surfaces};
  const scene::PixelRays rays = scene::pixelRays(camera);
  std::size_t different = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      double t = 0.0;
      const auto seen = truth.hit(camera.eye, rays.through(x + 0.5, y + 0.5), 0.0,
                                  std::numeric_limits<double>::infinity(), false, &t);
      if (shading->surface.triangle(x, y) == seen)
        EXPECT_TRUE(std::isinf(t) ? std::isinf(shading->surface.depth(x, y))
                                  : std::abs(shading->surface.depth(x, y) - t) < 1e-3 * t)
            << x << " " << y;
      else
        ++different;
    }
  EXPECT_LT(different, 20u);  // pixels on edges between triangles
}

// The camera has no near plane: of two sheets a hair's breadth before it, it sees the nearer one, and its shadow.
TEST_P(StencilTechniques, SeeWhatIsRightBeforeTheEye) {
  scene::Scene s = village();
  auto upright = std::make_shared<mesh::Mesh>();
  for (const double x : {4e-5, 2e-5, 1e-5}) {  // the nearest is drawn last
    const auto first = static_cast<std::uint32_t>(upright->positions.size());
    for (const Vec2 yz : {Vec2(-1, 9), Vec2(1, 9), Vec2(1, 11), Vec2(-1, 11)})
      upright->positions.emplace_back(20 + x, yz.x, yz.y);
    upright->triangles.push_back({first, first + 1, first + 2});
    upright->triangles.push_back({first, first + 2, first + 3});
  }
  s.meshes.push_back(upright);
  s.instances.push_back({"sheets", static_cast<std::uint32_t>(s.meshes.size() - 1)});
  const auto geometry = shadow::makeGeometry(s);
  ASSERT_TRUE(technique_->prepare(geometry));
  const scene::Camera camera = cameraFrom({20 - 1e-4, 0, 10}, {21, 0, 10});
  const Truth truth{geometry->surfaces};
  for (const Light3& light : lights()) {
    const auto shading = technique_->shade({camera, std::span(&light.light, 1)});
    ASSERT_TRUE(shading);
    const Vec3 ray = scene::pixelRays(camera).through(kWidth / 2 + 0.5, kHeight / 4 + 0.5);
    const double none = std::numeric_limits<double>::infinity();
    EXPECT_EQ(shading->surface.triangle(kWidth / 2, kHeight / 4), truth.hit(camera.eye, ray, 0.0, none, false));
    const auto expected = truth.mask(camera, light.light);
    EXPECT_EQ(shadow::compare(shading->masks[0], expected, truth.edges(camera, expected), 1).farFromEdge, 0u)
        << light.name;
  }
}

TEST_P(StencilTechniques, DrawThePictureThatTheProcessorComposes) {
  scene::Scene s = village();
  s.materials[0].emission = {0.2, 0.0, 0.1};
  const auto geometry = shadow::makeGeometry(s);
  ASSERT_TRUE(technique_->prepare(geometry));
  const scene::Camera camera = eyes()[0].camera;
  std::vector<scene::Light> several;
  for (const Light3& l : lights()) {
    several.push_back(l.light);
    several.back().colour = Vec3(0.2 + 0.1 * double(several.size()), 0.3, 0.5 - 0.05 * double(several.size()));
    several.back().intensity = 0.7;
  }
  const auto shading = technique_->shade({camera, several});
  ASSERT_TRUE(shading);
  const auto expected = shadow::composite(s, geometry->surfaces, camera, shading->surface, several, shading->masks);

  const gl::CurrentContext current(context_);
  auto frame = render::GpuFrame::make(kWidth, kHeight);
  ASSERT_TRUE(frame);
  const auto stats = technique_->draw(*frame, {camera, several}, {.materials = s.materials});
  ASSERT_TRUE(stats);
  const gl::HostScope scope;
  const auto picture = gl::readRgba(scope, frame->pictureTarget(), kWidth, kHeight);
  image::RgbImage drawn(kWidth, kHeight);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto p = picture.pixels()[i];
    drawn.pixels()[i] = {p.r, p.g, p.b};
  }
  EXPECT_LE(image::compare(drawn, expected).largest, 2);
}

// Where nothing is shadowed the picture is as bright as without shadows.
TEST_P(StencilTechniques, LeaveLitSurfacesAlone) {
  scene::Scene s = village();
  const scene::Light sun{scene::DirectionalLight{{0.0, 0.0, -1.0}}};
  const auto maskOf = [&](const scene::Scene& which) {
    EXPECT_TRUE(technique_->prepare(shadow::makeGeometry(which)));
    auto shading = technique_->shade({eyes()[3].camera, std::span(&sun, 1)});
    EXPECT_TRUE(shading);
    return shading->masks[0];
  };
  const auto shadowed = maskOf(s);
  for (scene::Instance& i : s.instances) i.casts = false;
  const auto unshadowed = maskOf(s);
  std::size_t lost = 0, won = 0;
  for (std::size_t i = 0; i < shadowed.light.size(); ++i) {
    lost += shadowed.light.pixels()[i] < unshadowed.light.pixels()[i];
    won += shadowed.light.pixels()[i] > unshadowed.light.pixels()[i];
  }
  EXPECT_EQ(won, 0u);
  EXPECT_GT(lost, 0u);  // the sheet's shadow
}

TEST_P(StencilTechniques, TellWhatTheyDid) {
  ASSERT_TRUE(technique_->prepare(shadow::makeGeometry(village())));
  const scene::Light sun = lights()[0].light;
  const auto shading = technique_->shade({eyes()[0].camera, std::span(&sun, 1)});
  ASSERT_TRUE(shading);
  const auto& stats = shading->stats;
  ASSERT_EQ(stats.lights.size(), 1u);
  EXPECT_EQ(stats.lights[0].method, technique_->traits().name);
  EXPECT_FALSE(stats.lights[0].reason.empty());
  EXPECT_GT(stats.lights[0].silhouetteEdges, 0u);
  EXPECT_GT(stats.lights[0].volumeTriangles, 0u);
  std::vector<std::string> names;
  for (const auto& phase : stats.phases) names.push_back(phase.name);
  std::vector<std::string> phases{"facing",  "depth",  "tiles",   "silhouette", "useless", "layers",
                                  "extrude", "upload", "volumes", "lit",        "readback"};
  if (isPlain()) std::erase(phases, "tiles");
  EXPECT_EQ(names, phases);
}

// 256 sheets between the sun and the ground: what 8 bits count as 0.
TEST_P(StencilTechniques, CountMoreLayersThanTheStencilHolds) {
  for (const int layers : {255, 256, 512}) {
    auto sheet = std::make_shared<mesh::Mesh>();
    sheet->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
    scene::Scene stack;
    stack.materials = {{}};
    stack.meshes = {sheet};
    for (int i = 0; i < layers; ++i) {
      Mat4 raised(1.0);
      raised[3][2] = 1.0 + 0.01 * i;
      stack.instances.push_back({"sheet", 0, raised});
    }
    ASSERT_TRUE(technique_->prepare(shadow::makeGeometry(scene::withGround(stack, 0.0))));
    const scene::Light sun{scene::DirectionalLight{{0.001, 0.002, -1.0}}};
    const scene::Light lamp{scene::PointLight{{0.1, 0.2, 90.0}}};
    scene::Camera camera;
    camera.eye = {9, 1, 0.8};
    camera.target = {0, 0, 0};
    camera.fovY = Angle::degrees(20);
    camera.width = camera.height = 33;
    const std::array lights{sun, lamp};
    const auto shading = technique_->shade({camera, lights});
    ASSERT_TRUE(shading);
    for (const auto& mask : shading->masks) EXPECT_EQ(mask.light(16, 16), 0) << layers;
  }
}

TEST_P(StencilTechniques, SurviveEmptyScenesAndOddSizes) {
  scene::Scene nothing;
  nothing.materials = {{}};
  ASSERT_TRUE(technique_->prepare(shadow::makeGeometry(nothing)));
  scene::Camera camera = eyes()[0].camera;
  camera.width = camera.height = 1;
  const scene::Light sun = lights()[0].light;
  const auto shading = technique_->shade({camera, std::span(&sun, 1)});
  ASSERT_TRUE(shading);
  EXPECT_EQ(shading->masks[0].covered(0, 0), 0);
  camera.width = 1 << 20;
  const auto tooWide = technique_->shade({camera, std::span(&sun, 1)});
  ASSERT_FALSE(tooWide);
  EXPECT_EQ(tooWide.error().code, ErrorCode::device);
}

constexpr std::array kVariants{"zfail",       "zpass",      "zmixed", "zp_plus", "volumes_brute", "zfail_face_by_face",
                               "zfail_plain", "zpass_plain"};
INSTANTIATE_TEST_SUITE_P(Gl, StencilTechniques,
                         ::testing::Values(reducedZFail, reducedZPass, reducedZMixed, reducedZPassPlus, reducedBrute,
                                           zFailFaceByFace, plainZFail, plainZPass),
                         [](const auto& which) { return kVariants[which.index]; });

TEST(GlTechniques, AreTheWaysToCount) {
  const auto entries = openGlTechniques();
  ASSERT_GE(entries.size(), 4u);
  EXPECT_EQ(entries[0].traits.name, "zfail");
  EXPECT_EQ(entries[1].traits.name, "zpass");
  EXPECT_EQ(entries[2].traits.name, "zmixed");
  EXPECT_EQ(entries[3].traits.name, "zp_plus");
  EXPECT_EQ(entries[4].traits.name, "volumes_brute");
}

}  // namespace
}  // namespace umbrage::techniques
