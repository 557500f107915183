#include "umbrage/coin/exact_shadow_group.hpp"

#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoGetMatrixAction.h>
#include <Inventor/annex/FXViz/elements/SoShadowStyleElement.h>
#include <Inventor/annex/FXViz/nodes/SoShadowGroup.h>
#include <Inventor/annex/FXViz/nodes/SoShadowStyle.h>
#include <Inventor/elements/SoShapeStyleElement.h>
#include <Inventor/misc/SoState.h>

#include "umbrage/coin/detail/engine.hpp"

namespace umbrage::coin {

SO_NODE_SOURCE(SoExactShadowGroup);

void init() {
  if (SoExactShadowGroup::getClassTypeId() != SoType::badType()) return;
  // SoShadowStyle says what casts. Coin 4 makes it known itself, and SoDB::finish() dies of what is made known twice.
  if (SoShadowStyle::getClassTypeId() == SoType::badType()) SoShadowGroup::init();
  SO_ENABLE(SoCallbackAction, SoShadowStyleElement);  // which Coin knows only while it draws
  SO_ENABLE(SoCallbackAction, SoShapeStyleElement);   // and transparency types, too
  SoExactShadowGroup::initClass();
}

// Coin's public macro would have files say SoExactShadowGroup.
void SoExactShadowGroup::initClass() {
  PRIVATE_COMMON_INIT_CODE(SoExactShadowGroup, "ExactShadowGroup", &SoExactShadowGroup::createInstance, SoSeparator);
}

SoExactShadowGroup::SoExactShadowGroup()
    : engine_(std::make_unique<detail::Engine>(detail::Registry{.everything = true})) {
  SO_NODE_CONSTRUCTOR(SoExactShadowGroup);
  SO_NODE_ADD_FIELD(isActive, (TRUE));
  SO_NODE_ADD_FIELD(method, (AUTOMATIC));
  SO_NODE_ADD_FIELD(transparentCasters, (NONE));
  SO_NODE_ADD_FIELD(showVolumes, (FALSE));
  SO_NODE_ADD_FIELD(volumeDepth, (0.0f));
  SO_NODE_DEFINE_ENUM_VALUE(ShadowMethod, AUTOMATIC);
  SO_NODE_DEFINE_ENUM_VALUE(ShadowMethod, Z_PASS);
  SO_NODE_DEFINE_ENUM_VALUE(ShadowMethod, Z_FAIL);
  SO_NODE_DEFINE_ENUM_VALUE(ShadowMethod, RAY_TRACED);
  SO_NODE_SET_SF_ENUM_TYPE(method, ShadowMethod);
  SO_NODE_DEFINE_ENUM_VALUE(TransparentCasting, NONE);
  SO_NODE_DEFINE_ENUM_VALUE(TransparentCasting, OPAQUE);
  SO_NODE_SET_SF_ENUM_TYPE(transparentCasters, TransparentCasting);
}

SoExactShadowGroup::~SoExactShadowGroup() = default;

const Work& SoExactShadowGroup::work() const { return engine_->work(); }
const ShadowReport& SoExactShadowGroup::report() const { return engine_->report(); }
const std::optional<Error>& SoExactShadowGroup::lastError() const { return engine_->error(); }

// The fields' values are those of the settings.
static_assert(int(Method::automatic) == SoExactShadowGroup::AUTOMATIC &&
              int(Method::zPass) == SoExactShadowGroup::Z_PASS && int(Method::zFail) == SoExactShadowGroup::Z_FAIL &&
              int(Method::rayTraced) == SoExactShadowGroup::RAY_TRACED);
static_assert(int(TransparentCasters::none) == SoExactShadowGroup::NONE &&
              int(TransparentCasters::opaque) == SoExactShadowGroup::OPAQUE);

Settings SoExactShadowGroup::settings() const {
  Settings settings;
  settings.method = static_cast<Method>(method.getValue());
  settings.transparentCasters = static_cast<TransparentCasters>(transparentCasters.getValue());
  if (!isActive.getValue())
    settings.sceneType = SceneType::withoutShadows;
  else if (showVolumes.getValue())
    settings.sceneType = SceneType::visibleVolumes;
  if (volumeDepth.getValue() > 0.0f) settings.volumeDepth = double(volumeDepth.getValue());
  return settings;
}

void SoExactShadowGroup::GLRenderBelowPath(SoGLRenderAction* action) {
  if (!isActive.getValue()) return inherited::GLRenderBelowPath(action);
  engine_->render(action, settings(), [this](SoGLRenderAction* a) { SoGroup::GLRender(a); });
}

// For what Coin put off until all else is drawn: of every pass's paths only those of the first are of children.
void SoExactShadowGroup::GLRenderInPath(SoGLRenderAction* action) {
  int count = 0;
  const int* indices = nullptr;
  const SoAction::PathCode code = action->getPathCode(count, indices);
  if (code != SoAction::IN_PATH) return GLRenderBelowPath(action);
  action->getState()->push();
  int child = 0;
  for (int i = 0; i < count && indices[i] < getNumChildren() && !action->hasTerminated(); ++i) {
    for (; child <= indices[i]; ++child) {
      SoNode* node = getChild(child);
      const bool onPath = child == indices[i];
      if (!onPath && !node->affectsState()) continue;
      action->pushCurPath(child, node);
      onPath ? node->GLRenderInPath(action) : node->GLRenderOffPath(action);
      action->popCurPath(code);
    }
  }
  action->getState()->pop();
}

namespace {

// Nodes that are drawn in later passes may ask about their own path, which leads through a child that there is not.
template <class Action, class Fn>
void passingNobody(Action* action, Fn&& go) {
  int count = 0;
  const int* indices = nullptr;
  const SoAction::PathCode code = action->getPathCode(count, indices);
  const bool astray = code == SoAction::IN_PATH && count == 1 && indices[0] == detail::kNoChild;
  if (astray) action->pushCurPath(detail::kNoChild, detail::nobody());
  go();
  if (astray) action->popCurPath(code);
}

}  // namespace

void SoExactShadowGroup::getBoundingBox(SoGetBoundingBoxAction* action) {
  passingNobody(action, [&] { inherited::getBoundingBox(action); });
}

void SoExactShadowGroup::getMatrix(SoGetMatrixAction* action) {
  passingNobody(action, [&] { inherited::getMatrix(action); });
}

}  // namespace umbrage::coin
