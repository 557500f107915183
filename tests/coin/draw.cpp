// umbrage_coin_draw FILE shadows|plain: exit code 0 drawn, 3 refused with a message, 4 no OpenGL.
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoPointLight.h>

#include <cstdio>
#include <string_view>

#include "coin/stage.hpp"
#include "umbrage/coin/shadow_manager.hpp"

namespace umbrage::coin::test {
namespace {

int refused(const std::string& why) {
  std::fprintf(stderr, "error: %s\n", why.c_str());
  return 3;
}

int draw(const char* file, bool shadows) {
  const auto stage = Stage::make(160, 120);
  if (!stage) return 4;
  SoInput input;
  if (!input.openFile(file)) return refused("cannot be opened");
  SoSeparator* read = SoDB::readAll(&input);
  if (read == nullptr) return refused("cannot be read");
  const auto root = hold(new SoSeparator);
  auto* camera = new SoPerspectiveCamera;
  auto* light = new SoPointLight;
  light->location = SbVec3f(3, 5, 4);
  for (SoNode* node : std::initializer_list<SoNode*>{camera, light, read}) root->addChild(node);
  if (!shadows) {
    stage->draw(root.get());
    return 0;
  }
  auto manager = ShadowManager::make(root.get());
  if (!manager) return refused(manager.error().text());
  const bool added = manager->addLight(light).has_value() && manager->addObject(read).has_value();
  camera->viewAll(root.get(), SbViewportRegion(160, 120));
  stage->draw(manager->shadowSceneRoot());
  return added ? 0 : refused("cannot be added");
}

}  // namespace
}  // namespace umbrage::coin::test

int main(int count, char** arguments) {
  return count == 3 ? umbrage::coin::test::draw(arguments[1], std::string_view(arguments[2]) == "shadows") : 2;
}
