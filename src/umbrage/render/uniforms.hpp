#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/render/view.hpp"

namespace umbrage::render {

// The uniform blocks of the shaders, laid out as std140 has them. Large numbers travel as two floats, high + low.

struct ViewBlock {
  Mat4f toClip;
  Vec4f eyeHigh, eyeLow;      // relative to the origin of the positions
  Vec4f lightHigh, lightLow;  // likewise; w of a direction is 0
};

struct ShadingBlock {
  Vec4f rayCorner, rayX, rayY;
  Vec4f light;
  Vec4f radiance;
  Vec4f cone;
  Vec4f sky;
  Vec4f background;
};

/// `light`: homogeneous, relative to `origin`, the origin of the positions.
[[nodiscard]] ViewBlock viewBlock(const View& view, const Vec3& origin, const Vec4& light);

/// The rays of a camera from the lower left, without any light.
[[nodiscard]] ShadingBlock shadingBlock(const scene::Camera& camera);
/// The same with a light.
[[nodiscard]] ShadingBlock withLight(ShadingBlock block, const scene::Camera& camera, const scene::Light& light);

/// One bit a triangle, 32 to a word, from the lowest.
[[nodiscard]] std::vector<std::uint32_t> packBits(std::span<const std::uint8_t> flags);

}  // namespace umbrage::render
