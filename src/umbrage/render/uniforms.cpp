#include "umbrage/render/uniforms.hpp"

namespace umbrage::render {
namespace {

constexpr float kNoCone = -2.0f;

Vec3f low(const Vec3& v) { return Vec3f(v - Vec3(Vec3f(v))); }

}  // namespace

ViewBlock viewBlock(const View& view, const Vec3& origin, const Vec4& light) {
  const Vec3 eye = view.eye - origin;
  ViewBlock block;
  block.toClip = Mat4f(view.toClip);
  block.eyeHigh = Vec4f(Vec3f(eye), 0.0f);
  block.eyeLow = Vec4f(low(eye), 0.0f);
  block.lightHigh = Vec4f(light);
  block.lightLow = Vec4f(low(Vec3(light)), 0.0f);
  return block;
}

ShadingBlock shadingBlock(const scene::Camera& camera) {
  const scene::PixelRays rays = scene::pixelRays(camera);
  ShadingBlock block{};
  block.rayCorner = Vec4f(Vec3f(rays.corner + double(camera.height) * rays.dy), 0.0f);
  block.rayX = Vec4f(Vec3f(rays.dx), 0.0f);
  block.rayY = Vec4f(Vec3f(-rays.dy), 0.0f);
  block.cone.w = kNoCone;
  return block;
}

ShadingBlock withLight(ShadingBlock block, const scene::Camera& camera, const scene::Light& light) {
  block.light = Vec4f(scene::homogeneous(light, camera.eye));
  block.radiance = Vec4f(Vec3f(light.colour * light.intensity), 0.0f);
  if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape))
    block.cone = Vec4f(Vec3f(glm::normalize(spot->direction)), static_cast<float>(cos(spot->cutoff)));
  return block;
}

std::vector<std::uint32_t> packBits(std::span<const std::uint8_t> flags) {
  std::vector<std::uint32_t> words((flags.size() + 31) / 32);
  for (std::size_t i = 0; i < flags.size(); ++i) words[i / 32] |= std::uint32_t{flags[i] != 0} << (i % 32);
  return words;
}

}  // namespace umbrage::render
