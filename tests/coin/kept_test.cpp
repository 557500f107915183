#include <Inventor/SoDB.h>
#include <Inventor/fields/SoSFTime.h>
#include <Inventor/nodes/SoClipPlane.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSwitch.h>
#include <Inventor/nodes/SoTranslation.h>
#include <gtest/gtest.h>

#include "coin/judged.hpp"

// What is kept from picture to picture, counted; and that whatever changes, the shadows are those of a group that has never drawn before.
namespace umbrage::coin::test {
namespace {

const std::string kCameraToMove =
    "DEF EYE PerspectiveCamera { position 1 3 8 orientation -1 0.2 0 0.32 nearDistance 0.5 farDistance 40 heightAngle "
    "0.8 }\n";
const std::string kHints = "DEF HINTS ShapeHints { vertexOrdering COUNTERCLOCKWISE }\n";
const std::string kPlane = "DEF PLANE ClipPlane { on FALSE plane 0 1 0 0.4 }\n";
const std::string kChoice =
    "DEF CHOICE Switch { whichChild -3 Separator { Translation { translation 0 2 1 } Cube { width 0.7 } } }\n";

void expectSameMasks(const ShadowReport& a, const ShadowReport& b, const std::string& what) {
  ASSERT_EQ(a.lights.size(), b.lights.size()) << what;
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].reach.light, b.lights[i].reach.light) << what;
    EXPECT_EQ(a.lights[i].reach.covered, b.lights[i].reach.covered) << what;
    EXPECT_EQ(a.lights[i].mask.light, b.lights[i].mask.light) << what;
  }
}

/// By each way to find shadows that keeps what the camera sees.
class Kept : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    stage_ = Stage::make(kWidth, kHeight);
    if (!stage_) GTEST_SKIP() << "no OpenGL here";
    begin(kOneLight, kHints + kPlane + kSolids + kChoice);
  }
  void begin(const std::string& lights, const std::string& shapes) {
    root_ = sceneOf(room(std::string("method ") + GetParam(), lights, shapes, kCameraToMove));
    group_ = groupOf(root_.get());
    drawn(*stage_, "first");
    if (group_->report().method != "hybrid_cpu" && group_->report().method != "ray_traced")
      GTEST_SKIP() << "on a graphics card nothing is kept";
  }
  template <class Node>
  Node* named(const char* name) {
    return find<Node>(root_.get(), name);
  }
  void expectWork(const std::string& what, std::size_t shades, std::size_t views) {
    expectWork(*stage_, what, shades, views);
  }
  void expectWork(Stage& stage, const std::string& what, std::size_t shades, std::size_t views) {
    const Work before = group_->work();
    const Work after = drawn(stage, what);
    EXPECT_EQ(after.shades - before.shades, shades) << what;
    EXPECT_EQ(after.views - before.views, views) << what;
  }
  /// Holds the picture against rays, and against one of a group that knows nothing.
  Work drawn(Stage& stage, const std::string& what) {
    const auto picture = stage.draw(root_.get());
    const Work work = group_->work();
    EXPECT_FALSE(group_->lastError()) << what << ": " << group_->lastError()->text();
    expectTrueShadows(*group_, what);
    const auto fresh = hold(static_cast<SoSeparator*>(root_->copy()));
    const auto expected = stage.draw(fresh.get());
    expectSameMasks(group_->report(), groupOf(fresh.get())->report(), what);
    EXPECT_EQ(largestDifference(picture, expected, [](int, int) { return true; }).most, 0) << what;
    return work;
  }

  std::unique_ptr<Stage> stage_;
  Ref<> root_;
  SoExactShadowGroup* group_ = nullptr;
};

TEST_P(Kept, WhatIsSeenWhereALightMoves) {
  expectWork("nothing", 0, 0);
  for (int i = 0; i < 3; ++i) {
    named<SoPointLight>("LAMP")->location = SbVec3f(2.0f - float(i), 5, 4);
    expectWork("moved light", 1, 0);
  }
  expectWork("nothing again", 0, 0);
  named<SoPointLight>("LAMP")->on = FALSE;
  const Work before = group_->work();
  stage_->draw(root_.get());
  EXPECT_EQ(group_->work().shades, before.shades);
  named<SoPointLight>("LAMP")->on = TRUE;
  expectWork("light", 1, 0);
}

TEST_P(Kept, NothingOfWhatIsSeenWhereTheEyeOrAnObjectMoves) {
  named<SoPerspectiveCamera>("EYE")->position = SbVec3f(1.2f, 3, 8);
  expectWork("moved eye", 1, 1);
  named<SoPerspectiveCamera>("EYE")->heightAngle = 0.9f;
  expectWork("wider view", 1, 1);
  named<SoPerspectiveCamera>("EYE")->nearDistance = 0.6f;  // no surface is nearer
  expectWork("near plane", 1, 0);
  named<SoTranslation>("BALLAT")->translation = SbVec3f(-1, 0.5f, 0.5f);
  expectWork("moved object", 1, 1);
  named<SoCube>("CUBE")->height = 1.1f;
  expectWork("changed shape", 1, 1);
  named<SoPointLight>("LAMP")->location = SbVec3f(2, 5, 4);
  expectWork("moved light", 1, 0);
}

TEST_P(Kept, NothingOfWhatIsSeenWhereSomethingIsHidden) {
  auto* choice = named<SoSwitch>("CHOICE");
  for (int i = 0; i < 2; ++i) {
    choice->whichChild = SO_SWITCH_NONE;
    expectWork("hidden", 1, 1);
    named<SoPointLight>("LAMP")->location = SbVec3f(2, 5, 4 + float(i));
    expectWork("light over what is left", 1, 0);
    choice->whichChild = SO_SWITCH_ALL;
    expectWork("there again", 1, 1);
  }
}

TEST_P(Kept, NothingOfWhatIsSeenWhereItIsCut) {
  auto* plane = named<SoClipPlane>("PLANE");
  plane->on = TRUE;
  expectWork("cut", 1, 1);
  plane->plane = SbPlane(SbVec3f(0, 1, 0), -0.2f);
  expectWork("cut elsewhere", 1, 1);
  named<SoPointLight>("LAMP")->location = SbVec3f(2, 5, 4);
  expectWork("light where it is cut", 1, 0);
  plane->on = FALSE;
  expectWork("whole", 1, 1);
}

TEST_P(Kept, WhatLiesBehindCulledFacesWhereALightMoves) {
  begin(kOneLight,
        kHints +
            "FaceSet { vertexProperty VertexProperty { vertex [ -1 0 2, -1 2 2, 1 2 2, 1 0 2 ] } numVertices 4 "
            "}\n" +
            kSolids);
  if (IsSkipped()) return;
  named<SoShapeHints>("HINTS")->shapeType = SoShapeHints::SOLID;  // the sheet turns its back to the eye
  expectWork("looked through", 1, 1);
  for (int i = 0; i < 2; ++i) {
    named<SoPointLight>("LAMP")->location = SbVec3f(2.0f - float(i), 5, 4);
    expectWork("moved light", 1, 0);
  }
  named<SoShapeHints>("HINTS")->shapeType = SoShapeHints::UNKNOWN_SHAPE_TYPE;
  expectWork("seen again", 1, 1);
}

TEST_P(Kept, WhatIsSeenWhereALightThatShinesOnFewMoves) {
  begin(kOneLight, kHints + kSolids + "DEF LATE PointLight { location -2 4 3 }\n" + kChoice);
  if (IsSkipped()) return;
  named<SoPointLight>("LATE")->location = SbVec3f(-2, 4, 2);
  expectWork("moved light", 1, 0);
  named<SoPerspectiveCamera>("EYE")->position = SbVec3f(1.2f, 3, 8);
  expectWork("moved eye", 1, 1);
}

TEST_P(Kept, NothingOfWhatIsSeenInOtherWindows) {
  const auto other = Stage::make(200, 150);
  ASSERT_TRUE(other);
  for (int i = 0; i < 2; ++i) {
    other->enter();
    expectWork(*other, "small window", 1, 1);
    named<SoPointLight>("LAMP")->location = SbVec3f(2, 5, 4 + float(i));
    expectWork(*other, "light in the small window", 1, 0);
    stage_->enter();
    expectWork("large window", 1, 1);
  }
  SbViewportRegion part(kWidth, kHeight);
  part.setViewportPixels(40, 30, 160, 120);
  stage_->action().setViewportRegion(part);
  expectWork("part of the window", 1, 1);
  part.setViewportPixels(60, 30, 160, 120);
  stage_->action().setViewportRegion(part);
  expectWork("as large a part elsewhere", 1, 0);
}

// Nothing is written into the graph: an engine turns the shape by the clock.
TEST_P(Kept, NothingOfWhatIsSeenWhereTheClockTurnsAShape) {
  begin(
      kOneLight,
      "Separator { Rotor { rotation 0 1 0 0.1 speed 0.13 } Translation { translation 1 1.5 0 } Cube { } }\n" + kSolids);
  if (IsSkipped()) return;
  auto* now = static_cast<SoSFTime*>(SoDB::getGlobalField("realTime"));
  ASSERT_NE(now, nullptr);
  const SbTime start = now->getValue();
  for (int i = 1; i <= 3; ++i) {
    now->setValue(start + SbTime(0.7 * i));
    const Work before = group_->work();
    const auto picture = stage_->draw(root_.get());
    EXPECT_EQ(group_->work().poses - before.poses, 1u);
    EXPECT_EQ(group_->work().views - before.views, 1u);
    expectTrueShadows(*group_, "turned");
    expectCoinsOwnPicture(*stage_, root_.get(), *group_, picture);
  }
  now->setValue(start);
}

INSTANTIATE_TEST_SUITE_P(Methods, Kept, testing::Values("AUTOMATIC", "RAY_TRACED"),
                         [](const auto& method) { return std::string(method.param); });

}  // namespace
}  // namespace umbrage::coin::test
