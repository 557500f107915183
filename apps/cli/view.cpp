#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "options.hpp"
#include "umbrage/scene/framing.hpp"
#include "umbrage/scene/see_through.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::cli {
namespace {

// The sun where nobody names a light: from the right of the default camera, so that shadows fall to the left into the picture
// and one of the two walls in sight is lit.
constexpr double kSunAzimuth = 160.0;
constexpr double kSunElevation = 40.0;

// Surface and depth, masks and their pictures, with room for what a technique keeps beside them. Masks of coloured light are larger, and soft
// ones are made of sixteen at once.
constexpr double kBytesPerPixel = 24.0;
constexpr double kMask = 4.0, kTintedMask = 12.0, kMean = 32.0;
constexpr double kMasksAtOnce = 16.0;
constexpr double kMemory = 2.0 * 1024 * 1024 * 1024;

Result<void> checkMemory(const Size& size, const std::vector<scene::Light>& lights, bool tinted) {
  const double mask = tinted ? kTintedMask : kMask;
  const bool soft = std::ranges::any_of(lights, scene::isArea);
  const double perPixel = kBytesPerPixel + mask * double(lights.size()) + (soft ? kMasksAtOnce * mask + kMean : 0.0);
  const double bytes = double(size.width) * double(size.height) * perPixel;
  if (bytes <= kMemory) return {};
  return fail(ErrorCode::usage,
              fmt::format("--size: {} x {} samples with {} lights need {:.1f} GiB; choose a smaller --size, a smaller "
                          "--antialias or fewer lights",
                          size.width, size.height, lights.size(), bytes / (1024.0 * 1024.0 * 1024.0)));
}

bool isTinted(const scene::Scene& scene) {
  return std::ranges::any_of(scene.materials,
                             [](const scene::Material& m) { return scene::transmittance(m) != Vec3(0.0); });
}

scene::Light defaultSun(scene::UpAxis up, Angle north) {
  auto light = study::sunLight({Angle::degrees(kSunElevation), Angle::degrees(kSunAzimuth)}, up, north);
  light.name = "default sun";
  return light;
}

// Where the scene's shadows will fall on its ground, roughly: the foot of its bounds, with a margin.
Box3 shadowFoot(const scene::Scene& scene, const ViewOptions& options) {
  const Box3 box = scene::bounds(scene);
  if (!options.ground || box.empty()) return {};
  const Vec3 up = scene::upVector(scene.up);
  const Vec3 across = Vec3(1.0) - up;
  const Vec3 room = options.shadowRoom * glm::dot(box.size(), up) * across;
  const Vec3 foot = glm::dot(box.min, up) * up;
  return {box.min * across + foot - room, box.max * across + foot + room};
}

Result<scene::Camera> makeCamera(const scene::Scene& scene, const ViewOptions& options) {
  scene::Camera camera =
      scene::frameScene(scene, shadowFoot(scene, options), options.fov, options.size.width, options.size.height);
  if (options.eye) {
    camera.eye = *options.eye;
    camera.target = scene::bounds(scene).centre();
  }
  if (options.target) camera.target = *options.target;
  const double distance = glm::length(camera.target - camera.eye);
  if (!(distance > 0.0) || !std::isfinite(distance))
    return fail(ErrorCode::usage, "--eye and the target are the same point; give another --target x,y,z");
  return camera;
}

std::string cameraReason(const ViewOptions& options) {
  if (options.eye && options.target) return "as asked";
  if (options.eye) return "eye as asked, at the scene's centre";
  if (options.target) return "the eye that frames the scene, at the target asked for";
  return "the whole scene from the south-west at 30 degrees";
}

}  // namespace

Result<View> makeView(scene::Scene scene, const ViewOptions& options) {
  View view;
  view.silhouettes = options.silhouettes;
  view.fill = options.fill;
  view.extrusion = options.extrusion;
  view.veilLayers = options.veilLayers;
  view.soft = options.soft;
  view.techniques = options.techniques;
  if (options.seeThrough) scene = scene::seeThrough(std::move(scene), *options.seeThrough);
  // Framed before the ground is added: the ground is 64 times as large as the scene.
  const auto camera = makeCamera(scene, options);
  if (!camera) return tl::unexpected(camera.error());
  view.camera = *camera;
  view.cameraReason = cameraReason(options);
  if (!options.lights.empty()) {
    view.lights = options.lights;
    view.lightReason = "as asked";
  } else if (!scene.lights.empty()) {
    view.lights = scene.lights;
    view.lightReason = "the scene's own";
  } else {
    view.lights = {defaultSun(scene.up, scene.northOffset)};
    view.lightReason =
        fmt::format("no light given: a sun at azimuth {:.0f}, {:.0f} degrees high", kSunAzimuth, kSunElevation);
  }
  const Size drawn{options.size.width * options.antialias, options.size.height * options.antialias};
  if (const auto fits = checkMemory(drawn, view.lights, isTinted(scene)); !fits) return tl::unexpected(fits.error());
  view.scene = options.ground ? scene::withGround(std::move(scene), options.ground->height) : std::move(scene);
  return view;
}

}  // namespace umbrage::cli
