#pragma once

#include <cmath>

#include "support/shapes.hpp"
#include "umbrage/shadow/technique.hpp"

/// A yard under lights with an extent, and how two of its masks compare.
namespace umbrage::support {

inline std::vector<scene::Light> areaLights() {
  return {{scene::DiscLight{{4, -3, 8}, {-4, 3, -8}, 0.8}},
          {scene::RectangleLight{{-3, -3, 7}, {0.8, 0, 0.2}, {0, -0.6, 0.3}}},
          {scene::SphereLight{{4, -3, 8}, 0.8}},
          {scene::SunLight{{0.5, 0.4, -1}, Angle::degrees(3)}}};
}

inline std::shared_ptr<const shadow::Geometry> yard() {
  return shadow::makeGeometry(shapes::scene({shapes::box({0, 0, 0}, {2, 2, 3}), shapes::sphere({4, 1, 1}, 1, 32, 16),
                                             shapes::box({-3, 1, 1}, {-2, 3, 1.2}),
                                             shapes::quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0})}));
}

inline scene::Camera fromTheCorner(int width, int height) {
  scene::Camera camera;
  camera.eye = {-4.1, -7.3, 6.2}, camera.target = {1, 1, 0.5}, camera.up = {0, 0, 1};
  camera.width = width, camera.height = height;
  return camera;
}

/// Root of the mean square difference, over all pixels that show a surface and over those in the penumbra.
struct Errors {
  double all = 0.0, penumbra = 0.0;
};
inline Errors errors(const shadow::LightMask& mask, const shadow::LightMask& truth) {
  double sum = 0.0;
  std::size_t covered = 0, penumbra = 0;
  for (std::size_t i = 0; i < truth.light.size(); ++i) {
    if (truth.covered.pixels()[i] == 0) continue;
    const double d = (int(mask.light.pixels()[i]) - int(truth.light.pixels()[i])) / 255.0;
    sum += d * d;
    ++covered;
    penumbra += truth.light.pixels()[i] != 0 && truth.light.pixels()[i] != 255;
  }
  return {std::sqrt(sum / double(covered)), std::sqrt(sum / double(std::max<std::size_t>(1, penumbra)))};
}

}  // namespace umbrage::support
