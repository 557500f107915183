#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::support {

/// A technique whose frames ask for something more.
class Asking final : public shadow::Technique {
 public:
  using Ask = std::function<void(shadow::Frame&)>;
  Asking(std::unique_ptr<shadow::Technique> inner, Ask ask) : inner_(std::move(inner)), ask_(std::move(ask)) {}
  [[nodiscard]] const shadow::Traits& traits() const override { return inner_->traits(); }
  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    return inner_->prepare(std::move(geometry));
  }
  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    shadow::Frame asked = frame;
    ask_(asked);
    return inner_->shade(asked);
  }

 private:
  std::unique_ptr<shadow::Technique> inner_;
  Ask ask_;
};

/// The same row of a registry, asking.
inline shadow::TechniqueEntry asking(shadow::TechniqueEntry entry, std::string name, Asking::Ask ask) {
  const auto create = entry.create;
  entry.traits.name = std::move(name);
  entry.create = [create, ask]() -> Result<std::unique_ptr<shadow::Technique>> {
    auto made = create();
    if (!made) return made;
    return std::make_unique<Asking>(std::move(*made), ask);
  };
  return entry;
}

}  // namespace umbrage::support
