#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <gtest/gtest.h>

#include "coin/judged.hpp"

// Cameras, viewers and windows of every kind.
namespace umbrage::coin::test {
namespace {

/// Masks know pixels as covered just where OpenGL's depth says that something was drawn, but for the borders of shapes.
void expectCoversWhatIsDrawn(const Stage& stage, const SoExactShadowGroup& group) {
  ASSERT_FALSE(group.report().lights.empty());
  const auto& covered = group.report().lights.at(0).mask.covered;
  const auto depth = stage.depth();
  std::size_t wrong = 0;
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x) {
      bool found = false;
      for (const int v : {y - 1, y, y + 1})
        for (const int u : {x - 1, x, x + 1}) found |= (covered(u, v) != 0) == (depth(x, y) < 1.0f);
      wrong += !found;
    }
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(View, KnowsTheCameraInsideTheGroupToo) {
  STAGE_OR_SKIP(stage);
  const auto outside = sceneOf(room("", kThreeLights, kSolids));
  const auto inside = sceneOf(room("", kCamera + kThreeLights, kSolids, ""));
  const auto below = sceneOf(room("", "Separator { " + kCamera + kThreeLights, kSolids + "}", ""));
  const auto expected = stage->draw(outside.get());
  EXPECT_EQ(
      largestDifference(expected, judged(*stage, inside.get(), "camera_inside"), [](int, int) { return true; }).most,
      0);
  EXPECT_EQ(
      largestDifference(expected, judged(*stage, below.get(), "camera_below"), [](int, int) { return true; }).most, 0);
}

TEST(View, IsSeenByTheCameraInsideWhereThereIsOneBeforeToo) {
  STAGE_OR_SKIP(stage);
  const std::string other =
      "PerspectiveCamera { position -2 5 9 orientation -1 -0.2 0 0.5 nearDistance 0.5 farDistance 40 }\n";
  const auto both = sceneOf(room("", kCamera + kThreeLights, kSolids, other));
  const auto one = sceneOf(room("", kThreeLights, kSolids));
  const auto expected = stage->draw(one.get());
  EXPECT_EQ(largestDifference(expected, stage->draw(both.get()), [](int, int) { return true; }).most, 0);
}

TEST(View, IsSeenByCamerasUnderTransforms) {
  STAGE_OR_SKIP(stage);
  const std::string moved = "Translation { translation 3 -1 2 } Rotation { rotation 0 1 0 0.4 }\n";
  const std::string back = "Rotation { rotation 0 1 0 -0.4 } Translation { translation -3 1 -2 }\n";
  for (const auto& before : {moved + kCamera + back, "TransformSeparator { " + moved + kCamera + "}\n", moved + kCamera,
                             "TransformSeparator { Scale { scaleFactor 2 2 2 } " + kCamera + "}\n"}) {
    SCOPED_TRACE(before);
    const auto root = sceneOf(room("", kThreeLights, kSolids, before));
    stage->draw(root.get());
    expectCoversWhatIsDrawn(*stage, *groupOf(root.get()));
    const auto inside = sceneOf(room("", before + kThreeLights, kSolids, ""));
    stage->draw(inside.get());
    expectCoversWhatIsDrawn(*stage, *groupOf(inside.get()));
  }
}

TEST(View, OfOneEyeIsRightOrRefused) {
  STAGE_OR_SKIP(stage);
  const auto inside = sceneOf(room("", kCamera + kThreeLights, kSolids, ""));
  const auto before = sceneOf(room("", kThreeLights, kSolids));
  for (const auto* root : {&inside, &before}) {
    SoSearchAction search;
    search.setType(SoPerspectiveCamera::getClassTypeId());
    search.apply(root->get());
    auto* camera = static_cast<SoCamera*>(inventor::FullPath(*search.getPath()).tail());
    camera->setStereoAdjustment(3);
    camera->setStereoMode(SoCamera::LEFT_VIEW);
    stage->draw(root->get());
    auto* group = groupOf(root->get());
    if (root == &before) expectCoversWhatIsDrawn(*stage, *group);
    EXPECT_EQ(group->lastError().has_value(), root == &inside);
    EXPECT_EQ(group->report().lights.empty(), root == &inside);
  }
}

TEST(View, HasEveryViewThatCoinHas) {
  STAGE_OR_SKIP(stage);
  const auto pinhole = sceneOf(room("", kThreeLights, kSolids));
  stage->draw(pinhole.get());
  // What lies behind a pinhole's pixels is seen by the other way, too, for the rays are the same.
  const std::string frustum =
      "FrustumCamera { position 1 3 8 orientation -1 0.2 0 0.32 nearDistance 0.5 farDistance 40 left -0.2 right 0.3 "
      "top 0.2 bottom -0.2 }\n";
  const std::string parallel =
      "OrthographicCamera { position 1 3 8 orientation -1 0.2 0 0.32 nearDistance 0.5 farDistance 40 height 6 }\n";
  for (const auto& [name, camera] : {std::pair{"frustum", frustum}, std::pair{"parallel", parallel}}) {
    const auto root = sceneOf(room("", kThreeLights, kSolids, camera));
    auto* group = groupOf(root.get());
    const auto picture = stage->draw(root.get());
    ASSERT_FALSE(group->lastError()) << group->lastError()->text();
    EXPECT_FALSE(group->report().camera);
    for (const LightShadow& light : group->report().lights) EXPECT_GT(shadowed(light), 500u) << name;
    expectCoinsOwnPicture(*stage, root.get(), *group, picture);
    save(picture, std::string("coin_") + name);
  }
}

// The general way of seeing (rays from the near plane) against the techniques' own, in a view that both can take.
TEST(View, IsTheSameByTheGeneralWayOfSeeing) {
  STAGE_OR_SKIP(stage);
  // A caster that is looked through asks for the general way; one behind the camera changes nothing else.
  const std::string behind =
      "Separator { Translation { translation 1 30 30 } Material { transparency 0.5 } Cube { width 0.1 height 0.1 depth "
      "0.1 } }\n";
  const auto root = sceneOf(room("transparentCasters OPAQUE", kThreeLights, kSolids + behind));
  auto* group = groupOf(root.get());
  stage->draw(root.get());
  EXPECT_EQ(group->report().method, "ray_traced");
  expectTrueShadows(*group, "general");
}

TEST(View, OfSeveralViewersOnOneSceneIsEachViewersOwn) {
  STAGE_OR_SKIP(first);
  const auto second = Stage::make(200, 150);
  ASSERT_TRUE(second);
  const auto scene = sceneOf("Separator { DEF GROUP ExactShadowGroup { " + kThreeLights + kSolids + "} }");
  const auto view = [&](const std::string& camera) {
    auto root = hold(new SoSeparator);
    root->addChild(sceneOf(camera).get()->getChild(0));
    root->addChild(scene->getChild(0));
    return root;
  };
  const auto one = view(kCamera);
  const auto other =
      view("PerspectiveCamera { position -5 4 5 orientation -0.55 -0.75 -0.3 0.9 nearDistance 0.5 farDistance 40 }");
  auto* group = groupOf(scene.get());
  for (int i = 0; i < 2; ++i) {
    first->enter();
    const auto here = first->draw(one.get());
    expectTrueShadows(*group, "first viewer");
    expectCoinsOwnPicture(*first, one.get(), *group, here);
    second->enter();
    const auto there = second->draw(other.get());
    expectTrueShadows(*group, "second viewer");
    expectCoinsOwnPicture(*second, other.get(), *group, there);
  }
  EXPECT_EQ(group->work().extractions, 4u);
  EXPECT_EQ(group->work().geometryBuilds, 1u);
}

// Inside shapes and shadows a pixel's samples are all alike.
TEST(View, OfWindowsWithSamplesIsTheSame) {
  STAGE_OR_SKIP(plain);
  const auto root = sceneOf(room("", kThreeLights, kSolids));
  auto* group = groupOf(root.get());
  const auto expected = plain->draw(root.get());
  const auto stage = Stage::make(kWidth, kHeight, true, 4);
  ASSERT_TRUE(stage);
  const auto picture = stage->draw(root.get());
  ASSERT_FALSE(group->lastError()) << group->lastError()->text();
  save(picture, "coin_samples");
  EXPECT_LT(largestDifference(expected, picture, [](int, int) { return true; }).pixels, 2000u);  // borders
  expectCoinsOwnPicture(*stage, root.get(), *group, picture);
  const CachesAsCoinHasThem caches;
  const auto cached = sceneOf("Separator { renderCaching ON " + room("", kThreeLights, kSolids) + "}");
  for (int i = 0; i < 4; ++i) {
    const auto again = stage->draw(cached.get());
    EXPECT_FALSE(groupOf(cached.get())->lastError());
    EXPECT_EQ(largestDifference(picture, again, [](int, int) { return true; }).pixels, 0u) << i;
  }
}

}  // namespace
}  // namespace umbrage::coin::test
