#pragma once

#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/light.hpp"
#include "umbrage/sun/sun.hpp"

namespace umbrage::study {

/// Unit vector towards the sun in the frame of a scene.
[[nodiscard]] Vec3 towardsSun(const sun::SunPosition& position, scene::UpAxis up, Angle northOffset = {});

/// The sun as a white directional light of intensity 1.
[[nodiscard]] scene::Light sunLight(const sun::SunPosition& position, scene::UpAxis up, Angle northOffset = {});

}  // namespace umbrage::study
