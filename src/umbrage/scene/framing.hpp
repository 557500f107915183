#pragma once

#include "umbrage/scene/scene.hpp"

namespace umbrage::scene {

/// A camera that sees every triangle of the scene, and `also` (a box, for example where shadows will fall; may be empty), from the
/// (true) south-west at 30 degrees above the horizon, as large as fits into 94 % of the picture.
[[nodiscard]] Camera frameScene(const Scene& scene, const Box3& also, Angle fovY, int width, int height);

}  // namespace umbrage::scene
