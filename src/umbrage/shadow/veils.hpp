#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/image/image.hpp"

namespace umbrage::shadow {

/// A surface that lets light through, where one pixel shows it.
struct Veil {
  std::uint32_t triangle;  ///< of the Surfaces
  float depth;             ///< as SurfaceBuffer::depth
};

/// The veils before what a camera sees.
struct VeilBuffer {
  std::vector<std::uint32_t>
      first;  ///< per pixel, row by row from the top: where its veils begin; one more. Empty: there are none at all
  image::UnsetVector<Veil> veils;  ///< of each pixel the nearest first

  [[nodiscard]] bool empty() const { return veils.empty(); }
  /// Of a pixel, by its number in that order.
  [[nodiscard]] std::span<const Veil> at(std::size_t pixel) const {
    return empty() ? std::span<const Veil>() : std::span(veils).subspan(first[pixel], first[pixel + 1] - first[pixel]);
  }
};

}  // namespace umbrage::shadow
