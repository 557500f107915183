#include "umbrage/render/stencil_shadows.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "support/box_scene.hpp"
#include "umbrage/gl/context.hpp"

// Shadows in a host's framebuffer, for every convention of depth that a host may have. The host's scene is a wall across the
// view: its depth buffer is one number, and its shadows follow by arithmetic.

namespace umbrage::render {
namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr double kWallAt = 12.0;

struct Convention {
  const char* name;
  GLenum origin, depthMode;
  double rangeNear, rangeFar;
  bool mirrored;  // the projection turns the picture upside down
  bool infinite;  // reversed, infinite, depth in [0, 1]
  GLenum format;
};

const Convention kConventions[] = {
    {"ordinary", GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE, 0, 1, false, false, GL_DEPTH24_STENCIL8},
    {"float", GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE, 0, 1, false, false, GL_DEPTH32F_STENCIL8},
    {"upper_left", GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE, 0, 1, false, false, GL_DEPTH24_STENCIL8},
    {"mirrored", GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE, 0, 1, true, false, GL_DEPTH24_STENCIL8},
    {"upper_left_mirrored", GL_UPPER_LEFT, GL_ZERO_TO_ONE, 0, 1, true, true, GL_DEPTH32F_STENCIL8},
    {"part_of_the_range", GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE, 0.2, 0.8, false, false, GL_DEPTH24_STENCIL8},
    {"range_turned", GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE, 1, 0, false, false, GL_DEPTH24_STENCIL8},
    {"reversed_infinite", GL_LOWER_LEFT, GL_ZERO_TO_ONE, 0, 1, false, true, GL_DEPTH32F_STENCIL8}};

const Vec3 kEye(1, -2, 3), kTarget(2, 10, 2.5);
const Mat4 kView = glm::lookAt(kEye, kTarget, Vec3(0, 0, 1));

Box3 boxAt(const Vec3& centre) {
  Box3 box;
  box.add(centre - Vec3(1, 0.5, 0.8));
  box.add(centre + Vec3(0.7, 0.5, 0.9));
  return box;
}

// One box, its light, and whether the host's depth buffer may be said to hold it.
struct Arrangement {
  const char* name;
  Box3 box;
  scene::Light light;
  StencilShadowOptions options;
};

std::vector<Arrangement> arrangements() {
  const Vec3 forward = glm::normalize(kTarget - kEye);
  const Box3 inView = boxAt(kEye + 6.0 * forward), above = boxAt(kEye + 5.0 * forward + Vec3(0, 0, 3.8));
  const StencilShadowOptions unseen{.castersInDepth = false};
  return {{"lamp beside the view", inView, {scene::PointLight{{-2, 1, 6}}}, unseen},
          {"sun", inView, {scene::DirectionalLight{{0.3, 1, -0.1}}}, unseen},
          {"lamp behind the eye", inView, {scene::PointLight{{1.5, -5, 3.3}}}, unseen},
          {"eye in the shadow", boxAt(kEye + Vec3(0.1, -2, 0)), {scene::PointLight{{1.1, -7, 3}}}, unseen},
          // Casters out of sight leave the depth buffer as it is, so every way to count must be right.
          {"out of sight, zpass", above, {scene::DirectionalLight{{0, 1, -0.6}}}, {.counting = Counting::zPass}},
          {"out of sight, zfail", above, {scene::DirectionalLight{{0, 1, -0.6}}}, {.counting = Counting::zFail}},
          {"eye in the shadow, zpass",
           boxAt(kEye + Vec3(0.1, -2, 0)),
           {scene::PointLight{{1.1, -7, 3}}},
           {.counting = Counting::zPass}}};
}

Mat4 projectionOf(const Convention& c) {
  Mat4 p = glm::perspective(0.8, double(kWidth) / kHeight, 0.1, 100.0);
  if (c.infinite) {
    p[2][2] = 0.0;
    p[3][2] = 0.1;
  }
  return c.mirrored ? glm::scale(Mat4(1.0), Vec3(1, -1, 1)) * p : p;
}

bool isReversed(const Convention& c) { return c.infinite || c.rangeNear > c.rangeFar; }

double wallDepth(const Convention& c, const Mat4& projection) {
  const Vec4 clip = projection * Vec4(0, 0, -kWallAt, 1);
  const double ndc = clip.z / clip.w;
  const double unit = c.depthMode == GL_ZERO_TO_ONE ? ndc : 0.5 * ndc + 0.5;
  return c.rangeNear + unit * (c.rangeFar - c.rangeNear);
}

// Whether the light reaches the wall at a window position.
bool isLit(const Convention& c, const Box3& box, const Mat4& projection, const Vec4& light, double x, double y) {
  const double up = (2.0 * y / kHeight - 1.0) * (c.origin == GL_UPPER_LEFT ? -1.0 : 1.0);
  const Vec3 ray((2.0 * x / kWidth - 1.0) / projection[0][0], up / projection[1][1], -1.0);
  const Vec3 p = Vec3(glm::inverse(kView) * Vec4(kWallAt * ray, 1.0));
  const Vec3 along = scene::towardsLight(light, p);
  double enter = 0.0, leave = light.w == 0.0 ? 1e9 : 1.0;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.min[k] - p[k]) / along[k], b = (box.max[k] - p[k]) / along[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return !(enter < leave);
}

void bindFramebuffer(GLenum format) {
  GLuint picture = 0, framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &picture);
  glTextureStorage2D(picture, 1, format, kWidth, kHeight);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, picture, 0);
  glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
  glNamedFramebufferReadBuffer(framebuffer, GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, kWidth, kHeight);
}

std::vector<std::uint8_t> readStencil() {
  std::vector<std::uint8_t> stencil(std::size_t(kWidth) * kHeight);
  glReadPixels(0, 0, kWidth, kHeight, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil.data());
  return stencil;
}

class Conventions : public ::testing::TestWithParam<Convention> {};

TEST_P(Conventions, AreTheHostsOwn) {
  const auto context = gl::Context::createHeadless();
  if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
  const gl::CurrentContext current(*context);
  const Convention& c = GetParam();
  bindFramebuffer(c.format);
  glClipControl(c.origin, c.depthMode);
  glDepthRange(c.rangeNear, c.rangeFar);

  const Mat4 projection = projectionOf(c);
  const auto depth = static_cast<float>(wallDepth(c, projection));
  for (const Arrangement& arrangement : arrangements()) {
    SCOPED_TRACE(arrangement.name);
    auto shadows = StencilShadows::make(
        shadow::buildCasters(scene::flatten(support::boxScene({{"box", arrangement.box.min, arrangement.box.max}}))));
    ASSERT_TRUE(shadows);
    glClearBufferfv(GL_DEPTH, 0, &depth);
    const auto marked = shadows->mark(arrangement.light, {kView, projection, isReversed(c)}, arrangement.options);
    ASSERT_TRUE(marked) << marked.error().text();
    const auto stencil = readStencil();
    const Vec4 lamp = scene::homogeneous(arrangement.light, Vec3(0.0));
    const auto lit = [&](double x, double y) { return isLit(c, arrangement.box, projection, lamp, x, y); };
    std::size_t shadowed = 0, wrong = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const bool here = lit(x + 0.5, y + 0.5);
        bool clear = true;
        for (const double dx : {-0.5, 1.5})
          for (const double dy : {-0.5, 1.5}) clear = clear && lit(x + dx, y + dy) == here;
        shadowed += !here;
        wrong += clear && (stencil[std::size_t(y) * kWidth + std::size_t(x)] == 0) != here;
      }
    EXPECT_EQ(wrong, 0u) << marked->method << ": " << marked->reason;
    EXPECT_GT(shadowed, 20u);
  }
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

// Seen edge-on from its own plane a face has no picture, nor has its cap, which single precision would tilt over half the view. The eye lies in a
// solid's face and the light far beyond it, so the solid's shadow falls away from all that is seen.
TEST(EyesInFaces, SeeNothingOfThem) {
  const auto context = gl::Context::createHeadless();
  if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
  const gl::CurrentContext current(*context);
  bindFramebuffer(GL_DEPTH32F_STENCIL8);
  std::mt19937 random(1);
  const auto between = [&](double low, double high) { return low + (high - low) * (double(random()) / 4294967296.0); };
  const auto anywhere = [&] { return Vec3(between(-1, 1), between(-1, 1), between(-1, 1)); };
  // Coordinates that single precision holds, so that the eye lies in the very face that is drawn.
  const auto onLattice = [](const Vec3& v) { return glm::round(v * 64.0) / 64.0; };
  const Mat4 projection = glm::perspective(1.2, double(kWidth) / kHeight, 0.1, 100.0);
  for (int i = 0; i < 200; ++i) {
    const Vec3 eye = onLattice(5.0 * anywhere()), u = onLattice(anywhere()), v = onLattice(anywhere());
    const Vec3 cross = glm::cross(u, v), n = glm::normalize(cross);
    if (glm::length(cross) < 0.3) continue;
    mesh::Mesh solid;
    for (const Vec2& at : {Vec2(-3, -2.5), Vec2(2, -3), Vec2(1.5, 4)})
      solid.positions.push_back(eye + at.x * u + at.y * v);
    solid.positions.push_back(onLattice(eye - 3.0 * n));
    solid.triangles = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
    scene::Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(solid)));
    scene.instances.push_back({.name = "solid"});
    auto shadows = StencilShadows::make(shadow::buildCasters(scene::flatten(scene)));
    ASSERT_TRUE(shadows);
    const Mat4 view = glm::lookAt(eye, eye + glm::normalize(between(-1, 1) * u + between(-1, 1) * v) + 0.45 * n, n);
    const scene::Light light{scene::PointLight{eye + 20.0 * n + anywhere()}};
    const float depth = 1.0f;
    glClearBufferfv(GL_DEPTH, 0, &depth);
    ASSERT_TRUE(shadows->mark(light, {view, projection, false}, {.counting = Counting::zFail}));
    const auto stencil = readStencil();
    EXPECT_EQ(std::count(stencil.begin(), stencil.end(), 0), kWidth * kHeight) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Hosts, Conventions, ::testing::ValuesIn(kConventions),
                         [](const auto& which) { return which.param.name; });

}  // namespace
}  // namespace umbrage::render
