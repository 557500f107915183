#pragma once

#include "umbrage/scene/scene.hpp"

namespace umbrage::scene {

/// The scene with every surface at most so opaque (0 to 1): its shadows show what is inside.
/// Source: Kim, Kim and Turk, real-time shadows of transparent casters, 2008.
[[nodiscard]] Scene seeThrough(Scene scene, double opacity);

}  // namespace umbrage::scene
