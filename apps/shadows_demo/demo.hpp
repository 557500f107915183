#pragma once

#include <memory>
#include <string>

#include "keys.hpp"
#include "lamps.hpp"
#include "options.hpp"
#include "prop.hpp"
#include "umbrage/coin/shadow_manager.hpp"

class SoEnvironment;

namespace umbrage::demo {

/// The scene of the demo and what its keys do to it; knows nothing of windows.
class Demo {
 public:
  /// Errors: those of readModel and of coin::ShadowManager.
  [[nodiscard]] static Result<std::unique_ptr<Demo>> make(const Options& options);

  /// What viewers show, each with a camera of its own before it.
  [[nodiscard]] SoSeparator* scene() const { return shadows_.shadowSceneRoot(); }
  /// How everything stands, in one line.
  [[nodiscard]] std::string state() const;

  /// How the last picture got its shadows.
  [[nodiscard]] std::string work() const;
  /// Why it has none, or not all; empty where it has what it should.
  [[nodiscard]] std::string problem() const;

  // One for each key (keys.cpp).
  [[nodiscard]] Said toggleShadows();
  [[nodiscard]] Said toggleVolumes();
  [[nodiscard]] Said toggleMethod();
  [[nodiscard]] Said toggleSensors();
  [[nodiscard]] Said toggleLamp(std::size_t lamp);
  [[nodiscard]] Said toggleFirstLamp();
  [[nodiscard]] Said toggleSecond();
  [[nodiscard]] Said intensify(float by);
  [[nodiscard]] Said brighten(float by);
  [[nodiscard]] Said move(float x, float y, float z);
  [[nodiscard]] Said scale(float factor);
  [[nodiscard]] Said exportVolumes();
  [[nodiscard]] Said exportScene();

 private:
  Demo(coin::ShadowManager shadows, Ref<SoSeparator> root, SoGroup& lampPlace, SoNode* model);
  [[nodiscard]] Result<void> begin(const Options& options);
  [[nodiscard]] bool shadowed() const;
  [[nodiscard]] SoEnvironment& environment() const { return *shadows_.environment(); }

  coin::ShadowManager shadows_;
  Ref<SoSeparator> root_;
  Lamps lamps_;
  Prop first_, second_;
  std::filesystem::path folder_;
  bool sensed_ = true, hasSecond_ = false;
};

}  // namespace umbrage::demo
