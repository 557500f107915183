#pragma once

#include <optional>
#include <vector>

#include "umbrage/scene/light.hpp"

class SoFieldContainer;
class SoNode;
class SoSFFloat;

namespace umbrage::coin::detail {

[[nodiscard]] bool isLight(const SoNode& node);

/// The light that a node says, in world coordinates; none when it is no light, is off, is black, or says nothing sensible.
/// `toWorld`: the model matrix where it stands.
[[nodiscard]] std::optional<scene::Light> lightOf(const SoNode& node, const Mat4& toWorld);

/// The fields that all its light is proportional to, each for a part. REQUIRES: isLight(node).
[[nodiscard]] std::vector<SoSFFloat*> brightnessOf(SoNode& node);

/// The same light without its cone: how far it reaches round about is another question than what hides it.
[[nodiscard]] scene::Light withoutCone(scene::Light light);

}  // namespace umbrage::coin::detail
