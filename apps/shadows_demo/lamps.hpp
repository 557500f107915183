#pragma once

#include <Inventor/nodes/SoLight.h>

#include <array>
#include <string>

#include "ref.hpp"
#include "umbrage/base/error.hpp"

class SbColor;
class SbVec3f;
class SoGroup;

namespace umbrage::coin {
class ShadowManager;
}

namespace umbrage::demo {

/// The demo's lights: four point lights, a directional one and a spot. Each has a handle for the mouse.
class Lamps {
 public:
  static constexpr std::size_t kCount = 6;

  /// `where` gets those that are in the scene; it stands before what they light.
  explicit Lamps(SoGroup& where);

  [[nodiscard]] SoLight& operator[](std::size_t lamp) const { return *all_[lamp].light; }
  [[nodiscard]] const char* nameOf(std::size_t lamp) const { return all_[lamp].name; }
  [[nodiscard]] bool isThere(std::size_t lamp) const { return all_[lamp].there; }
  /// Puts it into the scene and gives it shadows, or takes it out.
  [[nodiscard]] Result<void> toggle(std::size_t lamp, coin::ShadowManager& shadows);
  /// Keys of those in the scene, "1 5"; "none".
  [[nodiscard]] std::string listed() const;

 private:
  struct Lamp {
    const char* name;
    Ref<SoLight> light;
    Ref<SoNode> stand;  ///< holds it at its place
    bool there = false;
  };
  [[nodiscard]] static Lamp stood(const char* name, SoLight* light, const SbVec3f& at, const SbColor& colour,
                                  float intensity);
  SoGroup& where_;
  std::array<Lamp, kCount> all_;
};

}  // namespace umbrage::demo
