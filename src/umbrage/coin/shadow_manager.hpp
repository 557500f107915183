#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "umbrage/base/error.hpp"
#include "umbrage/coin/settings.hpp"
#include "umbrage/coin/shadow_report.hpp"

class SoEnvironment;
class SoNode;
class SoPath;
class SoSeparator;

namespace umbrage::coin {

/// The Shadow Engine for Open Inventor: gives a scene graph exact shadows of the lights and objects that are named to it.
///
///     auto shadows = ShadowManager::make(root);
///     shadows->addLight(light);  shadows->addObject(object);
///     viewer->setSceneGraph(shadows->shadowSceneRoot());
///
/// 1. The user's scene graph is not changed: it hangs, as it is, below shadowSceneRoot().
/// 2. Shadows follow whatever happens to the graph (moved lights and objects, changed shapes, nodes inserted and removed, at any level), with no
///    call, and only what changed is worked out anew (work()).
/// 3. Shapes that are no object receive shadows and cast none; lights that were not added shine everywhere.
/// 4. What is registered is kept alive; what is no longer in the scene graph does nothing until it is there again.
/// What holds for the picture holds as for SoExactShadowGroup.
/// REQUIRES: init() was called. Not thread-safe, as Coin.
/// Source: Burian, Realtime shadow algorithms (the Shadow Engine), master's thesis, Brno, 2006.
class ShadowManager {
 public:
  /// `environment`, whose ambient light shadows keep: null takes the first in the scene, or else makes one, before the scene.
  /// Errors: ErrorCode::input when the scene graph is null, contains itself, or has more than millions of nodes once all uses are followed.
  [[nodiscard]] static Result<ShadowManager> make(SoNode* sceneRoot, SoEnvironment* environment = nullptr);

  ShadowManager(ShadowManager&&) noexcept;
  ShadowManager& operator=(ShadowManager&&) noexcept;
  ~ShadowManager();

  /// A light node of the scene: SoLight or a VRML light. It need not be in the scene yet.
  /// Errors: ErrorCode::usage when it is null, no light, or there already.
  [[nodiscard]] Result<void> addLight(SoNode* light);
  /// Errors: ErrorCode::usage when it was not added.
  [[nodiscard]] Result<void> removeLight(SoNode* light);

  /// A node of the scene, with all below it, wherever in the scene it stands.
  /// Errors: ErrorCode::usage when it is null or there already.
  [[nodiscard]] Result<void> addObject(SoNode* object);
  /// One place of a node that may stand at several: a path of nodes from any node of the scene down to it. What matters are the nodes, so a path
  /// stays good when others are put before or between them.
  /// Errors: ErrorCode::usage when it is null, empty, or there already.
  [[nodiscard]] Result<void> addObject(const SoPath* object);
  /// Errors: ErrorCode::usage when it was not added.
  [[nodiscard]] Result<void> removeObject(SoNode* object);
  [[nodiscard]] Result<void> removeObject(const SoPath* object);

  void setMethod(Method method);
  void setSceneType(SceneType type);
  void setTransparentCasters(TransparentCasters casters);
  /// Of visible and exported volumes: scene units from the caster, above 0; none: to infinity, and in files three times as far as the scene is wide.
  void setVolumeDepth(std::optional<double> depth);
  [[nodiscard]] Settings settings() const;

  /// Has the triangles of every shape in or below `object` asked of Coin anew with the next picture: for shapes that change without telling
  /// Coin (fields changed with notification off, own nodes that draw from outside data).
  void recompute(SoNode* object);

  /// What to show: the environment, if it was made, and the user's scene. It lives as long as somebody holds it, also after this.
  [[nodiscard]] SoSeparator* shadowSceneRoot() const;
  [[nodiscard]] SoEnvironment* environment() const;

  /// Writes the user's scene with its shadow volumes, as they are at this moment, as an Inventor file.
  /// Errors: ErrorCode::output when the file cannot be written; ErrorCode::usage when there is no volume: no lights that are on, or no objects.
  [[nodiscard]] Result<void> exportScene(const std::filesystem::path& file);
  /// The volumes alone.
  [[nodiscard]] Result<void> exportVolumes(const std::filesystem::path& file);

  [[nodiscard]] const Work& work() const;
  [[nodiscard]] const ShadowReport& report() const;
  /// Why the last picture has no shadows, or not all of them.
  [[nodiscard]] const std::optional<Error>& lastError() const;

 private:
  struct State;
  explicit ShadowManager(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace umbrage::coin
