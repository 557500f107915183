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
    return compareVeils(mine, right_, frame(), geometry_->filters, 1, *truth_).value().front();
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

// Whose number a pixel shows at the common edge of two triangles is left to rounding; the light there is not.
TEST_F(CompareVeils, ANeighbourOfTheSameDepthIsAsGood) {
  auto neighbours = right_;
  for (shadow::Veil& veil : neighbours.veils.veils) veil.triangle ^= 1u, veil.depth *= 1.000001f;
  EXPECT_EQ(compareWith(neighbours).differing, 0u);
  for (shadow::Veil& veil : neighbours.veils.veils) veil.depth *= 1.001f;
  EXPECT_FALSE(compareWith(neighbours).holds());
}

/// A glass ball of facets, from several eyes, and from directions 1/512 pixel beside.
class CompareVeilsOfABall : public CompareVeils {
 protected:
  // fn(reference, beside)
  template <class Fn>
  void forEachView(std::uint32_t glasses, const Fn& fn) {
    scene_ = shapes::scene({shapes::box({-3, -3, -0.1}, {3, 3, 0}), shapes::sphere({0, 0, 1}, 1.0, 96, 48)});
    scene_.materials = {{"opaque", Vec3(0.8), 1.0}, {"glass", Vec3(0.5), 0.4}, {"other glass", Vec3(0.5), 0.45}};
    auto ball = *scene_.meshes[1];
    for (std::uint32_t t = 0; t < ball.triangles.size(); ++t) ball.materials.push_back(1 + t % glasses);
    scene_.meshes[1] = std::make_shared<const mesh::Mesh>(std::move(ball));
    geometry_ = shadow::makeGeometry(scene_);
    ASSERT_TRUE(truth_->prepare(geometry_));
    for (int i = 0; i < 8; ++i) {
      camera_.target = Vec3(0, 0, 0.8 + 0.01 * i);
      right_ = std::move(*truth_->shade(frame()));
      auto beside = frame();
      beside.camera.target.z +=
          glm::length(camera_.target - camera_.eye) * camera_.fovY.radians() / camera_.height / 512;
      fn(std::move(*truth_->shade(beside)));
    }
  }
};

// What differs lies at contours nearer than samples of 1/32 pixel show.
TEST_F(CompareVeilsOfABall, WhatSnappingMayChangeIsNearAnEdge) {
  std::size_t differing = 0;
  forEachView(1, [&](const shadow::Shading& beside) {
    const VeilAgreement a = compareWith(beside);
    differing += a.differing;
    EXPECT_EQ(a.astray, 0u);
  });
  EXPECT_GT(differing, 0u);
}

// Where a neighbour of another filter is shown, the filter may be missing or be there twice.
TEST_F(CompareVeilsOfABall, BordersOfFiltersAreEdgesAndNoOthers) {
  for (const std::uint32_t glasses : {1u, 2u}) {
    std::size_t changed = 0, astray = 0;
    forEachView(glasses, [&](shadow::Shading beside) {
      for (std::size_t pixel = 0; pixel < right_.surface.triangle.size(); ++pixel) {
        const auto mine = beside.veils.at(pixel), theirs = right_.veils.at(pixel);
        if (mine.size() != 2 || theirs.size() != 2 || mine[0].triangle == theirs[0].triangle) continue;
        beside.masks[0].veils[beside.veils.first[pixel]].r ^= 0x800;
        ++changed;
      }
      astray += compareWith(beside).astray;
    });
    EXPECT_GT(changed, 0u);
    if (glasses == 1)
      EXPECT_GT(astray, 0u);
    else
      EXPECT_EQ(astray, 0u);
  }
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
