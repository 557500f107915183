#include "umbrage/scene/see_through.hpp"

#include <algorithm>

namespace umbrage::scene {
namespace {

// What passes a surface of that opacity: little of a dark colour, so it is mixed with white, wholly where nothing is to be seen of the surface.
Vec3 passing(const Vec3& colour, double opacity) {
  constexpr double kLeast = 0.1;
  const Vec3 tint = glm::max(glm::mix(Vec3(1.0), colour, std::min(1.0, 2.0 * opacity)), Vec3(kLeast));
  return (1.0 - opacity) * tint;
}

}  // namespace

Scene seeThrough(Scene scene, double opacity) {
  for (Material& material : scene.materials) {
    if (material.opacity <= opacity) continue;
    material.filter = glm::max(transmittance(material), passing(material.colour, opacity));
    material.opacity = opacity;
  }
  return scene;
}

}  // namespace umbrage::scene
