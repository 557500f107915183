#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "support/oracle.hpp"
#include "support/shapes.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/render/stencil_shadows.hpp"

// Casters that move, come, go and change their shape in front of a wall, in a host's framebuffer: the shadows follow, and only what
// must be worked out anew is (counted, not timed).

namespace umbrage::render {
namespace {

constexpr int kWidth = 120, kHeight = 80;
constexpr double kWallAt = 14.0;
const Vec3 kEye(1, -2, 3), kTarget(2, 10, 2.5);
const Mat4 kView = glm::lookAt(kEye, kTarget, Vec3(0, 0, 1));
const scene::Light kSun{scene::DirectionalLight{{0.2, 1, -0.15}}};
const scene::Light kLamp{scene::PointLight{{-1, -6, 5}}};

std::shared_ptr<const shadow::CasterSet> castersOf(const mesh::Mesh& m) {
  return std::make_shared<const shadow::CasterSet>(shadow::buildCasters(scene::flatten(shapes::scene({m}))));
}

Mat4 at(const Vec3& p) { return glm::translate(Mat4(1.0), p); }
Mat4 turned(double angle, const Vec3& axis) { return glm::rotate(Mat4(1.0), angle, axis); }

// Where all casters stand, as triangles of the world.
scene::Surfaces worldOf(const std::vector<PosedCasters>& posed) {
  scene::Surfaces s;
  for (const PosedCasters& p : posed) {
    const auto base = static_cast<std::uint32_t>(s.positions.size());
    for (const Vec3f& q : p.casters->positions)
      s.positions.emplace_back(Vec3(p.toWorld * Vec4(Vec3(q) + p.casters->origin, 1.0)));
    for (const mesh::Triangle& t : p.casters->triangles) {
      s.triangles.push_back({base + t[0], base + t[1], base + t[2]});
      s.casts.push_back(1);
    }
  }
  for (const Vec3f& p : s.positions) s.bounds.add(Vec3(p));
  return s;
}

class MovingCasters : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gl::Context::createHeadless();
    if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
    current_.emplace(*context);
    GLuint picture = 0, framebuffer = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &picture);
    glTextureStorage2D(picture, 1, GL_DEPTH24_STENCIL8, kWidth, kHeight);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, picture, 0);
    glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
    glNamedFramebufferReadBuffer(framebuffer, GL_NONE);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, kWidth, kHeight);
    const Vec4 clip = projection_ * Vec4(0, 0, -kWallAt, 1);
    const auto depth = static_cast<float>(0.5 * clip.z / clip.w + 0.5);
    glClearBufferfv(GL_DEPTH, 0, &depth);
    auto made = StencilShadows::make();
    ASSERT_TRUE(made) << made.error().text();
    shadows_.emplace(std::move(*made));
  }
  void TearDown() override { shadows_.reset(); }

  void mark(const scene::Light& light, Counting counting = Counting::zPass) {
    // Nothing but the wall is in the depth buffer, so casters in the view are to be counted by z-fail.
    const auto marked =
        shadows_->mark(light, {kView, projection_}, posed_,
                       {.counting = counting, .castersInDepth = counting == Counting::zPass, .receivers = receivers_});
    ASSERT_TRUE(marked) << marked.error().text();
  }

  // The wall, as far as it is seen.
  Box3 wall() const {
    const Mat4 back = glm::inverse(kView);
    Box3 box;
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        box.add(Vec3(back * Vec4(kWallAt * Vec3(x / projection_[0][0], y / projection_[1][1], -1.0), 1.0)));
    return box;
  }

  // Pixels of the wall that brute force is sure of and the stencil has otherwise.
  std::size_t wrongPixels(const scene::Light& light, std::size_t& shadowed) const {
    std::vector<std::uint8_t> stencil(std::size_t(kWidth) * kHeight);
    glReadPixels(0, 0, kWidth, kHeight, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil.data());
    const scene::Surfaces world = worldOf(posed_);
    const oracle::Oracle bruteForce(world);
    const Vec4 l = scene::homogeneous(light, Vec3(0.0));
    const Mat4 back = glm::inverse(kView);
    const auto dark = [&](double x, double y) {
      const Vec3 ray((2.0 * x / kWidth - 1.0) / projection_[0][0], (2.0 * y / kHeight - 1.0) / projection_[1][1], -1.0);
      const Vec3 p = Vec3(back * Vec4(kWallAt * ray, 1.0));
      return bruteForce.hidden(p, scene::towardsLight(l, p), l.w != 0.0);
    };
    std::size_t wrong = 0;
    for (int y = 1; y < kHeight; y += 2) {
      for (int x = 1; x < kWidth; x += 2) {
        const oracle::Answer here = dark(x + 0.5, y + 0.5);
        bool clear = here != oracle::Answer::unclear;
        for (const double dx : {-0.5, 1.5})
          for (const double dy : {-0.5, 1.5}) clear = clear && dark(x + dx, y + dy) == here;
        shadowed += here == oracle::Answer::yes;
        wrong += clear && (stencil[std::size_t(y) * kWidth + std::size_t(x)] != 0) != (here == oracle::Answer::yes);
      }
    }
    return wrong;
  }

  // Of the marks in `what`: silhouettes found and positions sent.
  template <class What>
  std::pair<std::size_t, std::size_t> workOf(const What& what) {
    const ShadowWork before = shadows_->work();
    what();
    return {shadows_->work().silhouettes - before.silhouettes, shadows_->work().uploads - before.uploads};
  }

  Mat4 projection_ = glm::perspective(0.8, double(kWidth) / kHeight, 0.1, 100.0);
  std::optional<gl::CurrentContext> current_;
  std::optional<StencilShadows> shadows_;
  std::vector<PosedCasters> posed_;
  Box3 receivers_;  ///< empty: volumes reach to infinity
  std::shared_ptr<const shadow::CasterSet> box_ = castersOf(shapes::box({-1, -0.5, -0.8}, {0.7, 0.5, 0.9}));
};

using Work = std::pair<std::size_t, std::size_t>;

TEST_F(MovingCasters, CostOnlyWhatChanges) {
  const auto knot = castersOf(shapes::knot({0, 0, 0}, 1.0, 0.3, 24, 6));
  posed_ = {{box_, at({0, 4, 4})}, {box_, at({3, 5, 3}) * turned(0.7, {1, 2, 3})}, {knot, at({1, 6, 2})}};
  EXPECT_EQ(workOf([&] { mark(kSun); }), Work(3, 2)) << "a shared shape is sent once";
  EXPECT_EQ(workOf([&] { mark(kSun); }), Work(0, 0)) << "nothing changed";
  EXPECT_EQ(workOf([&] { mark(kLamp); }), Work(3, 0));
  EXPECT_EQ(workOf([&] { mark(kSun), mark(kLamp); }), Work(0, 0)) << "two lights that stay";

  posed_[0].toWorld = at({0.1, 4.3, 4}) * posed_[0].toWorld;
  EXPECT_EQ(workOf([&] { mark(kSun); }), Work(0, 0)) << "under a sun a caster is only moved along";
  EXPECT_EQ(workOf([&] { mark(kLamp); }), Work(1, 0)) << "under a lamp its silhouette changes, and no other";
  posed_[2].toWorld = posed_[2].toWorld * turned(0.3, {0, 0, 1});
  EXPECT_EQ(workOf([&] { mark(kSun); }), Work(1, 0)) << "it turned";
  const scene::Light moved{scene::PointLight{{-1, -6, 5.1}}};
  EXPECT_EQ(workOf([&] { mark(moved); }), Work(3, 0));
  EXPECT_EQ(workOf([&] { mark(kSun); }), Work(0, 0)) << "the other light did not";

  posed_.push_back({castersOf(shapes::box({-1, -1, -1}, {1, 1, 1})), at({-2, 7, 3})});
  EXPECT_EQ(workOf([&] { mark(kSun); }), Work(1, 1)) << "one appears";
  posed_.erase(posed_.begin());
  EXPECT_EQ(workOf([&] { mark(kSun); }), Work(0, 0)) << "one disappears";
  posed_.back().casters = castersOf(shapes::box({-1, -1, -1}, {1, 1.5, 1}));
  EXPECT_EQ(workOf([&] { mark(kSun); }), Work(1, 1)) << "one changes its shape";
}

TEST_F(MovingCasters, AreForgottenWithTheirVolumes) {
  for (int i = 0; i < 300; ++i) {
    posed_ = {{castersOf(shapes::box({-1, -1, -1}, {1, 1, 1 + 0.01 * i})), at({1, 5, 3})}};
    mark(kSun);
  }
  EXPECT_EQ(shadows_->work().uploads, 300u);
  posed_.clear();
  mark(kSun);
}

// Turned, scaled, sheared and mirrored in every mixture; on both ways of counting.
TEST_F(MovingCasters, ThrowTheShadowsOfWhereTheyStand) {
  shapes::Random random(5);
  const auto knot = castersOf(shapes::knot({0, 0, 0}, 0.9, 0.25, 20, 6)),
             strip = castersOf(shapes::moebius({0, 0, 0}, 1.0, 0.5, 24, 1));
  std::size_t wrong = 0, shadowed = 0, mirroredOnes = 0;
  for (int frame = 0; frame < 24; ++frame) {
    posed_.clear();
    for (int i = 0; i < 4; ++i) {
      Mat4 pose = at({random.in(-3, 6), random.in(4, 9), random.in(0, 6)}) *
                  turned(random.in(0, 6), {random.in(-1, 1), random.in(-1, 1), 1.1});
      pose = glm::scale(pose, Vec3(random.in(0.4, 1.3), random.in(0.4, 1.3), (i & 1) != 0 ? -0.8 : 0.9));
      pose[1] += 0.3 * pose[0];
      const std::array shapes{box_, knot, strip, box_};
      posed_.push_back({shapes[static_cast<std::size_t>(i)], pose});
      mirroredOnes += mirrors(posed_.back());
    }
    receivers_ = frame % 2 == 0 ? Box3() : wall();
    for (const scene::Light& light : {kSun, kLamp}) {
      mark(light, Counting::zFail);
      wrong += wrongPixels(light, shadowed);
    }
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(shadowed, 5000u);
  EXPECT_GT(mirroredOnes, 40u);
}

// The eye in the shadows of several casters that are not seen: z-pass starts from a count that each of them adds to.
TEST_F(MovingCasters, AreCountedFromAnEyeInTheirShadows) {
  const scene::Light behind{scene::PointLight{kEye + Vec3(0.3, -9, 1.5)}};
  posed_ = {{box_, at(kEye + Vec3(0.2, -3, 0.4))},
            {box_, glm::scale(at(kEye + Vec3(0.1, -5, 0.7)), Vec3(1, -1, 1))},
            {box_, at(kEye + Vec3(0.25, -1.5, 0.2)) * turned(0.4, {0, 1, 0})}};
  for (const Box3& receivers : {Box3(), wall()}) {
    receivers_ = receivers;
    std::size_t shadowed = 0;
    mark(behind, Counting::zPass);
    EXPECT_EQ(wrongPixels(behind, shadowed), 0u);
    EXPECT_GT(shadowed, 100u);
  }
}

// Casters placed so that the eye lies on a side of their volumes, or hardly beside it.
TEST_F(MovingCasters, MayHaveSidesAtTheEye) {
  const Mat4 pose = turned(0.4, {0.3, 0.2, 1});
  std::size_t attacks = 0, shadowed = 0;
  for (const scene::Light& light : {kSun, scene::Light{scene::PointLight{kEye + Vec3(0.3, -9, 1.5)}}}) {
    for (const double distance : {0.0, 1e-9, -3e-8, 1e-7, -1e-6, 1e-5, -1e-3}) {
      const Vec4 seenFrom = scene::homogeneous(light, Vec3(0.0));
      const auto edges = shadow::findSilhouette(*box_, lightFrom({box_, pose}, light)).edges;
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto world = [&](std::uint32_t p) { return Vec3(pose * Vec4(box_->position(p) + box_->origin, 1.0)); };
        const Vec3 a = world(edges[i].a), b = world(edges[i].b), middle = glm::mix(a, b, 0.37);
        // The edge's point comes to lie a third of the way from the light to the eye, or two units before it.
        const Vec3 place =
            seenFrom.w == 0.0 ? kEye + 2.0 * glm::normalize(Vec3(seenFrom)) : glm::mix(Vec3(seenFrom), kEye, 0.7);
        const Vec3 normal = glm::normalize(glm::cross(b - a, kEye - place));
        posed_ = {{box_, at(place - middle + distance * normal) * pose}};
        for (const Box3& receivers : {Box3(), wall()})
          for (const Counting counting : {Counting::zFail, Counting::zPass}) {
            receivers_ = receivers;
            mark(light, counting);
            EXPECT_EQ(wrongPixels(light, shadowed), 0u)
                << name(counting) << ", edge " << i << " at " << distance << (receivers.empty() ? "" : ", finite");
            ++attacks;
          }
      }
    }
  }
  EXPECT_GT(attacks, 40u);
  EXPECT_GT(shadowed, 1000u);
}

// What the receivers are costs no silhouette twice, and ends the volumes.
TEST_F(MovingCasters, HaveVolumesThatEndBehindTheReceivers) {
  posed_ = {{box_, at({0, 4, 4})}, {box_, at({3, 5, 3})}};
  receivers_ = wall();
  EXPECT_EQ(workOf([&] { mark(kSun, Counting::zFail); }), Work(1, 1)) << "two of one shape under one sun share all";
  posed_[0].toWorld = at({0.1, 4.3, 4});
  EXPECT_EQ(workOf([&] { mark(kSun, Counting::zFail); }), Work(0, 0));
  const auto marked = shadows_->mark(kSun, {kView, projection_}, posed_, {.receivers = receivers_});
  ASSERT_TRUE(marked);
  EXPECT_EQ(marked->endlessCasters, 0u);
}

// More layers than eight bits count, spread over many casters.
TEST_F(MovingCasters, MayLieBehindEachOtherMoreOftenThanTheStencilCounts) {
  const auto sheet = castersOf(shapes::quad({-0.9, 0, -0.9}, {0.9, 0, -0.9}, {0.9, 0, 0.9}, {-0.9, 0, 0.9}));
  const scene::Light sun{scene::DirectionalLight{{0, 1, 0}}};
  for (const int count : {255, 256, 300}) {
    posed_.clear();
    for (int i = 0; i < count; ++i) posed_.push_back({sheet, at({1 + 0.001 * i, 2 + 0.03 * i, 3})});
    std::size_t shadowed = 0;
    mark(sun, Counting::zFail);
    EXPECT_EQ(wrongPixels(sun, shadowed), 0u) << count;
    EXPECT_GT(shadowed, 20u);
  }
}

}  // namespace
}  // namespace umbrage::render
