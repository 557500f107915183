#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/math/vec.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render::detail {

/// A surface as the shaders know it, as std430 lays it out.
struct Face {
  Vec4f normal;  ///< unit; material as the bits of w
  Vec4f corner;
  std::array<std::int32_t, 4> filter;
};

[[nodiscard]] std::vector<Face> facesOf(const shadow::Geometry& geometry);

/// Four bits a triangle, eight to a word, from the lowest: whether its visible side faces the light; lightSide is 1; is -1.
[[nodiscard]] std::vector<std::uint32_t> packLightBits(std::span<const std::uint8_t> facing,
                                                       std::span<const std::int8_t> side);

}  // namespace umbrage::render::detail
