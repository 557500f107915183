#pragma once

#include <span>
#include <vector>

class SoNode;
class SoSFFloat;

namespace umbrage::coin::detail {

/// Light nodes are black for as long as this lives, and nobody is told: no sensor fires, no cache and no node id changes, and files written later hold
/// what the user set. Coin has no hook between a light and the shapes that it shines on, so the fields themselves are switched, and back before
/// anybody else sees them. They stay on: OpenGL has few lights, and another that Coin had to drop would take the place.
class LightsOff {
 public:
  explicit LightsOff(std::span<SoNode* const> lights);
  LightsOff(const LightsOff&) = delete;
  LightsOff& operator=(const LightsOff&) = delete;
  ~LightsOff();

 private:
  struct Saved {
    SoNode* node;
    SoSFFloat* field;
    float value;
    bool wasDefault, notified;
  };
  std::vector<Saved> saved_;
};

}  // namespace umbrage::coin::detail
