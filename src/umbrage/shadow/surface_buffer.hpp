#pragma once

#include <cstdint>

#include "umbrage/image/image.hpp"

namespace umbrage::shadow {

/// No surface at this pixel.
inline constexpr std::uint32_t kNoTriangle = ~std::uint32_t{0};

/// What the camera sees: per pixel the index of the nearest triangle in Surfaces, and its depth.
struct SurfaceBuffer {
  image::Image<std::uint32_t> triangle;
  /// Distance along the camera's forward direction, in scene units; infinite where no surface.
  image::Image<float> depth;
};

}  // namespace umbrage::shadow
