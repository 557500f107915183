#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPath.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoTransform.h>
#include <Inventor/nodes/SoTranslation.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "coin/scenes.hpp"
#include "coin/stage.hpp"
#include "coin/truth.hpp"
#include "umbrage/coin/shadow_manager.hpp"

namespace umbrage::coin::test {
namespace {

std::size_t castingTriangles(const ShadowReport& report) {
  std::size_t count = 0;
  for (const std::uint8_t casts : report.geometry->surfaces.casts) count += casts;
  return count;
}

/// A scene with a camera, a manager over it, and a window.
class Managed : public testing::Test {
 protected:
  void SetUp() override {
    stage_ = Stage::make(320, 240);
    if (!stage_) GTEST_SKIP() << "no OpenGL here";
    begin(kOneLight + kSolids);
  }
  void begin(const std::string& scene) {
    scene_ = sceneOf("DEF ROOT Separator { " + kCamera + scene + "}");
    auto made = ShadowManager::make(scene_.get());
    ASSERT_TRUE(made) << made.error().text();
    manager_.emplace(std::move(*made));
  }
  void addAll() {
    ASSERT_TRUE(manager_->addLight(named<SoNode>("LAMP")));
    for (const char* name : {"FLOOR", "BALL", "BOX", "PIPE"}) ASSERT_TRUE(manager_->addObject(named<SoNode>(name)));
  }
  template <class Node>
  Node* named(const char* name) {
    return find<Node>(scene_.get(), name);
  }
  /// Draws, holds the mask against rays, and tells what had to be worked out for it.
  Work drawn(const std::string& what) {
    const Work before = manager_->work();
    stage_->draw(manager_->shadowSceneRoot());
    EXPECT_FALSE(manager_->lastError()) << what << ": " << manager_->lastError()->text();
    const Strayed s = strayed(manager_->report());
    EXPECT_EQ(s.far, 0u) << what;
    Work work = manager_->work();
    work.extractions -= before.extractions;
    work.poses -= before.poses;
    work.geometryBuilds -= before.geometryBuilds;
    work.shades -= before.shades;
    work.volumes -= before.volumes;
    work.volumesReused -= before.volumesReused;
    return work;
  }

  std::unique_ptr<Stage> stage_;
  Ref<> scene_;
  std::optional<ShadowManager> manager_;
};

void expectWork(const Work& work, std::size_t extractions, std::size_t poses, std::size_t builds, std::size_t shades) {
  EXPECT_EQ(work.extractions, extractions);
  EXPECT_EQ(work.poses, poses);
  EXPECT_EQ(work.geometryBuilds, builds);
  EXPECT_EQ(work.shades, shades);
}

TEST_F(Managed, CastsWhatWasAddedAndNothingElse) {
  addAll();
  ASSERT_TRUE(manager_->removeObject(named<SoNode>("BOX")));
  drawn("without the box");
  const std::size_t without = castingTriangles(manager_->report());
  ASSERT_TRUE(manager_->addObject(named<SoNode>("BOX")));
  drawn("with the box");
  EXPECT_EQ(castingTriangles(manager_->report()), without + 12);
  ASSERT_TRUE(manager_->removeLight(named<SoNode>("LAMP")));
  stage_->draw(manager_->shadowSceneRoot());
  EXPECT_TRUE(manager_->report().lights.empty());
}

TEST_F(Managed, RefusesWhatMakesNoSense) {
  addAll();
  EXPECT_FALSE(ShadowManager::make(nullptr));
  EXPECT_FALSE(manager_->addLight(nullptr));
  EXPECT_FALSE(manager_->addLight(named<SoNode>("BOX")));
  EXPECT_FALSE(manager_->addLight(named<SoNode>("LAMP")));
  EXPECT_FALSE(manager_->addObject(static_cast<SoNode*>(nullptr)));
  EXPECT_FALSE(manager_->addObject(static_cast<SoPath*>(nullptr)));
  EXPECT_FALSE(manager_->addObject(named<SoNode>("BOX")));
  EXPECT_FALSE(manager_->removeObject(named<SoNode>("CUBE")));
  EXPECT_FALSE(manager_->removeLight(named<SoNode>("BOX")));
}

TEST_F(Managed, ASceneThatContainsItselfIsRefused) {
  const auto loop = hold(new SoSeparator);
  auto* inner = new SoSeparator;
  loop->addChild(inner);
  inner->addChild(loop.get());
  const auto made = ShadowManager::make(loop.get());
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::input);
  inner->removeAllChildren();
}

TEST_F(Managed, NothingIsDoneTwiceForNothing) {
  addAll();
  expectWork(drawn("first"), 4, 0, 1, 1);
  expectWork(drawn("again"), 0, 0, 0, 0);
}

TEST_F(Managed, AMovedLightCostsItsShadowsAlone) {
  addAll();
  drawn("first");
  named<SoPointLight>("LAMP")->location = SbVec3f(2, 5, 4);
  expectWork(drawn("moved light"), 0, 0, 0, 1);
  named<SoPointLight>("LAMP")->intensity = 0.5f;
  expectWork(drawn("dimmed light"), 0, 0, 0, 0);
}

TEST_F(Managed, AMovedObjectIsPosedAnew) {
  addAll();
  drawn("first");
  named<SoTranslation>("BALLAT")->translation = SbVec3f(-1, 0.5f, 0.5f);
  expectWork(drawn("moved object"), 0, 1, 1, 1);
}

TEST_F(Managed, AMovedAncestorMovesAllBelow) {
  auto* above = new SoTransform;
  named<SoSeparator>("ROOT")->insertChild(above, 2);  // after camera and light
  addAll();
  drawn("first");
  above->rotation.setValue(SbVec3f(0, 1, 0), 0.3f);
  expectWork(drawn("moved ancestor"), 0, 4, 1, 1);
}

TEST_F(Managed, AChangedShapeIsReadAlone) {
  addAll();
  drawn("first");
  named<SoCube>("CUBE")->height = 2.0f;
  expectWork(drawn("changed shape"), 1, 0, 1, 1);
}

TEST_F(Managed, AColourChangesNoShadow) {
  addAll();
  drawn("first");
  auto* paint = new SoMaterial;
  named<SoSeparator>("BOX")->insertChild(paint, 0);
  expectWork(drawn("painted"), 0, 0, 0, 0);
  paint->transparency = 0.5f;  // but this is under the box's own material
  expectWork(drawn("still under another"), 0, 0, 0, 0);
}

TEST_F(Managed, ANodeInsertedAboveMovesWithoutReading) {
  addAll();
  drawn("first");
  auto* root = named<SoSeparator>("ROOT");
  auto* box = named<SoSeparator>("BOX");
  auto held = hold(box);
  auto* between = new SoSeparator;
  auto* move = new SoTranslation;
  move->translation = SbVec3f(0.2f, 0.4f, 0);
  between->addChild(move);
  root->replaceChild(box, between);
  between->addChild(box);
  expectWork(drawn("inserted above"), 0, 1, 1, 1);
}

TEST_F(Managed, AVanishedObjectCastsNothingAndComesBackUnread) {
  addAll();
  drawn("first");
  const std::size_t all = castingTriangles(manager_->report());
  auto* root = named<SoSeparator>("ROOT");
  auto box = hold(named<SoSeparator>("BOX"));
  root->removeChild(box.get());
  expectWork(drawn("gone"), 0, 0, 1, 1);
  EXPECT_EQ(castingTriangles(manager_->report()), all - 12);
  root->addChild(box.get());
  expectWork(drawn("back"), 0, 0, 1, 1);
  EXPECT_EQ(castingTriangles(manager_->report()), all);
}

TEST_F(Managed, ReadsAgainWhatIsForced) {
  addAll();
  drawn("first");
  auto* cube = named<SoCube>("CUBE");
  cube->height.enableNotify(FALSE);
  cube->height = 0.5f;
  cube->height.enableNotify(TRUE);
  expectWork(drawn("nobody was told"), 0, 0, 0, 0);
  manager_->recompute(named<SoNode>("BOX"));
  expectWork(drawn("forced"), 1, 0, 1, 1);
}

TEST_F(Managed, TellsPlacesOfASharedNodeApart) {
  begin(kOneLight +
        "DEF FLOOR Separator { Translation { translation 0 -1 0 } Cube { width 12 depth 12 height 0.1 } }\n"
        "DEF ONE Separator { DEF MOVE Translation { translation -1.5 0 0 } DEF SHARED Cube { } }\n"
        "DEF TWO Separator { Translation { translation 1.5 0 0 } USE SHARED Translation { translation 0 0 -3 } USE "
        "SHARED }\n");
  ASSERT_TRUE(manager_->addLight(named<SoNode>("LAMP")));
  SoNode* shared = named<SoNode>("SHARED");
  const auto pathTo = [&](const char* parent, int child) {
    auto* path = new SoPath(scene_.get());
    path->ref();
    path->append(named<SoNode>(parent));
    path->append(child);
    return path;
  };
  SoPath* places[] = {pathTo("ONE", 1), pathTo("TWO", 1), pathTo("TWO", 3)};
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(places[i]->getTail(), shared);
    ASSERT_TRUE(manager_->addObject(places[i]));
    EXPECT_FALSE(manager_->addObject(places[i]));
    const Work work = drawn("places");
    EXPECT_EQ(castingTriangles(manager_->report()), 12 * (i + 1));
    EXPECT_EQ(work.extractions, i == 0 ? 2u : 0u);  // one shape, however many places, and the floor
  }
  ASSERT_TRUE(manager_->removeObject(places[1]));
  drawn("one place less");
  EXPECT_EQ(castingTriangles(manager_->report()), 24u);
  ASSERT_TRUE(manager_->addObject(shared));
  drawn("by node: wherever it stands");
  EXPECT_EQ(castingTriangles(manager_->report()), 36u);
  EXPECT_FALSE(manager_->addObject(shared));
  for (SoPath* path : places) path->unref();
}

TEST_F(Managed, FindsTheEnvironmentOrMakesOne) {
  EXPECT_NE(manager_->environment(), nullptr);
  EXPECT_EQ(find<SoNode>(scene_.get(), "AIR"), nullptr);
  begin("DEF AIR Environment { ambientIntensity 0.7 }" + kOneLight + kSolids);
  EXPECT_EQ(manager_->environment(), named<SoNode>("AIR"));
  auto own = hold(new SoEnvironment);
  auto made = ShadowManager::make(scene_.get(), own.get());
  ASSERT_TRUE(made);
  EXPECT_EQ(made->environment(), own.get());
}

TEST_F(Managed, OutlivesItselfInTheViewer) {
  addAll();
  const auto root = hold(manager_->shadowSceneRoot());
  const auto before = stage_->draw(root.get());
  manager_.reset();
  const auto after = stage_->draw(root.get());
  EXPECT_EQ(largestDifference(before, after, [](int, int) { return true; }).most, 0);
}

TEST_F(Managed, ChoosesMethodAndSceneType) {
  addAll();
  for (const auto& [method, name] : {std::pair{Method::zPass, "zpass"}, std::pair{Method::zFail, "zfail"},
                                     std::pair{Method::rayTraced, "ray_traced"}}) {
    manager_->setMethod(method);
    drawn(name);
    EXPECT_EQ(manager_->report().method, name);
  }
  const auto shadows = stage_->draw(manager_->shadowSceneRoot());
  manager_->setSceneType(SceneType::withoutShadows);
  const auto without = stage_->draw(manager_->shadowSceneRoot());
  manager_->setSceneType(SceneType::visibleVolumes);
  const auto volumes = stage_->draw(manager_->shadowSceneRoot());
  const auto everywhere = [](int, int) { return true; };
  EXPECT_GT(largestDifference(shadows, without, everywhere).pixels, 1000u);
  EXPECT_GT(largestDifference(shadows, volumes, everywhere).pixels, 3000u);
}

TEST_F(Managed, ATranslatedCasterUnderADirectionalLightKeepsItsVolume) {
  begin("DEF LAMP DirectionalLight { direction 0.4 -1 -0.3 }\n" + kSolids);
  addAll();
  manager_->setSceneType(SceneType::visibleVolumes);
  EXPECT_EQ(drawn("first").volumes, 4u);
  named<SoTranslation>("BALLAT")->translation = SbVec3f(-1, 0.5f, 0.5f);
  Work work = drawn("moved along");
  EXPECT_EQ(work.volumes, 0u);
  EXPECT_EQ(work.volumesReused, 4u);
  named<SoTransform>("BOXAT")->rotation.setValue(SbVec3f(0, 1, 0), 1.0f);
  work = drawn("turned");
  EXPECT_EQ(work.volumes, 1u);
  EXPECT_EQ(work.volumesReused, 3u);
}

TEST_F(Managed, ExportsScenesAndVolumesThatCoinReads) {
  addAll();
  const auto folder = std::filesystem::path(testing::TempDir());
  const auto all = folder / "umbrage_scene.iv", alone = folder / "umbrage_volumes.iv";
  for (const std::optional<double> depth : {std::optional<double>(), std::optional<double>(2.5)}) {
    manager_->setVolumeDepth(depth);
    ASSERT_TRUE(manager_->exportScene(all));
    ASSERT_TRUE(manager_->exportVolumes(alone));
    const auto read = [](const std::filesystem::path& file) {
      SoInput input;
      EXPECT_TRUE(input.openFile(file.c_str()));
      return hold(SoDB::readAll(&input));
    };
    const auto scene = read(all), volumes = read(alone);
    ASSERT_NE(scene, nullptr);
    ASSERT_NE(volumes, nullptr);
    EXPECT_NE(find<SoNode>(scene.get(), "BOX"), nullptr);
    EXPECT_EQ(find<SoNode>(volumes.get(), "BOX"), nullptr);
    SoGetBoundingBoxAction bounds(SbViewportRegion(320, 240));
    bounds.apply(volumes.get());
    const SbVec3f size = bounds.getBoundingBox().getMax() - bounds.getBoundingBox().getMin();
    EXPECT_GT(size.length(), depth ? 10.0f : 30.0f);
    EXPECT_LT(size.length(), 200.0f);
    const auto picture = stage_->draw(scene.get());  // with its camera: volumes over the scene
    save(picture, depth ? "coin_export_near" : "coin_export_far");
    const auto plain = stage_->draw(scene_.get());
    EXPECT_GT(largestDifference(picture, plain, [](int, int) { return true; }).pixels, 3000u);
  }
  std::filesystem::remove(all);
  std::filesystem::remove(alone);
  EXPECT_EQ(manager_->exportScene("/nowhere/at/all.iv").error().code, ErrorCode::output);
  ASSERT_TRUE(manager_->removeLight(named<SoNode>("LAMP")));
  EXPECT_EQ(manager_->exportVolumes(alone).error().code, ErrorCode::usage);
  EXPECT_FALSE(std::filesystem::exists(alone));
}

}  // namespace
}  // namespace umbrage::coin::test
