#include "veil_agreement.hpp"

#include <gtest/gtest.h>

#include "support/shapes.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::cli {
namespace {

/// Two panes over a ground, and a post that throws a shadow on both.
class CompareVeils : public testing::Test {
 protected:
  void SetUp() override {
    scene_.materials = {{"opaque", Vec3(0.8), 1.0}, {"glass", Vec3(0.5, 0.9, 0.6), 0.4}};
    for (const std::size_t pane : {1u, 2u}) {
      auto mesh = *scene_.meshes[pane];
      mesh.materials.assign(mesh.triangles.size(), 1);
      scene_.meshes[pane] = std::make_shared<const mesh::Mesh>(std::move(mesh));
    }
    geometry_ = shadow::makeGeometry(scene_);
    for (const auto& entry : techniques::cpuTechniques())
      if (entry.traits.name == "transparent_rays") truth_ = std::move(*entry.create());
    ASSERT_TRUE(truth_->prepare(geometry_));
    camera_.eye = {4, -5, 6}, camera_.target = {0, 0, 0.8};
    camera_.width = 120, camera_.height = 90;
    right_ = std::move(*truth_->shade(frame()));
  }
  [[nodiscard]] shadow::Frame frame() const { return {camera_, {&light_, 1}}; }
  [[nodiscard]] VeilAgreement compareWith(const shadow::Shading& mine) {
    return compareVeils(mine, right_, frame(), 1, *truth_).value().front();
  }

  scene::Scene scene_ = shapes::scene(
      {shapes::box({-3, -3, -0.1}, {3, 3, 0}), shapes::quad({-2, -2, 0.5}, {2, -2, 0.5}, {2, 2, 0.5}, {-2, 2, 0.5}),
       shapes::quad({-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}), shapes::box({-0.2, -0.2, 1.2}, {0.2, 0.2, 2})});
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::unique_ptr<shadow::Technique> truth_;
  scene::Camera camera_;
  scene::Light light_{scene::DirectionalLight{{-1, 0.3, -1.5}}};
  shadow::Shading right_;
};

TEST_F(CompareVeils, TheSameAgrees) {
  const VeilAgreement a = compareWith(right_);
  EXPECT_TRUE(a.holds());
  EXPECT_EQ(a.differing, 0u);
  EXPECT_GT(a.veils, 2000u);
}

TEST_F(CompareVeils, OneWrongVeilInTheOpenIsEnoughToDisagree) {
  auto wrong = right_;
  // The second of two in the middle of a pane, whose pixel's mask is right.
  for (std::size_t pixel = 0; pixel < wrong.surface.triangle.size(); ++pixel) {
    if (wrong.veils.at(pixel).size() != 2) continue;
    auto changed = wrong;
    shadow::Tint& tint = changed.masks[0].veils[wrong.veils.first[pixel] + 1];
    tint = tint.r > 30000 ? shadow::Tint{0, 0, 0} : shadow::kFullTint;
    if (const VeilAgreement a = compareWith(changed); !a.holds()) {
      EXPECT_EQ(a.differing, 1u);
      EXPECT_EQ(a.astray, 1u);
      return;
    }
  }
  ADD_FAILURE() << "no such change was found wrong";
}

TEST_F(CompareVeils, AMissingVeilInTheOpenIsFound) {
  auto wrong = right_;
  wrong.veils = {};
  wrong.masks[0].veils.clear();
  const VeilAgreement a = compareWith(wrong);
  EXPECT_GT(a.astray, 1000u);
  EXPECT_EQ(a.differing, a.veils);
}

TEST_F(CompareVeils, VolumesAgreeWithRays) {
  for (const auto& entry : techniques::cpuTechniques()) {
    if (entry.traits.name != "transparent_cpu") continue;
    const auto volumes = std::move(*entry.create());
    ASSERT_TRUE(volumes->prepare(geometry_));
    EXPECT_TRUE(compareWith(std::move(*volumes->shade(frame()))).holds());
  }
}

}  // namespace
}  // namespace umbrage::cli
