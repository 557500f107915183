#include "umbrage/render/pass_list.hpp"

#include <gtest/gtest.h>

#include "approval/approval.hpp"

namespace umbrage::render {
namespace {

constexpr gl::Rect kAll{0, 0, 64, 36};

gl::PassState placement() {
  gl::PassState state;
  state.viewport = kAll;
  return state;
}

PassList wholeFrame(const std::vector<LightPlan>& lights, Product product) {
  PassList list = planSurfaces(placement(), true);
  for (const PassStep& step : planLights(placement(), true, lights, product).steps) list.steps.push_back(step);
  return list;
}

TEST(PlanPasses, ZFailForOneLight) {
  const LightPlan light{
      .groups = {{.failSides = true, .failCaps = true}}, .volumeArea = {8, 4, 20, 20}, .litArea = kAll};
  EXPECT_TRUE(approval::approved("passes_zfail", describe(wholeFrame({light}, Product::masks))));
}

TEST(PlanPasses, ZPassFromInsideTwoVolumesWithOneCasterByZFail) {
  const LightPlan light{.groups = {{.eyeCount = 2, .passSides = true, .failSides = true, .failCaps = true}},
                        .volumeArea = kAll,
                        .litArea = kAll};
  EXPECT_TRUE(approval::approved("passes_zpass", describe(wholeFrame({light}, Product::masks))));
}

TEST(PlanPasses, PictureWithASunAndASpot) {
  const LightPlan sun{.groups = {{.passSides = true}}, .volumeArea = kAll, .litArea = kAll};
  const LightPlan spot{.groups = {{.eyeCount = 1, .passSides = true}}, .volumeArea = kAll, .litArea = {10, 10, 8, 8}};
  EXPECT_TRUE(approval::approved("passes_picture", describe(wholeFrame({sun, spot}, Product::picture))));
}

TEST(PlanPasses, HostStencilWithOrdinaryDepth) {
  gl::PassState host = placement();
  host.clipDepth = gl::ClipDepth::minusOneToOne;
  const LightPlan light{.groups = {{.failSides = true, .failCaps = true}}, .volumeArea = kAll, .litArea = kAll};
  EXPECT_TRUE(approval::approved("passes_host", describe(planLights(host, false, {light}, Product::hostStencil))));
}

TEST(PlanPasses, SeveralGroupsShareTheStencil) {
  const GroupPlan group{.eyeCount = 129, .passSides = true};
  const LightPlan light{.groups = {group, group}, .volumeArea = kAll, .litArea = kAll};
  EXPECT_TRUE(
      approval::approved("passes_groups", describe(planLights(placement(), true, {light}, Product::hostStencil))));
}

TEST(PlanPasses, WrapsTheEyeCountIntoEightBits) {
  const LightPlan light{.groups = {{.eyeCount = 257}}, .volumeArea = kAll, .litArea = kAll};
  const PassList list = planLights(placement(), true, {light}, Product::hostStencil);
  ASSERT_EQ(list.steps.size(), 1u);
  EXPECT_EQ(list.steps[0].clearStencil, 1);
}

TEST(PlanPasses, ZpPlusDrawsCastersFirst) {
  const LightPlan light{
      .groups = {{.nearCasters = true, .passSides = true}}, .finite = true, .volumeArea = kAll, .litArea = kAll};
  EXPECT_TRUE(approval::approved("passes_zp_plus", describe(wholeFrame({light}, Product::masks))));
}

TEST(PlanPasses, OneFaceAtATimeWithoutTwoSidedStencil) {
  const LightPlan light{
      .groups = {{.failSides = true, .failCaps = true}}, .twoSided = false, .volumeArea = kAll, .litArea = kAll};
  EXPECT_TRUE(approval::approved("passes_one_sided", describe(wholeFrame({light}, Product::masks))));
}

TEST(PlanPasses, DepthBoundsHoldForVolumesAlone) {
  const LightPlan light{.groups = {{.passSides = true, .failSides = true, .failCaps = true}},
                        .volumeArea = kAll,
                        .litArea = kAll,
                        .depthBounds = {{0.25f, 0.5f}}};
  const PassList list = wholeFrame({light}, Product::masks);
  for (const PassStep& step : list.steps) {
    const bool volume = step.draw == Draw::passSides || step.draw == Draw::failSides || step.draw == Draw::failCaps;
    EXPECT_EQ(step.state.depthBounds.has_value(), volume) << step.name;
  }
  EXPECT_NE(describe(list).find("depth bounds 0.25"), std::string::npos);
}

// Else a count that has to go below 0 on the way would stop there.
TEST(PlanPasses, CountersThatSaturateCountUpBeforeTheyCountDown) {
  const LightPlan light{.groups = {{.failSides = true, .failCaps = true, .turnedSides = true}},
                        .volumeArea = kAll,
                        .litArea = kAll,
                        .overflow = Overflow::saturates};
  std::string order;
  for (const PassStep& step : wholeFrame({light}, Product::masks).steps)
    for (const gl::StencilFace& face : {step.state.stencil.front, step.state.stencil.back}) {
      if (face.depthFail == gl::StencilOp::incrementToLimit) order += '+';
      if (face.depthFail == gl::StencilOp::decrementToLimit) order += '-';
    }
  EXPECT_EQ(order, "+++---");
}

// The same corners in the same order, so up and down are exchanged.
TEST(PlanPasses, TurnedSidesCountTheOtherWayRound) {
  const LightPlan light{.groups = {{.failSides = true, .turnedSides = true}}, .volumeArea = kAll, .litArea = kAll};
  gl::StencilState straight, turned;
  for (const PassStep& step : wholeFrame({light}, Product::masks).steps) {
    if (step.draw == Draw::failSides) straight = step.state.stencil;
    if (step.draw == Draw::turnedSides) turned = step.state.stencil;
  }
  EXPECT_TRUE(straight.test && turned.test);
  EXPECT_EQ(straight.front, turned.back);
  EXPECT_EQ(straight.back, turned.front);
  EXPECT_FALSE(straight.front == straight.back);
}

TEST(PlanPasses, TilesOfReceivers) {
  EXPECT_TRUE(approval::approved("passes_tiles", describe(planTiles(0, {0, 0, 4, 3}))));
}

TEST(PlanPasses, DrawsNothingForALightThatReachesNoPixel) {
  const LightPlan light{.groups = {{.failSides = true, .failCaps = true}}, .volumeArea = kAll, .litArea = {}};
  EXPECT_TRUE(planLights(placement(), true, {light}, Product::hostStencil).steps.empty());
}

}  // namespace
}  // namespace umbrage::render
