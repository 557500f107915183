// A viewer of SoQt with exact shadows: a lamp, a floor, a ball that swings, and a shadow that follows with no further call.
#include <Inventor/Qt/SoQt.h>
#include <Inventor/Qt/viewers/SoQtExaminerViewer.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShuttle.h>
#include <Inventor/nodes/SoSphere.h>

#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/coin/shadow_manager.hpp"

int main(int, char** words) {
  QWidget* window = SoQt::init(words[0]);
  umbrage::coin::init();

  auto* root = new SoSeparator;
  auto* lamp = new SoPointLight;
  lamp->location.setValue(3, 6, 4);
  auto* floor = new SoCube;
  floor->width = floor->depth = 12;
  floor->height = 0.2f;
  auto* swing = new SoShuttle;
  swing->translation0.setValue(-3, 2, 0);
  swing->translation1.setValue(3, 2, 0);
  auto* ball = new SoSphere;
  for (SoNode* node : std::initializer_list<SoNode*>{lamp, floor, swing, ball}) root->addChild(node);

  auto shadows = umbrage::coin::ShadowManager::make(root);
  if (!shadows || !shadows->addLight(lamp) || !shadows->addObject(ball)) return 1;

  SoQtExaminerViewer viewer(window);
  viewer.setStencilBuffer(TRUE);
  viewer.setHeadlight(FALSE);
  viewer.setSceneGraph(shadows->shadowSceneRoot());
  viewer.show();
  SoQt::show(window);
  SoQt::mainLoop();
}
