#pragma once

#include <memory>
#include <string>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::benchmarks {

/// A picture to be timed: 1280 x 720.
struct View {
  std::string name;
  std::shared_ptr<const shadow::Geometry> geometry;
  scene::Camera camera;
  scene::Light light;
};

/// The sample "building" (180,000 triangles) on its ground, under an afternoon sun: from the air, and from the street.
[[nodiscard]] View fromTheAir();
[[nodiscard]] View fromTheStreet();
/// A torus knot of 70,000 triangles that fills the picture: curved, everywhere near its own shadow.
[[nodiscard]] View knot();
/// The shots of scenes/staged_scene.hpp, which other programs draw too.
[[nodiscard]] View cityAir();
[[nodiscard]] View cityStreet();
[[nodiscard]] View cityLamp();
[[nodiscard]] View groovedKnotView();

}  // namespace umbrage::benchmarks
