#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/nodes/SoCamera.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoSpotLight.h>
#include <Inventor/nodes/SoTransform.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "coin/scenes.hpp"
#include "coin/stage.hpp"
#include "coin/truth.hpp"
#include "umbrage/coin/shadow_manager.hpp"

// A scene graph that is edited at random, and drawn. UMBRAGE_EDITS says how often (scripts/sweep: 10,000), one in 50 is held against rays.
namespace umbrage::coin::test {
namespace {

constexpr int kEdits = 300;
constexpr int kPerSample = 50;

int editCount() {
  const char* given = std::getenv("UMBRAGE_EDITS");
  return given != nullptr ? std::atoi(given) : kEdits;
}

/// Edits one scene graph. Everything it has ever made is registered, or not, by chance.
class Editor {
 public:
  Editor(SoSeparator* root, ShadowManager& manager, std::uint32_t seed)
      : root_(root), manager_(manager), random_(seed) {
    for (int i = 0; i < 6; ++i) insert();
  }

  void edit() {
    switch (number(0, 12)) {
      case 0:
      case 1: return insert();
      case 2: return remove();
      case 3:
      case 4: return move();
      case 5: return replace();
      case 6:
      case 7: return changeShape();
      case 8: return changeLight();
      case 9: return changeRegistry();
      case 10: return putAbove();
      case 11: return moveEye();
      default: return paint();
    }
  }
  /// The same lights and objects that the manager has.
  void registerWith(ShadowManager& other) const {
    for (const auto& node : lights_) EXPECT_TRUE(other.addLight(node.get()));
    for (const auto& node : objects_) EXPECT_TRUE(other.addObject(node.get()));
  }
  [[nodiscard]] std::size_t lights() { return all(SoLight::getClassTypeId()).size(); }

 private:
  int number(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  float real(float low, float high) { return std::uniform_real_distribution(low, high)(random_); }
  SbVec3f point() { return {real(-3, 3), real(-0.5f, 2), real(-3, 3)}; }

  /// Nodes of a type that are in the graph now.
  std::vector<SoNode*> all(SoType type) {
    SoSearchAction search;
    search.setType(type);
    search.setInterest(SoSearchAction::ALL);
    search.apply(root_);
    std::vector<SoNode*> found;
    for (int i = 0; i < search.getPaths().getLength(); ++i)
      found.push_back(inventor::FullPath(*search.getPaths()[i]).tail());
    return found;
  }
  template <class Node>
  Node* any() {
    const auto found = all(Node::getClassTypeId());
    return found.empty() ? nullptr : static_cast<Node*>(found[std::size_t(number(0, int(found.size()) - 1))]);
  }

  SoNode* shape() {
    switch (number(0, 3)) {
      case 0: return new SoCube;
      case 1: return new SoSphere;
      case 2: return new SoCone;
      default: return new SoCylinder;
    }
  }
  SoLight* light() {
    if (number(0, 2) == 0) return new SoDirectionalLight;
    auto* made = new SoPointLight;
    made->location = point() + SbVec3f(0, 4, 0);
    return made;
  }

  void insert() {
    if (number(0, 5) == 0 && lights() < 4) {
      SoLight* made = light();
      root_->insertChild(made, 1);
      add(made);
      return;
    }
    if (all(SoShape::getClassTypeId()).size() > 24) return remove();
    auto* object = new SoSeparator;
    auto* place = new SoTransform;
    place->translation = point();
    place->scaleFactor = SbVec3f(0.4f, 0.5f, 0.4f);
    object->addChild(place);
    // Now and then a shape that stands somewhere already.
    SoNode* known = number(0, 3) == 0 ? any<SoShape>() : nullptr;
    object->addChild(known != nullptr ? known : shape());
    root_->addChild(object);
    if (number(0, 3) != 0) add(object);
  }
  void remove() {
    if (root_->getNumChildren() < 4) return;
    const int index = number(1, root_->getNumChildren() - 1);
    root_->removeChild(index);
  }
  void move() {
    if (auto* place = any<SoTransform>()) {
      place->translation = point();
      if (number(0, 1) == 0) place->rotation.setValue(SbVec3f(0, 1, 0.2f), real(0, 3));
    }
  }
  void replace() {
    const int index = number(1, root_->getNumChildren() - 1);
    SoNode* old = root_->getChild(index);
    if (!old->isOfType(SoSeparator::getClassTypeId())) return;
    auto* object = static_cast<SoSeparator*>(old);
    object->replaceChild(object->getNumChildren() - 1, shape());
  }
  void changeShape() {
    if (auto* cube = any<SoCube>()) cube->height = real(0.5f, 2);
    if (auto* ball = any<SoSphere>(); ball != nullptr && number(0, 2) == 0) ball->radius = real(0.3f, 1.2f);
  }
  void changeLight() {
    if (auto* lamp = any<SoPointLight>()) lamp->location = point() + SbVec3f(0, 4, 0);
    if (auto* lamp = any<SoLight>(); lamp != nullptr && number(0, 3) == 0) lamp->on = !lamp->on.getValue();
  }
  void moveEye() {
    auto* camera = any<SoPerspectiveCamera>();
    camera->position = SbVec3f(real(0, 2), real(2.5f, 3.5f), real(7.5f, 8.5f));
    if (number(0, 1) == 0) camera->heightAngle = real(0.7f, 0.9f);
  }
  void changeRegistry() {
    SoNode* node = root_->getChild(number(1, root_->getNumChildren() - 1));
    if (node->isOfType(SoCamera::getClassTypeId()) || node->isOfType(SoMaterial::getClassTypeId())) return;
    const bool isLight = node->isOfType(SoLight::getClassTypeId()) != FALSE;
    if (std::erase_if(isLight ? lights_ : objects_, [&](const auto& known) { return known.get() == node; }) == 0)
      return add(node);
    EXPECT_TRUE(isLight ? manager_.removeLight(node) : manager_.removeObject(node));
  }
  void add(SoNode* node) {
    const bool isLight = node->isOfType(SoLight::getClassTypeId()) != FALSE;
    EXPECT_TRUE(isLight ? manager_.addLight(node) : manager_.addObject(node));
    (isLight ? lights_ : objects_).push_back(hold(node));
  }
  void putAbove() {
    const int index = number(1, root_->getNumChildren() - 1);
    auto held = hold(root_->getChild(index));
    if (!held->isOfType(SoSeparator::getClassTypeId())) return;
    auto* above = new SoSeparator;
    auto* place = new SoTransform;
    place->translation = SbVec3f(real(-0.3f, 0.3f), 0, real(-0.3f, 0.3f));
    above->addChild(place);
    root_->replaceChild(index, above);
    above->addChild(held.get());
  }
  void paint() {
    auto* material = new SoMaterial;
    material->transparency = number(0, 3) == 0 ? 0.5f : 0.0f;
    root_->insertChild(material, number(1, root_->getNumChildren()));
    if (all(SoMaterial::getClassTypeId()).size() > 6) root_->removeChild(material);
  }

  SoSeparator* root_;
  ShadowManager& manager_;
  std::mt19937 random_;
  std::vector<Ref<SoNode>> lights_, objects_;
};

TEST(Edits, AtRandomLeaveTheShadowsRight) {
  const auto stage = Stage::make(160, 120);
  if (!stage) GTEST_SKIP() << "no OpenGL here";
  const auto scene =
      sceneOf("Separator { " + kCamera +
              "Separator { Translation { translation 0 -1 0 } Cube { width 12 height 0.1 depth 12 } } }");
  auto manager = ShadowManager::make(scene.get());
  ASSERT_TRUE(manager);
  Editor editor(scene.get(), *manager, 7);
  std::size_t samples = 0, shadows = 0;
  for (int i = 1; i <= editCount(); ++i) {
    editor.edit();
    stage->draw(manager->shadowSceneRoot());
    const auto& error = manager->lastError();
    ASSERT_FALSE(error) << "edit " << i << ": " << error->text();
    if (i % kPerSample != 0) continue;
    ++samples;
    shadows += manager->report().lights.size();
    const Strayed s = strayed(manager->report());
    ASSERT_EQ(s.far, 0u) << "edit " << i << ": of " << s.covered << " pixels " << s.differing << " differ";
    // Nothing that was kept is out of date: a manager that has never seen the scene finds the same.
    auto fresh = ShadowManager::make(scene.get());
    editor.registerWith(*fresh);
    const auto picture = stage->draw(manager->shadowSceneRoot());
    const auto expected = stage->draw(fresh->shadowSceneRoot());
    ASSERT_EQ(manager->report().lights.size(), fresh->report().lights.size()) << "edit " << i;
    for (std::size_t k = 0; k < fresh->report().lights.size(); ++k)
      ASSERT_EQ(manager->report().lights[k].mask.light, fresh->report().lights[k].mask.light) << "edit " << i;
    ASSERT_EQ(largestDifference(picture, expected, [](int, int) { return true; }).most, 0) << "edit " << i;
  }
  EXPECT_GT(shadows, samples / 2);
  const Work& work = manager->work();
  EXPECT_LT(work.views, work.shades);
  std::printf("%zu samples, %zu masks; %zu extractions, %zu poses, %zu builds, %zu shades, %zu views\n", samples,
              shadows, work.extractions, work.poses, work.geometryBuilds, work.shades, work.views);
}

}  // namespace
}  // namespace umbrage::coin::test
