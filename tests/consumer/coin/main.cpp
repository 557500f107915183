// A host that gives its scene of Open Inventor shadows, and needs no reader of files and no pictures for it.
#include <Inventor/SoDB.h>
#include <Inventor/SoInteraction.h>
#include <Inventor/nodekits/SoNodeKit.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoSeparator.h>
#include <umbrage/coin/exact_shadow_group.hpp>
#include <umbrage/coin/shadow_manager.hpp>

int main() {
  SoDB::init();
  SoNodeKit::init();
  SoInteraction::init();
  umbrage::coin::init();
  auto* root = new SoSeparator;
  root->ref();
  auto* light = new SoPointLight;
  light->location = SbVec3f(1, 5, 2);
  auto* cube = new SoCube;
  root->addChild(light);
  root->addChild(cube);
  auto shadows = umbrage::coin::ShadowManager::make(root);
  const bool added = shadows && shadows->addLight(light) && shadows->addObject(cube);
  return added && shadows->shadowSceneRoot()->getNumChildren() == 2 ? 0 : 1;
}
