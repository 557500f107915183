#pragma once

#include <Inventor/SbXfBox3f.h>

#include <optional>

class SoCallbackAction;
class SoNode;
class SoPath;

namespace umbrage::coin::detail {

/// A handle of a manipulator: it stands around what it moves, and around lights.
[[nodiscard]] bool isHandle(const SoPath& path);

/// Drawn when everything else is.
[[nodiscard]] bool isAnnotation(const SoPath& path);

/// The space of a text's own letters, in the world; none for other shapes. Coin's triangles of a text's sides go far beyond.
[[nodiscard]] std::optional<SbXfBox3f> letterSpace(SoCallbackAction& action, const SoNode& shape);

}  // namespace umbrage::coin::detail
