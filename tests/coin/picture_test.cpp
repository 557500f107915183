#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoTranslation.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <optional>

#include "coin/judged.hpp"
#include "state/host_state.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/gl/stencil_pixels.hpp"
#include "umbrage/gl/stencil_window.hpp"
#include "umbrage/inventor/written.hpp"

namespace umbrage::coin::test {
namespace {

TEST(Picture, IsRightByEveryMethod) {
  STAGE_OR_SKIP(stage);
  image::RgbaImage first;
  for (const char* method : {"RAY_TRACED", "AUTOMATIC", "Z_PASS", "Z_FAIL"}) {
    const auto root = sceneOf(room(std::string("method ") + method, kThreeLights, kSolids));
    judged(*stage, root.get(), method);
    EXPECT_GT(groupOf(root.get())->report().passes, 3u);
  }
}

TEST(Picture, KeepsTexturesFogAndMaterials) {
  STAGE_OR_SKIP(stage);
  const std::string look =
      "Environment { fogType HAZE fogColor 0.5 0.5 0.6 fogVisibility 25 ambientIntensity 0.4 ambientColor 1 0.9 0.8 }\n"
      "Texture2 { image 2 2 3 0xffffff 0x8080ff 0xff8080 0x80ff80 }\n";
  const auto root = sceneOf(room("", look + kThreeLights, kSolids));
  judged(*stage, root.get(), "textures_and_fog");
}

TEST(Picture, CastsThroughTransparentShapesAsAsked) {
  STAGE_OR_SKIP(stage);
  const std::string pane =
      "Separator { Translation { translation 0 2 2 } Material { transparency 0.6 diffuseColor 0 0 1 } Cube { width 2 "
      "height 0.1 depth 2 } }\n"
      "Separator { Translation { translation -3 2 0 } Material { transparency 1 } Sphere { } }\n";
  const auto root = sceneOf(room("", kOneLight, kSolids + pane));
  auto* group = groupOf(root.get());
  judged(*stage, root.get(), "pane_casts_nothing");
  const std::size_t without = shadowed(group->report().lights.at(0));
  const auto plain = sceneOf(room("", kOneLight, kSolids));
  stage->draw(plain.get());
  EXPECT_EQ(without, shadowed(groupOf(plain.get())->report().lights.at(0)));
  group->transparentCasters = SoExactShadowGroup::OPAQUE;
  const auto casting = stage->draw(root.get());
  EXPECT_GT(shadowed(group->report().lights.at(0)), without + 100);
  save(casting, "coin_pane_casts");
}

TEST(Picture, DrawsTransparentShapesOnceWhateverTheTypeOfTransparency) {
  STAGE_OR_SKIP(stage);
  const std::string pane =
      "Separator { Translation { translation 0 0.5 3 } Material { transparency 0.5 diffuseColor 0 0 1 } Cube { width 2 "
      "height 2 depth 0.1 } }\n"
      "Annotation { Translation { translation 2 0 3 } Material { transparency 0.3 } Cube { width 0.5 height 0.5 depth "
      "0.5 } }\n";
  for (const auto type :
       {SoGLRenderAction::NONE, SoGLRenderAction::SCREEN_DOOR, SoGLRenderAction::ADD, SoGLRenderAction::DELAYED_ADD,
        SoGLRenderAction::BLEND, SoGLRenderAction::DELAYED_BLEND, SoGLRenderAction::SORTED_OBJECT_ADD,
        SoGLRenderAction::SORTED_OBJECT_BLEND, SoGLRenderAction::SORTED_OBJECT_SORTED_TRIANGLE_BLEND}) {
    stage->action().setTransparencyType(type);
    const auto root = sceneOf(room("", kThreeLights, kSolids + pane));
    auto* group = groupOf(root.get());
    const auto picture = stage->draw(root.get());
    ASSERT_FALSE(group->lastError()) << group->lastError()->text();
    EXPECT_GT(group->report().passes, 3u);
    expectCoinsOwnPicture(*stage, root.get(), *group, picture);
    save(picture, "coin_transparency_" + std::to_string(type));
  }
}

TEST(Picture, WithoutAStencilIsCoinsOwnAndSaysSo) {
  const auto stage = Stage::make(kWidth, kHeight, false);
  if (!stage) GTEST_SKIP() << "no OpenGL here";
  const auto root = sceneOf(room("", kThreeLights, kSolids));
  auto* group = groupOf(root.get());
  const auto picture = stage->draw(root.get());
  ASSERT_TRUE(group->lastError());
  EXPECT_EQ(group->lastError()->code, ErrorCode::device);
  group->isActive = FALSE;
  EXPECT_EQ(largestDifference(picture, stage->draw(root.get()), [](int, int) { return true; }).most, 0);
}

TEST(Picture, HasItsShadowsInEveryFrameUnderCoinsCaches) {
  STAGE_OR_SKIP(stage);
  const CachesAsCoinHasThem caches;
  for (const std::string caching : {"AUTO", "ON"}) {
    const auto root =
        sceneOf("Separator { " + kCamera + " Separator { renderCaching " + caching +
                " Separator { Cube { } DEF GROUP ExactShadowGroup { " + kThreeLights + kSolids + "} } } }");
    auto* group = groupOf(root.get());
    const auto first = stage->draw(root.get());
    expectTrueShadows(*group, caching);
    EXPECT_GT(group->report().passes, 3u);
    for (int frame = 0; frame < 40; ++frame) {
      const auto picture = stage->draw(root.get());
      ASSERT_FALSE(group->lastError()) << caching << " frame " << frame << ": " << group->lastError()->text();
      ASSERT_EQ(largestDifference(first, picture, [](int, int) { return true; }).pixels, 0u)
          << caching << " frame " << frame;
    }
    find<SoPointLight>(root.get(), "LAMP")->location = SbVec3f(-3, 5, 4);
    EXPECT_GT(largestDifference(first, stage->draw(root.get()), [](int, int) { return true; }).pixels, 1000u)
        << caching;
    expectTrueShadows(*group, caching);
  }
}

TEST(Picture, OfAGroupInsideAnotherIsTheOutersAndSaysSo) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room("", kThreeLights, "DEF INNER ExactShadowGroup { " + kSolids + "}"));
  stage->draw(root.get());
  EXPECT_FALSE(groupOf(root.get())->lastError());
  expectTrueShadows(*groupOf(root.get()), "nested");
  const auto& error = find<SoExactShadowGroup>(root.get(), "INNER")->lastError();
  ASSERT_TRUE(error);
  EXPECT_NE(error->message.find("inside another"), std::string::npos) << error->text();
}

TEST(Picture, ShowsCachedShapesBelowWithTheRightLights) {
  STAGE_OR_SKIP(stage);
  auto caches = std::make_optional<CachesAsCoinHasThem>();
  const auto root = sceneOf(room("", "", "Separator { renderCaching ON " + kThreeLights + kSolids + "}"));
  auto* group = groupOf(root.get());
  group->isActive = FALSE;
  for (int i = 0; i < 4; ++i) stage->draw(root.get());  // Coin makes its caches, lights and all
  group->isActive = TRUE;
  image::RgbaImage picture;
  for (int i = 0; i < 4; ++i) picture = stage->draw(root.get());
  caches.reset();
  expectTrueShadows(*group, "cached");
  expectCoinsOwnPicture(*stage, root.get(), *group, picture);
}

TEST(Picture, FewLightsOfASharedNodeAreToldApart) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room(
      "",
      "Separator { DEF LAMP PointLight { location 3 5 4 } }\n Separator { USE LAMP } PointLight { location -3 5 4 }\n",
      kSolids));
  auto* group = groupOf(root.get());
  stage->draw(root.get());
  ASSERT_TRUE(group->lastError());
  EXPECT_EQ(group->lastError()->code, ErrorCode::unsupported);
  EXPECT_EQ(group->report().lights.size(), 1u);
}

std::pair<std::string, std::string> floorAndSolids() {
  const std::size_t ball = kSolids.find("DEF BALL");
  return {kSolids.substr(0, ball), kSolids.substr(ball)};
}

/// Pixels that shadows change.
std::size_t changed(Stage& stage, const std::string& shapes, const std::string& name) {
  const auto root = sceneOf(room("", kThreeLights, shapes));
  const auto picture = stage.draw(root.get());
  save(picture, "coin_" + name);
  groupOf(root.get())->isActive = FALSE;
  const auto lit = stage.draw(root.get());
  std::size_t count = 0;
  for (std::size_t i = 0; i < lit.size(); ++i) count += picture.pixels()[i] != lit.pixels()[i];
  return count;
}

TEST(Picture, ShowsShadowsOnlyOnWhatIsShadowed) {
  STAGE_OR_SKIP(stage);
  const auto [floor, solids] = floorAndSolids();
  const std::string bright = "ShadowStyle { style CASTS_SHADOW }\n", usual = "ShadowStyle { }\n";
  EXPECT_EQ(changed(*stage, bright + kSolids, "bright"), 0u);
  const std::size_t onFloor = changed(*stage, usual + floor + bright + solids, "bright_solids");
  const std::size_t onSolids = changed(*stage, bright + floor + usual + solids, "bright_floor");
  EXPECT_GT(onFloor, 1000u);
  EXPECT_GT(onSolids, 300u);
  EXPECT_EQ(changed(*stage, kSolids, "all_shadowed"), onFloor + onSolids);
}

TEST(Picture, TakesTheLightsAndCullingOfShadowGroupsForOrdinaryOnes) {
  STAGE_OR_SKIP(stage);
  const std::string spot = "SpotLight { location -4 6 2 direction 0.6 -1 -0.3 cutOffAngle 0.5 }\n";
  const std::string sun = "DirectionalLight { direction 0.7 -1 -0.4 color 0.4 1 0.5 intensity 0.5 }\n";
  const auto usual = sceneOf(room("", spot + sun, kSolids));
  const auto theirs =
      sceneOf(room("", "Shadow" + spot + "Shadow" + sun + "ShadowCulling { mode NO_CULLING }", kSolids));
  const auto expected = stage->draw(usual.get());
  EXPECT_EQ(largestDifference(expected, stage->draw(theirs.get()), [](int, int) { return true; }).most, 0);
  EXPECT_EQ(groupOf(theirs.get())->report().lights.size(), 2u);
}

TEST(Picture, CastsNothingWithAStyleThatDoesNotCast) {
  STAGE_OR_SKIP(stage);
  const auto [floor, solids] = floorAndSolids();
  EXPECT_EQ(changed(*stage, floor + "ShadowStyle { style NO_SHADOWING }\n" + solids, "casts_nothing"), 0u);
}

TEST(Picture, LightsThatAreOffAreNone) {
  STAGE_OR_SKIP(stage);
  const auto root =
      sceneOf(room("", "PointLight { on FALSE } DirectionalLight { intensity 0 } PointLight { color 0 0 0 }", kSolids));
  stage->draw(root.get());
  EXPECT_TRUE(groupOf(root.get())->report().lights.empty());
  EXPECT_EQ(groupOf(root.get())->report().passes, 1u);
}

TEST(Picture, ByALightBeyondAllDistancesIsThatOfItsDirection) {
  STAGE_OR_SKIP(stage);
  for (const std::string method : {"RAY_TRACED", "AUTOMATIC", "Z_PASS", "Z_FAIL"}) {
    const auto far = sceneOf(room("method " + method, "PointLight { location 3e20 5e20 4e20 }", kSolids));
    const auto sun = sceneOf(room("method " + method, "DirectionalLight { direction -3 -5 -4 }", kSolids));
    stage->draw(far.get());
    stage->draw(sun.get());
    ASSERT_EQ(groupOf(far.get())->report().lights.size(), 1u) << method;
    EXPECT_EQ(groupOf(far.get())->report().lights[0].mask.light, groupOf(sun.get())->report().lights[0].mask.light)
        << method;
  }
}

TEST(Picture, OfMoreLightsThanOpenGlHasIsThatOfTheFirst) {
  STAGE_OR_SKIP(stage);
  std::string eight;
  for (int i = 0; i < 8; ++i)
    eight +=
        "PointLight { intensity 0.15 location " + std::to_string(i % 3 - 1) + " 5 " + std::to_string(i / 3) + " }\n";
  const auto with = sceneOf(room("", eight + "PointLight { location -3 6 0 color 0 1 0 }", kSolids));
  const auto without = sceneOf(room("", eight, kSolids));
  const auto picture = stage->draw(with.get());
  ASSERT_TRUE(groupOf(with.get())->lastError());
  EXPECT_NE(groupOf(with.get())->lastError()->message.find("too few lights"), std::string::npos);
  EXPECT_EQ(largestDifference(picture, stage->draw(without.get()), [](int, int) { return true; }).most, 0);
  EXPECT_FALSE(groupOf(without.get())->lastError());
}

TEST(Picture, KnowsNothingOfShapesUnderAnotherCamera) {
  STAGE_OR_SKIP(stage);
  const std::string hud =
      "OrthographicCamera { position 0 0 5 nearDistance 1 farDistance 10 height 2 }\n"
      "Translation { translation 0.9 0.8 0 } Cube { width 0.4 height 0.2 depth 0.4 }\n";
  const auto plain = sceneOf(room("", kOneLight, kSolids));
  stage->draw(plain.get());
  const auto& expected = groupOf(plain.get())->report().lights.at(0).mask.light;
  for (const auto& [shapes, told] : {std::pair{"Separator { " + hud + "}", true},
                                     std::pair{"Separator { LightModel { model BASE_COLOR } " + hud + "}", false},
                                     std::pair{"Annotation { " + hud + "}", false}}) {
    const auto root = sceneOf(room("", kOneLight, kSolids + shapes));
    stage->draw(root.get());
    EXPECT_EQ(groupOf(root.get())->report().lights.at(0).mask.light, expected) << shapes;
    EXPECT_EQ(groupOf(root.get())->lastError().has_value(), told) << shapes;
  }
}

TEST(Picture, HandlesOfManipulatorsCastNothing) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room("", kOneLight, kSolids + "Separator { TrackballManip { } } DragPointDragger { }"));
  const auto plain = sceneOf(room("", kOneLight, kSolids));
  const auto casting = [&](SoNode* scene) {
    stage->draw(scene);
    std::size_t count = 0;
    for (const std::uint8_t casts : groupOf(scene)->report().geometry->surfaces.casts) count += casts;
    return count;
  };
  EXPECT_EQ(casting(root.get()), casting(plain.get()));
  EXPECT_GT(groupOf(root.get())->report().geometry->surfaces.triangles.size(),
            groupOf(plain.get())->report().geometry->surfaces.triangles.size());
}

TEST(Picture, OfNothingHasAnEmptyReport) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room("", kOneLight, kSolids));
  auto* group = groupOf(root.get());
  stage->draw(root.get());
  ASSERT_EQ(group->report().lights.size(), 1u);
  while (group->getNumChildren() > 1) group->removeChild(1);  // the lamp stays
  stage->draw(root.get());
  EXPECT_TRUE(group->report().lights.empty());
  EXPECT_EQ(group->report().passes, 1u);
  EXPECT_FALSE(group->lastError());
}

TEST(Picture, LeavesTheHostsStateAlone) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room("", kThreeLights, kSolids));
  const auto plain = sceneOf(room("isActive FALSE", kThreeLights, kSolids));
  state::WildHost host(true);
  stage->enter();
  stage->draw(plain.get());
  const auto before = host.snapshot();
  stage->draw(plain.get());
  const auto without = host.snapshot();
  stage->draw(root.get());
  const auto with = host.snapshot();
  EXPECT_EQ(state::difference(without, with), "");
  EXPECT_EQ(state::difference(before, with), "");
  // Coin goes on as if nothing had been: the next picture is what it was.
  const auto picture = stage->draw(plain.get());
  EXPECT_EQ(largestDifference(picture, stage->draw(plain.get()), [](int, int) { return true; }).most, 0);
}

/// A framebuffer with four samples a pixel.
class Sampled {
 public:
  Sampled() {
    glCreateFramebuffers(1, &framebuffer_);
    glCreateRenderbuffers(1, &buffer_);
    glNamedRenderbufferStorageMultisample(buffer_, 4, GL_DEPTH24_STENCIL8, 16, 16);
    glNamedFramebufferRenderbuffer(framebuffer_, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, buffer_);
  }
  Sampled(const Sampled&) = delete;
  Sampled& operator=(const Sampled&) = delete;
  ~Sampled() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &buffer_);
  }
  void bind() const { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_); }

 private:
  unsigned framebuffer_ = 0, buffer_ = 0;
};

// What is done between Coin's passes, in hosts of every state.
TEST(Picture, StencilsLeaveWildHostsAlone) {
  STAGE_OR_SKIP(stage);
  state::WildHost host(true);
  const Sampled sampled;
  const std::vector<std::uint8_t> values(12, 5);
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    host.randomise(seed);
    if (seed % 4 == 0) sampled.bind();
    const auto before = host.snapshot();
    {
      gl::HostScope scope;
      const auto written = gl::writeStencil(scope, values, {3, 4, 4, 3});
      ASSERT_TRUE(written) << written.error().text();
      gl::fillStencil(scope, 7, {0, 0, 9, 9});
    }
    { const gl::StencilWindow window(5, {1, 2, 30, 40}); }
    ASSERT_EQ(state::difference(before, host.snapshot()), "") << "seed " << seed;
  }
}

TEST(Picture, LightsKeepWhatTheyAreConnectedTo) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room("", kThreeLights, kSolids));
  auto* lamp = find<SoPointLight>(root.get(), "LAMP");
  const auto master = hold(new SoPointLight);
  master->intensity = 0.7f;
  lamp->intensity.connectFrom(&master->intensity);
  const auto picture = stage->draw(root.get());
  EXPECT_TRUE(lamp->intensity.isConnected());
  EXPECT_EQ(lamp->intensity.getValue(), 0.7f);
  EXPECT_EQ(largestDifference(picture, stage->draw(root.get()), [](int, int) { return true; }).most, 0);
  master->intensity = 0.3f;
  EXPECT_GT(largestDifference(picture, stage->draw(root.get()), [](int, int) { return true; }).pixels, 1000u);
  EXPECT_EQ(lamp->intensity.getValue(), 0.3f);
}

TEST(Picture, BlackLightsOfVrmlAreAsTheyWere) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room("", "DEF LAMP VRMLPointLight { location 3 5 4 ambientIntensity 0.2 }", kSolids));
  const std::string before = inventor::written(root.get());
  stage->draw(root.get());
  EXPECT_EQ(groupOf(root.get())->report().passes, 2u);
  EXPECT_EQ(inventor::written(root.get()), before);
}

TEST(Picture, LeavesTheGraphAlone) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room("", kThreeLights, kSolids));
  const std::string before = inventor::written(root.get());
  const auto id = root->getNodeId();
  stage->draw(root.get());
  EXPECT_EQ(root->getNodeId(), id);
  EXPECT_EQ(inventor::written(root.get()), before);
}

TEST(Picture, ComesBackFromAFile) {
  STAGE_OR_SKIP(stage);
  const auto root = sceneOf(room("method Z_FAIL transparentCasters OPAQUE volumeDepth 3", kThreeLights, kSolids));
  std::string file = inventor::written(root.get());
  SoInput input;
  input.setBuffer(file.data(), file.size());
  const auto again = hold(SoDB::readAll(&input));
  auto* group = groupOf(again.get());
  ASSERT_NE(group, nullptr);
  EXPECT_EQ(group->method.getValue(), int(SoExactShadowGroup::Z_FAIL));
  EXPECT_EQ(group->transparentCasters.getValue(), int(SoExactShadowGroup::OPAQUE));
  EXPECT_EQ(group->volumeDepth.getValue(), 3.0f);
  // Numbers are written with fewer digits than they have.
  const auto found =
      largestDifference(stage->draw(root.get()), stage->draw(again.get()), [](int, int) { return true; });
  EXPECT_LE(found.pixels, 20u);
}

TEST(Picture, ShowsVolumesThroughWhichTheSceneIsSeen) {
  STAGE_OR_SKIP(stage);
  for (const char* depth : {"0", "2"}) {
    const auto root = sceneOf(room(std::string("showVolumes TRUE volumeDepth ") + depth, kOneLight, kSolids));
    const auto shown = stage->draw(root.get());
    groupOf(root.get())->showVolumes = FALSE;
    const auto plain = stage->draw(root.get());
    const auto found = largestDifference(shown, plain, [](int, int) { return true; });
    EXPECT_GT(found.pixels, 3000u);
    EXPECT_LT(found.pixels, 70000u);
    save(shown, std::string("coin_volumes_") + depth);
  }
}

}  // namespace
}  // namespace umbrage::coin::test
