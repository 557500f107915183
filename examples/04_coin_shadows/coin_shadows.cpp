// A scene of Open Inventor gets exact shadows, and is written with its shadow volumes: scene_with_volumes.iv. In a viewer, shadowSceneRoot() is what to
// show (docs/coin.md).
#include <Inventor/SoDB.h>
#include <Inventor/SoInteraction.h>
#include <Inventor/nodekits/SoNodeKit.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoSeparator.h>

#include <cstdio>

#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/coin/shadow_manager.hpp"

int main() {
  SoDB::init();
  SoNodeKit::init();
  SoInteraction::init();
  umbrage::coin::init();
  auto* root = new SoSeparator;
  root->ref();
  auto* light = new SoPointLight;
  light->location = SbVec3f(2, 4, 3);
  auto* object = new SoCone;
  root->addChild(light);
  root->addChild(object);
  auto shadows = umbrage::coin::ShadowManager::make(root);
  if (!shadows || !shadows->addLight(light) || !shadows->addObject(object)) return 1;
  shadows->setVolumeDepth(5.0);
  const auto written = shadows->exportScene("scene_with_volumes.iv");
  if (!written) std::fprintf(stderr, "%s\n", written.error().text().c_str());
  root->unref();
  return written ? 0 : 1;
}
