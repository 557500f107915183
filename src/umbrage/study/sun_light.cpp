#include "umbrage/study/sun_light.hpp"

namespace umbrage::study {

Vec3 towardsSun(const sun::SunPosition& position, scene::UpAxis up, Angle northOffset) {
  const Vec3 local = sun::eastNorthUp(position);
  return local.x * scene::eastVector(up, northOffset) + local.y * scene::northVector(up, northOffset) +
         local.z * scene::upVector(up);
}

scene::Light sunLight(const sun::SunPosition& position, scene::UpAxis up, Angle northOffset) {
  scene::Light light;
  light.shape = scene::DirectionalLight{-towardsSun(position, up, northOffset)};
  light.name = "sun";
  return light;
}

}  // namespace umbrage::study
