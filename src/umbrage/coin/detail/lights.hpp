#pragma once

#include <optional>

#include "umbrage/scene/light.hpp"

class SoFieldContainer;
class SoNode;
class SoSFBool;

namespace umbrage::coin::detail {

[[nodiscard]] bool isLight(const SoNode& node);

/// The light that a node says, in world coordinates; none when it is no light, is off, is black, or says nothing sensible.
/// `toWorld`: the model matrix where it stands.
[[nodiscard]] std::optional<scene::Light> lightOf(const SoNode& node, const Mat4& toWorld);

/// The field that switches it on. REQUIRES: isLight(node).
[[nodiscard]] SoSFBool& switchOf(SoNode& node);

/// The same light without its cone: how far it reaches round about is another question than what hides it.
[[nodiscard]] scene::Light withoutCone(scene::Light light);

}  // namespace umbrage::coin::detail
