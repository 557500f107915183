#include "demo.hpp"

#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoLight.h>
#include <Inventor/nodes/SoSeparator.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model.hpp"
#include "room.hpp"

namespace umbrage::demo {
namespace {

constexpr float kModelSize = 4.0f;
const SbVec3f kFirstPlace(0, 3, 0), kSecondPlace(3.5f, 1.5f, -3.5f);
constexpr float kAmbient = 0.2f;

const char* nameOf(coin::Method method) {
  switch (method) {
    case coin::Method::zPass: return "z-pass";
    case coin::Method::zFail: return "z-fail";
    case coin::Method::rayTraced: return "ray-traced";
    case coin::Method::automatic: break;
  }
  return "automatic";
}

const char* onOff(bool on) { return on ? "on" : "off"; }
int percent(float share) { return static_cast<int>(std::lround(100.0f * share)); }

// Steps of a tenth add up to what they should be.
float stepped(float value, float by) { return std::clamp(std::round((value + by) * 100.0f) / 100.0f, 0.0f, 1.0f); }

}  // namespace

Result<std::unique_ptr<Demo>> Demo::make(const Options& options) {
  Ref<SoSeparator> model = hold(options.file.empty() ? makeKnot() : new SoSeparator);
  if (!options.file.empty()) {
    auto read = readModel(options.file);
    if (!read) return tl::unexpected(read.error());
    model = std::move(*read);
  }
  Ref<SoSeparator> root = hold(new SoSeparator);
  auto* environment = new SoEnvironment;
  environment->ambientIntensity = kAmbient;
  auto* lampPlace = new SoGroup;
  root->addChild(environment);
  root->addChild(lampPlace);
  root->addChild(makeRoom());
  auto shadows = coin::ShadowManager::make(root.get(), environment);
  if (!shadows) return tl::unexpected(shadows.error());
  std::unique_ptr<Demo> demo(new Demo(std::move(*shadows), std::move(root), *lampPlace, model.get()));
  if (const auto begun = demo->begin(options); !begun) return tl::unexpected(begun.error());
  return demo;
}

Demo::Demo(coin::ShadowManager shadows, Ref<SoSeparator> root, SoGroup& lampPlace, SoNode* model)
    : shadows_(std::move(shadows)),
      root_(std::move(root)),
      lamps_(lampPlace),
      first_(model, kModelSize, kFirstPlace),
      second_(makeTable(), 3.0f, kSecondPlace) {}

Result<void> Demo::begin(const Options& options) {
  folder_ = options.folder;
  shadows_.setMethod(options.method);
  root_->addChild(first_.node());
  if (const auto added = shadows_.addObject(first_.node()); !added) return added;
  return lamps_.toggle(0, shadows_);
}

std::string Demo::state() const {
  const auto settings = shadows_.settings();
  const SoLight& first = lamps_[0];
  return fmt::format("shadows {} | {} | sensors {} | lights {} | light 1 {} {} % | ambient {} %", onOff(shadowed()),
                     nameOf(settings.method), onOff(sensed_), lamps_.listed(), onOff(first.on.getValue()),
                     percent(first.intensity.getValue()), percent(environment().ambientIntensity.getValue()));
}

std::string Demo::work() const {
  if (!shadowed()) return "no shadows";
  if (const auto why = problem(); !why.empty()) return why;
  const auto& report = shadows_.report();
  return fmt::format("{} passes, {}", report.passes, report.method);
}

std::string Demo::problem() const {
  const auto& error = shadows_.lastError();
  return shadowed() && error ? error->text() : std::string();
}

bool Demo::shadowed() const { return shadows_.settings().sceneType != coin::SceneType::withoutShadows; }

Said Demo::toggleShadows() {
  const bool on = !shadowed();
  shadows_.setSceneType(on ? coin::SceneType::withShadows : coin::SceneType::withoutShadows);
  return fmt::format("shadows {}", onOff(on));
}

Said Demo::toggleVolumes() {
  const bool shown = shadows_.settings().sceneType != coin::SceneType::visibleVolumes;
  shadows_.setSceneType(shown ? coin::SceneType::visibleVolumes : coin::SceneType::withShadows);
  return fmt::format("shadow volumes {}", shown ? "shown" : "hidden");
}

Said Demo::toggleMethod() {
  const bool fails = shadows_.settings().method == coin::Method::zFail;
  shadows_.setMethod(fails ? coin::Method::zPass : coin::Method::zFail);
  return std::string(nameOf(shadows_.settings().method));
}

Said Demo::toggleSensors() {
  sensed_ = !sensed_;
  first_.setSensed(sensed_);
  return fmt::format("sensors {}", onOff(sensed_));
}

Said Demo::toggleLamp(std::size_t lamp) {
  if (const auto done = lamps_.toggle(lamp, shadows_); !done) return tl::unexpected(done.error());
  return fmt::format("{} {}", lamps_.nameOf(lamp), lamps_.isThere(lamp) ? "added" : "removed");
}

Said Demo::toggleFirstLamp() {
  SoLight& light = lamps_[0];
  light.on = !light.on.getValue();
  return fmt::format("light 1 {}", onOff(light.on.getValue()));
}

Said Demo::toggleSecond() {
  SoSeparator* node = second_.node();
  const auto done = hasSecond_ ? shadows_.removeObject(node) : shadows_.addObject(node);
  if (!done) return tl::unexpected(done.error());
  hasSecond_ ? root_->removeChild(node) : root_->addChild(node);
  hasSecond_ = !hasSecond_;
  return fmt::format("second object {}", hasSecond_ ? "added" : "removed");
}

Said Demo::intensify(float by) {
  SoLight& light = lamps_[0];
  light.intensity = stepped(light.intensity.getValue(), by);
  return fmt::format("light 1 at {} %", percent(light.intensity.getValue()));
}

Said Demo::brighten(float by) {
  environment().ambientIntensity = stepped(environment().ambientIntensity.getValue(), by);
  return fmt::format("ambient light {} %", percent(environment().ambientIntensity.getValue()));
}

Said Demo::move(float x, float y, float z) {
  first_.move({x, y, z});
  return fmt::format("object 1 moved by {:g} {:g} {:g}", x, y, z);
}

Said Demo::scale(float factor) {
  if (!first_.scale(factor)) return std::string("object 1 is as large or small as it can be");
  return fmt::format("object 1 {:.2g} times as large", factor);
}

Said Demo::exportVolumes() {
  const auto file = folder_ / "ShadowVolumes.iv";
  if (const auto done = shadows_.exportVolumes(file); !done) return tl::unexpected(done.error());
  return "shadow volumes written to " + file.string();
}

Said Demo::exportScene() {
  const auto file = folder_ / "SceneRoot.iv";
  if (const auto done = shadows_.exportScene(file); !done) return tl::unexpected(done.error());
  return "scene written to " + file.string();
}

}  // namespace umbrage::demo
