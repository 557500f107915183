#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "state/host_state.hpp"
#include "support/box_scene.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/gl/debug_log.hpp"
#include "umbrage/render/stencil_shadows.hpp"
#include "umbrage/techniques/gl/planar.hpp"
#include "umbrage/techniques/gl/registry.hpp"
#include "umbrage/techniques/gl/shadow_map.hpp"
#include "umbrage/techniques/gl/shadow_map_perspective.hpp"
#include "umbrage/techniques/gl/soft.hpp"
#include "umbrage/techniques/gl/transparent.hpp"
#include "umbrage/techniques/gl/zfail.hpp"
#include "umbrage/techniques/gl/zpass.hpp"

// A host's OpenGL state is its own: whatever it was, it is the same after any of our work, and our work does not depend on it.

namespace umbrage::state {
namespace {

constexpr int kRounds = 40;

scene::Scene boxes() {
  return scene::withGround(support::boxScene({{"tower", {0, 0, 0}, {1, 1, 4}}, {"slab", {-3, 2, 1}, {2, 3, 2}}}));
}

// The slab lets light through.
scene::Scene glass() {
  auto scene = boxes();
  scene.materials.push_back({"glass", Vec3(0.3, 0.9, 0.5), 0.3});
  auto mesh = std::make_shared<mesh::Mesh>(*scene.meshes[scene.instances[1].mesh]);
  mesh->materials.assign(mesh->triangles.size(), static_cast<std::uint32_t>(scene.materials.size() - 1));
  scene.meshes[scene.instances[1].mesh] = std::move(mesh);
  return scene;
}

scene::Camera camera() {
  scene::Camera c;
  c.eye = {6, -9, 5};
  c.target = {0, 1, 1};
  c.width = WildHost::kSize;
  c.height = WildHost::kSize;
  return c;
}

const scene::Light kSun{scene::DirectionalLight{{-0.4, 0.5, -0.8}}};
const scene::Light kSpot{scene::SpotLight{{3, -4, 6}, {-0.4, 0.6, -0.8}, Angle::degrees(20)}};

std::vector<std::unique_ptr<render::GlTechnique>> hostTechniques() {
  std::vector<std::unique_ptr<render::GlTechnique>> all;
  all.push_back(techniques::makeZFail(nullptr));
  all.push_back(techniques::makeZPass(nullptr));
  all.push_back(techniques::makePlanar(nullptr));
  all.push_back(techniques::makeShadowMap(nullptr, {.texels = 128}));
  all.push_back(techniques::makePerspectiveShadowMap(nullptr, {.texels = 128}));
  return all;
}

class HostState : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    auto context = gl::Context::createHeadless({.debug = true, .compatibility = GetParam()});
    if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
    context_ = *context;
    current_.emplace(context_);
    host_.emplace(GetParam());
  }
  void TearDown() override {
    host_.reset();
    current_.reset();
  }

  // Runs `work` in many wild states; each must be there again afterwards, and nothing may be an error.
  template <class Work>
  void demandBack(const Work& work) {
    for (std::uint32_t seed = 0; seed < kRounds; ++seed) {
      host_->randomise(seed);
      ASSERT_EQ(glGetError(), GLenum(GL_NO_ERROR)) << "the test's own state is not legal";
      const Snapshot before = host_->snapshot();
      const gl::DebugLog log;
      work();
      const Snapshot after = host_->snapshot();
      EXPECT_EQ(difference(before, after), "") << "seed " << seed;
      ASSERT_TRUE(log.messages().empty()) << log.messages().front();
      if (HasFailure()) return;
    }
  }

  std::shared_ptr<gl::Context> context_;
  std::optional<gl::CurrentContext> current_;
  std::optional<WildHost> host_;
};

TEST_P(HostState, SnapshotSeesChanges) {
  host_->randomise(1);
  const Snapshot before = host_->snapshot();
  host_->randomise(2);
  EXPECT_NE(difference(before, host_->snapshot()), "");
}

TEST_P(HostState, ComesBackFromEveryTechniqueInTheHostsContext) {
  const auto geometry = shadow::makeGeometry(boxes());
  const std::array lights{kSun, kSpot};
  for (auto& technique : hostTechniques()) {
    ASSERT_TRUE(technique->prepare(geometry));
    const auto expected = technique->shade({camera(), lights});
    ASSERT_TRUE(expected);
    demandBack([&] {
      EXPECT_TRUE(technique->prepare(geometry));
      const auto shading = technique->shade({camera(), lights});
      ASSERT_TRUE(technique->shade({.camera = camera(), .lights = lights, .silhouettes = shadow::FinderKind::gpu}));
      ASSERT_TRUE(shading);
      // The host's state must not leak into our pictures either.
      EXPECT_EQ(shading->surface.triangle, expected->surface.triangle);
      EXPECT_EQ(shading->surface.depth, expected->surface.depth);
      for (std::size_t i = 0; i < lights.size(); ++i) EXPECT_EQ(shading->masks[i].light, expected->masks[i].light);
    });
  }
}

TEST_P(HostState, ComesBackFromDrawingAPicture) {
  const auto scene = boxes();
  const scene::Light disc{scene::DiscLight{{3, -4, 6}, {-0.4, 0.6, -0.8}, 0.5}};
  for (auto& technique : hostTechniques()) {
    ASSERT_TRUE(technique->prepare(shadow::makeGeometry(scene)));
    auto frame = render::GpuFrame::make(camera().width, camera().height);
    ASSERT_TRUE(frame);
    const std::array lights{kSpot, technique->traits().soft ? disc : kSun};
    demandBack([&] {
      EXPECT_TRUE(technique->draw(*frame, {.camera = camera(), .lights = lights, .soft = {.samples = 2}},
                                  {.materials = scene.materials}));
    });
  }
}

TEST_P(HostState, ComesBackFromGlassInTheHostsContext) {
  const auto scene = glass();
  const auto geometry = shadow::makeGeometry(scene);
  ASSERT_FALSE(geometry->filters.empty());
  const scene::Light lamp{scene::SphereLight{{3, -4, 6}, 0.3}};
  const std::array lights{kSun, lamp};
  for (const auto make : {techniques::makeTransparent, techniques::makeTransparentZFail, techniques::makeSoft}) {
    const auto technique = make(nullptr, {});
    ASSERT_TRUE(technique->prepare(geometry));
    const shadow::Frame frame{.camera = camera(), .lights = lights, .soft = {.samples = 2}};
    const auto expected = technique->shade(frame);
    ASSERT_TRUE(expected) << expected.error().text();
    EXPECT_GT(expected->veils.veils.size(), 0u);
    auto target = render::GpuFrame::make(camera().width, camera().height);
    ASSERT_TRUE(target);
    demandBack([&] {
      const auto shading = technique->shade(frame);
      ASSERT_TRUE(shading) << shading.error().text();
      EXPECT_EQ(shading->surface.triangle, expected->surface.triangle);
      for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(shading->masks[i].tint, expected->masks[i].tint);
        EXPECT_EQ(shading->masks[i].veils, expected->masks[i].veils);
      }
      EXPECT_TRUE(technique->draw(*target, frame, {.materials = scene.materials}));
    });
  }
}

TEST_P(HostState, ComesBackFromRegisteredTechniquesInTheirOwnContext) {
  const auto geometry = shadow::makeGeometry(glass());
  for (const auto& entry : techniques::openGlTechniques()) {
    auto technique = entry.create();
    ASSERT_TRUE(technique) << technique.error().text();
    demandBack([&] {
      EXPECT_TRUE((*technique)->prepare(geometry));
      EXPECT_TRUE((*technique)->shade({camera(), std::span(&kSun, 1)}));
    });
  }
}

TEST_P(HostState, ComesBackFromStencilShadows) {
  const auto casters = shadow::buildCasters(scene::flatten(boxes()));
  auto shadows = render::StencilShadows::make(casters);
  ASSERT_TRUE(shadows);
  const render::HostView view{.view = glm::lookAt(Vec3(6, -9, 5), Vec3(0, 1, 1), Vec3(0, 0, 1)),
                              .projection = glm::perspective(0.8, 1.0, 0.1, 100.0)};
  demandBack([&] {
    for (const auto counting : {render::Counting::zFail, render::Counting::zPass})
      EXPECT_TRUE(shadows->mark(kSun, view, {.counting = counting}));
  });
}

TEST_P(HostState, ComesBackWhenStencilShadowsAreRefused) {
  auto shadows = render::StencilShadows::make(shadow::buildCasters(scene::flatten(boxes())));
  ASSERT_TRUE(shadows);
  GLuint bare = 0;
  glCreateFramebuffers(1, &bare);
  host_->randomise(7);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, bare);
  const Snapshot before = host_->snapshot();
  const auto marked = shadows->mark(kSun, {.projection = glm::perspective(0.8, 1.0, 0.1, 100.0)});
  ASSERT_FALSE(marked);
  EXPECT_EQ(marked.error().code, ErrorCode::device);
  EXPECT_EQ(difference(before, host_->snapshot()), "");
}

INSTANTIATE_TEST_SUITE_P(Profiles, HostState, ::testing::Bool(),
                         [](const auto& which) { return which.param ? "compatibility" : "core"; });

TEST(StencilShadows, SayWhenNoContextIsCurrent) {
  const auto shadows = render::StencilShadows::make({});
  ASSERT_FALSE(shadows);
  EXPECT_EQ(shadows.error().code, ErrorCode::device);
}

}  // namespace
}  // namespace umbrage::state
