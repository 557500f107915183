#include "umbrage/coin/shadow_manager.hpp"

#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoSeparator.h>

#include <algorithm>

#include "umbrage/base/check.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/coin/detail/engine.hpp"
#include "umbrage/coin/detail/lights.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/inventor/check.hpp"
#include "umbrage/inventor/full_path.hpp"
#include "umbrage/inventor/written.hpp"

namespace umbrage::coin {
namespace {

using detail::NodeRef;

bool isBelow(SoNode* root, SoNode* node) {
  SoSearchAction search;
  search.setNode(node);
  search.setSearchingAll(TRUE);
  search.apply(root);
  return search.getPath() != nullptr;
}

SoEnvironment* firstEnvironment(SoNode* root) {
  SoSearchAction search;
  search.setType(SoEnvironment::getClassTypeId());
  search.setSearchingAll(TRUE);
  search.apply(root);
  if (search.getPath() == nullptr) return nullptr;
  return static_cast<SoEnvironment*>(inventor::FullPath(*search.getPath()).tail());
}

bool holds(const std::vector<NodeRef>& nodes, const SoNode* node) {
  return std::ranges::any_of(nodes, [&](const NodeRef& known) { return known.get() == node; });
}

Result<void> add(std::vector<NodeRef>& nodes, SoNode* node, const char* what) {
  if (node == nullptr) return fail(ErrorCode::usage, std::string("no ") + what);
  if (holds(nodes, node))
    return fail(ErrorCode::usage, std::string("this ") + what + " is there already", node->getName().getString());
  nodes.push_back(detail::hold(node));
  return {};
}

Result<void> remove(std::vector<NodeRef>& nodes, const SoNode* node, const char* what) {
  if (std::erase_if(nodes, [&](const NodeRef& known) { return known.get() == node; }) == 0)
    return fail(ErrorCode::usage, std::string("this ") + what + " was not added");
  return {};
}

}  // namespace

struct ShadowManager::State {
  NodeRef sceneRoot, root, environment;

  [[nodiscard]] SoExactShadowGroup& group() const { return static_cast<SoExactShadowGroup&>(*root); }
  [[nodiscard]] detail::Engine& engine() const { return group().engine(); }
  [[nodiscard]] detail::Registry& registry() const { return engine().registry(); }
  /// The volumes as they are at this moment, in the coordinates of the scene root.
  [[nodiscard]] Result<SoSeparator*> volumes() const;
};

Result<SoSeparator*> ShadowManager::State::volumes() const {
  SoPath* down = new SoPath(root.get());
  down->ref();
  SoSeparator* made = engine().volumesOf(*down, group().settings());
  down->unref();
  if (made == nullptr)
    return fail(ErrorCode::usage, "there are no volumes: no light that is on, or no object that casts");
  return made;
}

ShadowManager::ShadowManager(std::unique_ptr<State> state) : state_(std::move(state)) {}
ShadowManager::ShadowManager(ShadowManager&&) noexcept = default;
ShadowManager& ShadowManager::operator=(ShadowManager&&) noexcept = default;
ShadowManager::~ShadowManager() = default;

Result<ShadowManager> ShadowManager::make(SoNode* sceneRoot, SoEnvironment* environment) {
  if (sceneRoot == nullptr) return fail(ErrorCode::input, "there is no scene");
  UMBRAGE_CHECK(SoExactShadowGroup::getClassTypeId() != SoType::badType(), "coin::init() first");
  auto state = std::make_unique<State>();
  state->sceneRoot = detail::hold(sceneRoot);
  if (auto fine = inventor::checkGraph(sceneRoot); !fine) return tl::unexpected(fine.error());
  SoEnvironment* known = environment != nullptr ? environment : firstEnvironment(sceneRoot);
  auto* group = new SoExactShadowGroup;
  state->root = detail::hold(group);
  state->environment = detail::hold(known != nullptr ? known : new SoEnvironment);
  if (!isBelow(sceneRoot, state->environment.get())) group->addChild(state->environment.get());
  group->addChild(sceneRoot);
  group->engine().registry() = {};
  return ShadowManager(std::move(state));
}

Result<void> ShadowManager::addLight(SoNode* light) {
  if (light != nullptr && !detail::isLight(*light))
    return fail(ErrorCode::usage, "this is no light", light->getTypeId().getName().getString());
  auto done = add(state_->registry().lights, light, "light");
  if (done) state_->root->touch();
  return done;
}

Result<void> ShadowManager::removeLight(SoNode* light) {
  auto done = remove(state_->registry().lights, light, "light");
  if (done) state_->root->touch();
  return done;
}

Result<void> ShadowManager::addObject(SoNode* object) {
  auto done = add(state_->registry().objects, object, "object");
  if (done) state_->root->touch();
  return done;
}

Result<void> ShadowManager::addObject(const SoPath* object) {
  if (object == nullptr || inventor::FullPath(*object).length() == 0) return fail(ErrorCode::usage, "no object");
  auto& places = state_->registry().places;
  if (std::ranges::any_of(places, [&](const detail::Place& place) { return place.is(*object); }))
    return fail(ErrorCode::usage, "this object is there already");
  places.emplace_back(*object);
  state_->root->touch();
  return {};
}

Result<void> ShadowManager::removeObject(SoNode* object) {
  auto done = remove(state_->registry().objects, object, "object");
  if (done) state_->root->touch();
  return done;
}

Result<void> ShadowManager::removeObject(const SoPath* object) {
  auto& places = state_->registry().places;
  const bool known =
      object != nullptr && std::erase_if(places, [&](const detail::Place& place) { return place.is(*object); }) > 0;
  if (!known) return fail(ErrorCode::usage, "this object was not added");
  state_->root->touch();
  return {};
}

void ShadowManager::setMethod(Method method) { state_->group().method = static_cast<int>(method); }

void ShadowManager::setSceneType(SceneType type) {
  state_->group().isActive = type != SceneType::withoutShadows;
  state_->group().showVolumes = type == SceneType::visibleVolumes;
}

void ShadowManager::setTransparentCasters(TransparentCasters casters) {
  state_->group().transparentCasters = static_cast<int>(casters);
}

void ShadowManager::setVolumeDepth(std::optional<double> depth) {
  UMBRAGE_CHECK(!depth || *depth > 0.0, "depth of volumes");
  state_->group().volumeDepth = float(depth.value_or(0.0));
}

Settings ShadowManager::settings() const { return state_->group().settings(); }

void ShadowManager::recompute(SoNode* object) {
  state_->engine().extractor().forget(object);
  state_->root->touch();
}

SoSeparator* ShadowManager::shadowSceneRoot() const { return &state_->group(); }
SoEnvironment* ShadowManager::environment() const { return static_cast<SoEnvironment*>(state_->environment.get()); }

Result<void> ShadowManager::exportScene(const std::filesystem::path& file) {
  const auto volumes = state_->volumes();
  if (!volumes) return tl::unexpected(volumes.error());
  auto* both = new SoSeparator;
  const NodeRef held = detail::hold(both);
  // Beside the scene's own children, so that a camera among them is the volumes' too.
  SoNode* scene = state_->sceneRoot.get();
  if (scene->isOfType(SoGroup::getClassTypeId()))
    for (int i = 0; i < static_cast<SoGroup*>(scene)->getNumChildren(); ++i)
      both->addChild(static_cast<SoGroup*>(scene)->getChild(i));
  else
    both->addChild(scene);
  both->addChild(*volumes);
  return writeFile(file, inventor::written(both));
}

Result<void> ShadowManager::exportVolumes(const std::filesystem::path& file) {
  const auto volumes = state_->volumes();
  if (!volumes) return tl::unexpected(volumes.error());
  return writeFile(file, inventor::written(*volumes));
}

const Work& ShadowManager::work() const { return state_->group().work(); }
const ShadowReport& ShadowManager::report() const { return state_->group().report(); }
const std::optional<Error>& ShadowManager::lastError() const { return state_->group().lastError(); }

}  // namespace umbrage::coin
