#include "umbrage/scene/see_through.hpp"

#include <algorithm>

namespace umbrage::scene {

Scene seeThrough(Scene scene, double opacity) {
  for (Material& material : scene.materials) material.opacity = std::min(material.opacity, opacity);
  return scene;
}

}  // namespace umbrage::scene
